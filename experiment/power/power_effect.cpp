#include "experiment/power/power_effect.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/answers/answer_kinds.h"
#include "experiment/base/error.h"
#include "experiment/protocol/files/old_words.h"
#include "experiment/scene/areas.h"

namespace overt {

namespace {

struct MeasureWords {
    std::string_view name, size_key, words;
    double least, most; ///< of the size
};

constexpr MeasureWords measures[] = {{"area", "odds", "share of fixations on an area", 0.01, 100.0},
                                     {"wss", "ratio", "spread of fixations (WSS)", 0.05, 20.0},
                                     {"cc", "share", "maps of all observers (CC)", 0.0, 0.95},
                                     {"threshold", "shift", "threshold of", -1e6, 1e6},
                                     {"slope", "ratio", "slope over", 0.01, 100.0},
                                     {"correct", "odds", "share of correct answers to", 0.01, 100.0},
                                     {"dprime", "odds", "d' of", 0.01, 100.0},
                                     {"choice", "shift", "share of a choice of", -10.0, 10.0},
                                     {"rating", "shift", "mean of", -1e6, 1e6}};

const MeasureWords& words_of(PowerMeasure measure) { return measures[static_cast<std::size_t>(measure)]; }

constexpr std::string_view tests[] = {"pair", "factor", "interaction", "cluster"}; // as PowerTest

constexpr double most_sd = 5.0;
constexpr int most_observers = 500;

std::vector<std::string> parts_of(const std::string& text, char between) {
    std::vector<std::string> parts;
    std::size_t begin = 0;
    for (;;) {
        const std::size_t end = text.find(between, begin);
        parts.push_back(text.substr(begin, end - begin));
        if (end == std::string::npos)
            return parts;
        begin = end + 1;
    }
}

template <class Number> std::optional<Number> number_in(const std::string& text) {
    Number number{};
    const char* const end = text.data() + text.size();
    const auto read = std::from_chars(text.data(), end, number);
    return read.ec == std::errc() && read.ptr == end ? std::optional(number) : std::nullopt;
}

/// Names of levels; none where the protocol has no such factor.
std::vector<std::string> levels_of_column(const Protocol& protocol, const std::string& column) {
    std::vector<std::string> names;
    const Factors factors = factors_of(protocol);
    if (const Factor* factor = factors.find(column))
        for (const FactorLevel& level : factor->levels)
            names.push_back(level.name);
    return names;
}

/// Factors that can be named: all with levels, but for the block, in which trials are no other.
std::vector<std::string> factors_of_effects(const Protocol& protocol) {
    std::vector<std::string> names;
    const Factors factors = factors_of(protocol);
    for (const Factor& factor : factors.all())
        if (!factor.levels.empty() && factor.source != Factor::Source::block)
            names.push_back(factor.name);
    return names;
}

/// Surfaces of two objects are not compared: their factors say only in which trials an effect is.
bool is_of_objects(const Protocol& protocol, const std::string& column) {
    const Factors factors = factors_of(protocol);
    const Factor* factor = factors.find(column);
    return factor && factor->is_of_list(0);
}

/// Areas of the objects of which some task says how often they are looked at.
std::vector<std::string> planned_areas(const Protocol& protocol, std::span<const std::string> areas) {
    std::vector<std::string> planned;
    for (const std::string& area : areas) {
        const bool is_looked_at = std::ranges::any_of(protocol.tasks, [&](const Task& task) {
            return std::ranges::any_of(simulated_shares(task), [&](const auto& share) {
                return share.first == area && share.second > 0.0;
            });
        });
        if (is_looked_at)
            planned.push_back(area);
    }
    return planned;
}

class EffectReader {
  public:
    EffectReader(const std::string& text, const Protocol& protocol, std::span<const std::string> areas)
        : text_(text), protocol_(protocol), areas_(areas) {}

    PowerEffect read() {
        const std::vector<std::string> parts = parts_of(text_, ':');
        const std::size_t equals = parts[0].find('=');
        const std::string name = parts[0] == head_area ? "area" : parts[0].substr(0, equals);
        const auto found = std::find_if(std::begin(measures), std::end(measures),
                                        [&](const MeasureWords& one) { return one.name == name; });
        const bool is_area = name == "area";
        if (found == std::end(measures) || (is_area && parts[0] == "area") ||
            (!is_area && equals != std::string::npos))
            fail(fmt::format("it begins with a measure, which is head, area=NAME, wss or cc, or of answers "
                             "threshold, slope, correct, dprime, choice or rating, and not \"{}\"",
                             parts[0]));
        if (is_area)
            take_area(equals == std::string::npos ? parts[0] : parts[0].substr(equals + 1));
        effect_.measure = static_cast<PowerMeasure>(found - std::begin(measures));
        for (std::size_t i = 1; i < parts.size(); ++i)
            take(parts[i]);
        if (is_of_answers(effect_.measure))
            find_answer();
        if (effect_.column.empty())
            fail("it has to say in which material or task the effect is, such as material=rough");
        if (!has_size_)
            fail(fmt::format("it has to say how large the effect is: {}=…", found->size_key));
        check_levels();
        check_test();
        return effect_;
    }

  private:
    [[noreturn]] void fail(const std::string& what) const {
        throw InputError(fmt::format("--effect {}: {}. An example: head:material=rough:odds=1.5, "
                                     "area=rim:task=free:odds=2, wss:material=rough:ratio=1.2, "
                                     "cc:material=rough:share=0.2, threshold:object=bust:shift=0.05, "
                                     "correct:material=rough:odds=1.5 or rating:material=rough:shift=0.5.",
                                     text_, what));
    }

    void take_area(const std::string& area) {
        if (std::ranges::find(areas_, area) == areas_.end())
            fail(areas_.empty() ? fmt::format("no object has an area \"{}\": none has any", area)
                                : fmt::format("no object has an area \"{}\"; there are {}", area,
                                              fmt::join(areas_, ", ")));
        const std::vector<std::string> planned = planned_areas(protocol_, areas_);
        if (std::ranges::find(planned, area) == planned.end())
            fail(fmt::format(
                "no task says how often \"{0}\" is looked at; simulated_area_shares = {{ {0} = 0.2 }} "
                "in a [[task]] does",
                area));
        effect_.area = area;
    }

    void take(const std::string& part) {
        const std::size_t at = part.find('=');
        if (at == std::string::npos)
            fail(fmt::format("\"{}\" is not of the form key=value", part));
        const std::string key = todays_factor(part.substr(0, at)), value = part.substr(at + 1);
        if (std::find(seen_.begin(), seen_.end(), key) != seen_.end())
            fail(fmt::format("{} is given twice", key));
        seen_.push_back(key);
        const MeasureWords& measure = words_of(effect_.measure);
        if (key == measure.size_key) {
            effect_.size = number(key, value, measure.least, measure.most);
            has_size_ = true;
        } else if (key == "ratio" && effect_.measure == PowerMeasure::threshold && !has_size_) {
            effect_.size = number(key, value, 0.01, 100.0);
            has_size_ = effect_.is_ratio = true;
        } else if (key == "sd") {
            effect_.sd = number(key, value, 0.0, most_sd);
        } else if (key == "test" && !is_of_answers(effect_.measure)) {
            const auto found = std::ranges::find(tests, value);
            if (found == std::end(tests))
                fail(fmt::format("there is no test \"{}\", but {}", value, fmt::join(tests, ", ")));
            effect_.test = static_cast<PowerTest>(found - std::begin(tests));
        } else if (key == "against") {
            effect_.against = value;
        } else if (key == "answer" && is_of_answers(effect_.measure)) {
            effect_.answer = value;
        } else if (const auto known = factors_of_effects(protocol_);
                   std::ranges::find(known, key) != known.end()) {
            check_level(key, value);
            if (effect_.column.empty() &&
                (is_of_answers(effect_.measure) || !is_of_objects(protocol_, key))) {
                effect_.column = key;
                effect_.level = value;
            } else {
                effect_.within.push_back({key, value});
            }
        } else {
            fail(fmt::format("\"{}\" is no key of {}, whose keys are {}, {}, against, {} and sd", key,
                             measure.name, fmt::join(known, ", "), measure.size_key,
                             is_of_answers(effect_.measure) ? "answer" : "test"));
        }
    }

    /// Whether the truth of an answer says what an effect on the measure would change.
    bool has_measure(const Task& task, const TaskAnswer& answer) const {
        const AnswerTruth& truth = answer.truth;
        switch (effect_.measure) {
        case PowerMeasure::threshold:
            // What moves both slots alike changes nothing between them.
            return answer.is_choice() && !truth.by.empty() && truth.slope != 0.0 &&
                   is_among_slots(task, answer) == effect_.is_ratio;
        case PowerMeasure::slope:
            return answer.is_choice() && !truth.by.empty() && truth.slope != 0.0;
        case PowerMeasure::choice:
            return answer.is_choice() && !truth.by.empty() && !is_among_slots(task, answer);
        case PowerMeasure::correct:
        case PowerMeasure::d_prime:
            return answer.is_choice() && truth.by.empty();
        case PowerMeasure::rating:
            return row_of(answer.kind).name == "scale" || row_of(answer.kind).name == "number";
        default:
            return false;
        }
    }

    void find_answer() {
        std::vector<std::string> known;
        for (const Task& task : protocol_.tasks) {
            const bool is_asked = std::ranges::all_of(effect_.within, [&](const StudyKey& key) {
                return key.column != "task" || key.value == task.id;
            });
            for (const TaskAnswer& answer : task.answers) {
                if (!has_measure(task, answer) || !is_asked)
                    continue;
                known.push_back(answer.id);
                if (effect_.task.empty() && (effect_.answer.empty() || effect_.answer == answer.id)) {
                    effect_.answer = answer.id;
                    effect_.task = task.id;
                }
            }
        }
        if (!effect_.task.empty())
            return;
        const MeasureWords& measure = words_of(effect_.measure);
        fail(known.empty()
                 ? fmt::format(
                       "no answer's `simulated` says what {} is of: thresholds, slopes and choices are "
                       "of choices that go \"by\" a factor (a threshold with shift=… of words, with ratio=… "
                       "of "
                       "slots; a choice of words), correct and dprime of those that do not, "
                       "rating of scales and numbers",
                       measure.name)
                 : fmt::format("{} is of no answer \"{}\", but of {}", measure.name, effect_.answer,
                               fmt::join(known, ", ")));
    }

    double number(const std::string& key, const std::string& value, double least, double most) const {
        const std::optional<double> read = number_in<double>(value);
        if (!read || !(*read >= least && *read <= most))
            fail(fmt::format("{} has to be a number from {} to {}, and not \"{}\"", key, least, most, value));
        return *read;
    }

    void check_level(const std::string& column, const std::string& level) const {
        const std::vector<std::string> known = levels_of_column(protocol_, column);
        if (std::find(known.begin(), known.end(), level) == known.end())
            fail(fmt::format("the protocol has no {} \"{}\"; it has {}", column, level,
                             fmt::join(known, ", ")));
    }

    void check_levels() {
        const std::vector<std::string> known = levels_of_column(protocol_, effect_.column);
        if (known.size() < 2)
            fail(fmt::format("the protocol has only one {}, and nothing to compare it with", effect_.column));
        if (effect_.against.empty())
            effect_.against = known[0] == effect_.level ? known[1] : known[0];
        check_level(effect_.column, effect_.against);
        if (effect_.against == effect_.level)
            fail(fmt::format("{} cannot be compared with itself", effect_.level));
    }

    void check_test() const {
        const bool is_of_maps = effect_.measure == PowerMeasure::cc;
        if (is_of_maps && (effect_.test == PowerTest::factor || effect_.test == PowerTest::interaction))
            fail("maps have no test of factors: test=cluster is of maps, test=factor of head, area=NAME and "
                 "wss");
        if (!is_of_maps && effect_.test == PowerTest::cluster)
            fail("clusters are of maps: cc:…:share=0.2:test=cluster");
        if (effect_.test == PowerTest::cluster && !effect_.within.empty())
            fail("clusters are of all trials: without it, the effect is in all of them");
        if (effect_.test == PowerTest::interaction &&
            (effect_.within.size() != 1 || is_of_objects(protocol_, effect_.interacting_column())))
            fail("an interaction is of an effect that one other factor confines, which is not of objects, "
                 "such as "
                 "head:material=rough:task=free:odds=1.5:test=interaction");
    }

    const std::string& text_;
    const Protocol& protocol_;
    std::span<const std::string> areas_;
    PowerEffect effect_;
    bool has_size_ = false;
    std::vector<std::string> seen_;
};

PowerEffect no_effect(PowerMeasure measure, const std::string& column,
                      const std::vector<std::string>& levels) {
    PowerEffect effect;
    effect.measure = measure;
    effect.column = column;
    effect.level = levels[0];
    effect.against = levels[1];
    effect.size = effect.is_shift() ? 0.0 : 1.0;
    return effect;
}

} // namespace

bool is_among_slots(const Task& task, const TaskAnswer& answer) {
    return std::ranges::any_of(answer.choices, [&](const std::string& choice) {
        return std::ranges::find(task.slots, choice) != task.slots.end();
    });
}

std::string PowerEffect::text() const {
    const MeasureWords& of = words_of(measure);
    std::string text = fmt::format("{}:{}={}:{}={}:against={}",
                                   measure != PowerMeasure::area ? std::string(of.name)
                                   : area == head_area           ? area
                                                                 : fmt::format("area={}", area),
                                   column, level, is_ratio ? "ratio" : of.size_key, size, against);
    for (const StudyKey& key : within)
        text += fmt::format(":{}={}", key.column, key.value);
    if (!answer.empty())
        text += fmt::format(":answer={}", answer);
    if (sd > 0.0)
        text += fmt::format(":sd={}", sd);
    if (test != PowerTest::pair)
        text += fmt::format(":test={}", tests[static_cast<std::size_t>(test)]);
    return text;
}

std::string PowerEffect::words() const {
    std::string words =
        fmt::format("{}, {} {} against {}",
                    is_of_answers(measure) ? fmt::format("{} \"{}\"", words_of(measure).words, answer)
                    : measure != PowerMeasure::area ? std::string(words_of(measure).words)
                    : area == head_area             ? "share of fixations on the head"
                                                    : fmt::format("share of fixations on the area {}", area),
                    column, level, against);
    for (const StudyKey& key : within)
        words += fmt::format(", {} {}", key.column, key.value);
    if (test == PowerTest::factor)
        words += fmt::format(", by the effect of {}", column);
    if (test == PowerTest::interaction)
        words += fmt::format(", by the interaction of {} and {}", column, interacting_column());
    if (test == PowerTest::cluster)
        words += ", by clusters on the surface";
    return words;
}

std::vector<PowerEffect> power_effects(const std::vector<std::string>& texts, const Protocol& protocol,
                                       std::span<const std::string> areas) {
    std::vector<PowerEffect> effects;
    for (const std::string& text : texts) {
        if (text != "none") {
            effects.push_back(EffectReader(text, protocol, areas).read());
            continue;
        }
        if (texts.size() > 1)
            throw InputError("--effect none stands alone: another effect would not leave it none.");
        const std::vector<std::string> materials = levels_of_column(protocol, "material"),
                                       tasks = levels_of_column(protocol, "task");
        const std::string area(usual_area(planned_areas(protocol, areas)));
        if (materials.size() > 1) {
            for (const PowerMeasure measure : {PowerMeasure::area, PowerMeasure::wss, PowerMeasure::cc}) {
                if (measure != PowerMeasure::area || !area.empty())
                    effects.push_back(no_effect(measure, "material", materials));
            }
        }
        if (tasks.size() > 1 && !area.empty())
            effects.push_back(no_effect(PowerMeasure::area, "task", tasks));
        for (PowerEffect& effect : effects)
            effect.area = effect.measure == PowerMeasure::area ? area : std::string();
        if (effects.empty())
            throw InputError("--effect none: the protocol has one material and one task, and nothing to "
                             "compare.");
    }
    return effects;
}

std::vector<int> observer_counts(const std::string& text) {
    const auto fail = [&](const std::string& what) {
        throw InputError(fmt::format(
            "--observers {}: {}. Expected is a number, a range with or without a step, or a list: 12, 6:24, "
            "6:24:3, 6,12,18.",
            text, what));
    };
    const auto number = [&](const std::string& part) {
        const std::optional<int> read = number_in<int>(part);
        if (!read || *read < 1 || *read > most_observers)
            fail(fmt::format("\"{}\" is no whole number from 1 to {}", part, most_observers));
        return *read;
    };
    std::vector<int> counts;
    if (text.find(':') != std::string::npos) {
        const std::vector<std::string> parts = parts_of(text, ':');
        if (parts.size() > 3)
            fail("a range has a begin, an end and a step");
        const int begin = number(parts[0]), end = number(parts[1]),
                  step = parts.size() > 2 ? number(parts[2]) : 1;
        if (end < begin)
            fail("the range ends before it begins");
        for (int count = begin; count <= end; count += step)
            counts.push_back(count);
        return counts;
    }
    for (const std::string& part : parts_of(text, ','))
        counts.push_back(number(part));
    std::sort(counts.begin(), counts.end());
    counts.erase(std::unique(counts.begin(), counts.end()), counts.end());
    return counts;
}

} // namespace overt
