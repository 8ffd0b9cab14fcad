#include "app/analyze/planted_answers.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <tuple>

#include <fmt/format.h>

#include "devices/simulated/simulated_keys.h"
#include "experiment/answers/answer_kinds.h"
#include "experiment/base/text_number.h"
#include "experiment/design/answer_forms.h"
#include "experiment/fits/difference_scaling.h"
#include "experiment/record/read/session_record.h"
#include "experiment/study/answers/answer_differences.h"

namespace overt {

namespace {

const TaskAnswer* asked_of(const Protocol& protocol, const std::string& task, const std::string& answer) {
    const auto of = std::ranges::find(protocol.tasks, task, &Task::id);
    if (of == protocol.tasks.end())
        return nullptr;
    const auto found = std::ranges::find(of->answers, answer, &TaskAnswer::id);
    return found == of->answers.end() ? nullptr : &*found;
}

/// An answer with a value that could have been given, and how probable that is.
struct WeighedAnswer {
    StudyAnswer answer; ///< its number and its time are those to be expected
    double weight = 1.0;
    std::optional<double> mean = {}; ///< of numbers
};

/// All that each observer could have answered, by observer and what was asked.
using WeighedAnswers = std::map<AnswerOf, std::vector<WeighedAnswer>>;

/// Nothing if an observer has no seed, or a trial is not the protocol's.
std::optional<WeighedAnswers> weighed_answers(const StudyResults& results, const Protocol& protocol,
                                              const ObserverSeeds& seeds,
                                              std::span<const std::filesystem::path> sessions) {
    std::vector<std::map<int, Trial>> trials;
    for (const std::filesystem::path& session : sessions) {
        trials.emplace_back();
        const SessionRecord record(session);
        for (const TrialRecord& trial : record.trials())
            if (trial.gives_results())
                trials.back().emplace(trial.trial.index + 1, trial.trial);
    }
    std::map<std::string, std::unique_ptr<SimulatedAnswers>> observers;
    WeighedAnswers all;
    for (const StudyAnswer& given : results.answers.given) {
        const TaskAnswer* const asked = asked_of(protocol, given.task, given.answer);
        const auto seed = seeds.find(given.observer);
        const auto trial = trials[static_cast<std::size_t>(given.session)].find(given.trial);
        if (!asked || seed == seeds.end() || trial == trials[static_cast<std::size_t>(given.session)].end())
            return std::nullopt;
        if (given.is_missed)
            continue;
        auto& simulated = observers[given.observer];
        if (!simulated)
            simulated = std::make_unique<SimulatedAnswers>(protocol, seed->second);
        const AnswerOffer offer = offer_of(protocol, *asked, given.item, trial->second);
        const SimulatedAnswers::Expected expected = simulated->expected(offer, trial->second);
        std::vector<WeighedAnswer>& own = all[{given.observer, given.task, given.answer, given.item}];
        StudyAnswer likely = given;
        likely.number = expected.mean;
        if (likely.response_s)
            likely.response_s = expected.after_s;
        if (expected.mean)
            own.push_back({likely, 1.0, expected.mean});
        for (std::size_t i = 0; i < expected.shares.size(); ++i) {
            WeighedAnswer& one = own.emplace_back(WeighedAnswer{likely, expected.shares[i]});
            one.answer.value = offer.values[i];
            if (!given.correct.empty())
                one.answer.is_correct = offer.values[i] == given.correct;
        }
    }
    return all;
}

std::vector<const WeighedAnswer*> weighed_in(const std::vector<WeighedAnswer>& answers,
                                             const std::string& column, const std::string& level) {
    std::vector<const WeighedAnswer*> own;
    for (const WeighedAnswer& one : answers)
        if (column.empty() || one.answer.level(column) == level)
            own.push_back(&one);
    return own;
}

struct PlantedCurve {
    double threshold = 0.0, slope = 0.0;
};

std::optional<PlantedCurve> planted_curve(const std::vector<const WeighedAnswer*>& answers,
                                          const std::string& factor, const std::string& yes) {
    AnswerList list;
    for (const WeighedAnswer* one : answers)
        list.push_back(&one->answer);
    if (!curve_factors(list).contains(factor))
        return std::nullopt;
    for (CurveCounts& counts : curve_counts(list, factor)) {
        if (counts.yes != yes || counts.trials.size() != answers.size())
            continue;
        std::vector<LevelCount> weighed;
        for (std::size_t i = 0; i < answers.size(); ++i)
            if (const double weight = answers[i]->weight; weight > 0.0)
                weighed.push_back({counts.trials[i].level, weight, weight * counts.trials[i].yes});
        counts.trials = std::move(weighed);
        const auto fit = fit_curve(counts);
        if (fit && sound_threshold(*fit, counts_by_level(counts.trials)))
            return PlantedCurve{fit->alpha.value, fit->beta.value};
    }
    return std::nullopt;
}

std::optional<double> planted_mean(const std::vector<const WeighedAnswer*>& answers) {
    double sum = 0.0, count = 0.0;
    for (const WeighedAnswer* one : answers)
        if (one->mean) {
            sum += *one->mean;
            count += 1.0;
        }
    return count > 0.0 ? std::optional(sum / count) : std::nullopt;
}

std::optional<double> planted_share(const std::vector<const WeighedAnswer*>& answers, const auto& counts) {
    double sum = 0.0, all = 0.0;
    for (const WeighedAnswer* one : answers)
        if (const std::optional<bool> counted = counts(one->answer)) {
            sum += *counted ? one->weight : 0.0;
            all += one->weight;
        }
    return all > 0.0 ? std::optional(sum / all) : std::nullopt;
}

/// The mean over those who have one.
template <class Of>
std::optional<double> mean_over_observers(const WeighedAnswers& answers, const AnswerOf& wanted,
                                          const Of& of) {
    double sum = 0.0;
    int count = 0;
    for (const auto& [key, own] : answers) {
        if (key.task != wanted.task || key.answer != wanted.answer || key.item != wanted.item ||
            (!wanted.observer.empty() && key.observer != wanted.observer))
            continue;
        if (const std::optional<double> value = of(own)) {
            sum += *value;
            ++count;
        }
    }
    return count > 0 ? std::optional(sum / count) : std::nullopt;
}

void plant_curves(StudyAnswers& answers, const WeighedAnswers& weighed) {
    for (AnswerCurveRow& row : answers.curves) {
        const auto curve = [&](const std::vector<WeighedAnswer>& own) {
            return planted_curve(weighed_in(own, row.column, row.level), row.factor, row.yes);
        };
        row.planted_threshold =
            mean_over_observers(weighed, row.of, [&](const auto& own) -> std::optional<double> {
                const auto found = curve(own);
                return found ? std::optional(found->threshold) : std::nullopt;
            });
        row.planted_slope =
            mean_over_observers(weighed, row.of, [&](const auto& own) -> std::optional<double> {
                const auto found = curve(own);
                return found ? std::optional(found->slope) : std::nullopt;
            });
    }
}

void plant_ratings(StudyAnswers& answers, const WeighedAnswers& weighed) {
    for (AnswerRatingRow& row : answers.ratings)
        row.planted = mean_over_observers(weighed, row.of, [&](const std::vector<WeighedAnswer>& own) {
            std::vector<const WeighedAnswer*> of_level;
            for (const WeighedAnswer& one : own) {
                const auto& shown = one.answer.shown;
                const bool is_of_level =
                    row.factor.empty() ||
                    (shown.size() == 1 &&
                     std::ranges::find(shown.front().levels, std::pair(row.factor, row.level)) !=
                         shown.front().levels.end());
                if (is_of_level)
                    of_level.push_back(&one);
            }
            return planted_mean(of_level);
        });
}

/// Of a difference's row: what one observer's answers in a level come to.
std::optional<double> planted_in_level(const AnswerDifferenceRow& row, const StudyAnswers& answers,
                                       const std::vector<const WeighedAnswer*>& own) {
    const auto of = [&](AnswerMeasure measure) -> std::optional<std::string> {
        const std::string prefix = std::string(name_of(measure)) + " of ";
        return row.measure.starts_with(prefix) ? std::optional(row.measure.substr(prefix.size()))
                                               : std::nullopt;
    };
    for (const AnswerMeasure measure : {AnswerMeasure::threshold, AnswerMeasure::log_slope}) {
        const auto factor = of(measure);
        if (!factor)
            continue;
        for (const AnswerCurveRow& curve : answers.curves)
            if (curve.of == row.of && curve.factor == *factor)
                if (const auto found = planted_curve(own, *factor, curve.yes))
                    return measure == AnswerMeasure::threshold ? std::optional(found->threshold)
                           : found->slope > 0.0                ? std::optional(std::log(found->slope))
                                                               : std::nullopt;
        return std::nullopt;
    }
    if (const auto choice = of(AnswerMeasure::choice))
        return planted_share(own,
                             [&](const StudyAnswer& one) { return std::optional(one.value == *choice); });
    if (row.measure == name_of(AnswerMeasure::correct))
        return planted_share(own, [](const StudyAnswer& one) { return one.is_correct; });
    if (row.measure == name_of(AnswerMeasure::mean))
        return planted_mean(own);
    return std::nullopt;
}

void plant_differences(StudyAnswers& answers, const WeighedAnswers& weighed) {
    for (AnswerDifferenceRow& row : answers.differences)
        row.planted = mean_over_observers(
            weighed, row.of, [&](const std::vector<WeighedAnswer>& own) -> std::optional<double> {
                const auto a = planted_in_level(row, answers, weighed_in(own, row.column, row.a)),
                           b = planted_in_level(row, answers, weighed_in(own, row.column, row.b));
                return a && b ? std::optional(*a - *b) : std::nullopt;
            });
}

/// Answers and their weights apart, of those that count.
struct WeighedList {
    AnswerList answers;
    std::vector<double> weights;
};

WeighedList weighed_list(const std::vector<const WeighedAnswer*>& own) {
    WeighedList list;
    for (const WeighedAnswer* one : own) {
        list.answers.push_back(&one->answer);
        list.weights.push_back(one->weight);
    }
    return list;
}

void plant_summaries(StudyAnswers& answers, const WeighedAnswers& weighed) {
    for (AnswerSummaryRow& row : answers.summaries)
        row.planted_correct = mean_over_observers(weighed, row.of, [](const std::vector<WeighedAnswer>& own) {
            return planted_share(weighed_in(own, "", ""),
                                 [](const StudyAnswer& one) { return one.is_correct; });
        });
}

void plant_trends(StudyAnswers& answers, const WeighedAnswers& weighed) {
    for (AnswerTrendRow& row : answers.trends)
        row.planted = mean_over_observers(weighed, row.of, [&](const std::vector<WeighedAnswer>& own) {
            const WeighedList list = weighed_list(weighed_in(own, row.column, row.level));
            return trend_slope(list.answers, list.weights, row.measure, row.along);
        });
}

void plant_likenesses(StudyAnswers& answers, const WeighedAnswers& weighed) {
    std::map<AnswerOf, std::map<LevelPairOfFactor, double>> known; ///< by observer
    for (const auto& [of, own] : weighed) {
        const WeighedList list = weighed_list(weighed_in(own, "", ""));
        known[of] = likeness_shares(list.answers, list.weights);
    }
    for (AnswerLikenessRow& row : answers.likenesses) {
        double sum = 0.0;
        int count = 0;
        for (const auto& [of, shares] : known) {
            const auto share = shares.find({row.factor, {row.a, row.b}});
            if (of.task != row.of.task || of.answer != row.of.answer || of.item != row.of.item ||
                (!row.of.observer.empty() && of.observer != row.of.observer) || share == shares.end())
                continue;
            sum += share->second;
            ++count;
        }
        if (count > 0)
            row.planted = sum / count;
    }
}

void plant_scales(StudyAnswers& answers, const Protocol& protocol) {
    std::map<std::tuple<AnswerOf, std::string, std::string>, std::vector<AnswerScaleRow*>> scales;
    for (AnswerScaleRow& row : answers.scales)
        if (row.method == "Thurstone Case V")
            scales[{row.of, row.method, row.factor}].push_back(&row);
    for (auto& [key, rows] : scales) {
        const TaskAnswer* const asked = asked_of(protocol, std::get<0>(key).task, std::get<0>(key).answer);
        if (!asked || asked->truth.by != std::get<2>(key))
            continue;
        std::vector<double> levels;
        for (const AnswerScaleRow* row : rows)
            if (const auto number = number_in<double>(row->level))
                levels.push_back(*number);
        if (levels.size() != rows.size())
            continue;
        double mean = 0.0;
        for (const double level : levels)
            mean += level / static_cast<double>(levels.size());
        for (std::size_t i = 0; i < rows.size(); ++i)
            rows[i]->planted = std::numbers::sqrt2 * asked->truth.slope * (levels[i] - mean);
    }
}

/// What difference scaling makes of the probabilities of one observer's answers, by level.
std::map<std::string, double> planted_difference_scale(const std::vector<WeighedAnswer>& own,
                                                       const std::string& factor) {
    AnswerList list;
    std::vector<double> weights;
    for (const WeighedAnswer& one : own) {
        list.push_back(&one.answer);
        weights.push_back(one.weight);
    }
    const DifferenceCounts counts = difference_counts(list, factor, weights);
    const auto scale = counts.counts.empty()
                           ? std::nullopt
                           : fit_difference_scale(counts.counts, static_cast<int>(counts.series.size()));
    std::map<std::string, double> places;
    for (std::size_t i = 0; scale && i < counts.series.size(); ++i)
        places[fmt::format("{}", counts.series[i])] = scale->scale[i];
    return places;
}

void plant_difference_scales(StudyAnswers& answers, const WeighedAnswers& weighed) {
    std::map<std::pair<AnswerOf, std::string>, std::map<std::string, double>> known; ///< by observer
    for (AnswerScaleRow& row : answers.scales) {
        if (row.method != "MLDS")
            continue;
        double sum = 0.0;
        int count = 0;
        for (const auto& [key, own] : weighed) {
            if (key.task != row.of.task || key.answer != row.of.answer || key.item != row.of.item ||
                (!row.of.observer.empty() && key.observer != row.of.observer))
                continue;
            const auto [made, is_new] = known.try_emplace({key, row.factor});
            if (is_new)
                made->second = planted_difference_scale(own, row.factor);
            if (const auto place = made->second.find(row.level); place != made->second.end()) {
                sum += place->second;
                ++count;
            }
        }
        if (count > 0)
            row.planted = sum / count;
    }
}

/// What an effect holds for, as factors and levels.
std::vector<std::pair<std::string, std::string>> conditions_of(const SimulatedEffect& effect) {
    std::vector<std::pair<std::string, std::string>> conditions;
    for (std::size_t list = 0; list < stimulus_lists.size(); ++list)
        if (!effect.entries[list].empty())
            conditions.emplace_back(stimulus_lists[list].name, effect.entries[list]);
    for (const NamedWord& level : effect.where)
        conditions.emplace_back(level.name, level.text);
    return conditions;
}

/// The slope that matches of a row have on average: of all trials, where no effect changes it, and of those
/// of a level, where effects hold for levels of the same factor only.
std::optional<double> planted_match_slope(const AnswerMatchLineRow& row, const Protocol& protocol) {
    const TaskAnswer* const asked = asked_of(protocol, row.of.task, row.of.answer);
    if (!asked)
        return std::nullopt;
    double slope = asked->truth.gain;
    for (const SimulatedEffect& effect : protocol.simulated_effects) {
        if (effect.answer != row.of.answer || (!effect.task.empty() && effect.task != row.of.task) ||
            effect.answer_slope == 1.0)
            continue;
        const auto conditions = conditions_of(effect);
        if (row.column.empty() || conditions.size() != 1 || conditions.front().first != row.column)
            return std::nullopt;
        if (conditions.front().second == row.level)
            slope *= effect.answer_slope;
    }
    return slope * (1.0 - asked->truth.start_bias);
}

} // namespace

void add_planted_answers(StudyResults& results, const Protocol& protocol, const ObserverSeeds& seeds,
                         std::span<const std::filesystem::path> sessions) {
    const std::optional<WeighedAnswers> weighed = weighed_answers(results, protocol, seeds, sessions);
    if (!weighed)
        return;
    plant_curves(results.answers, *weighed);
    plant_ratings(results.answers, *weighed);
    plant_differences(results.answers, *weighed);
    plant_summaries(results.answers, *weighed);
    plant_trends(results.answers, *weighed);
    plant_likenesses(results.answers, *weighed);
    plant_scales(results.answers, protocol);
    plant_difference_scales(results.answers, *weighed);
    for (AnswerMatchLineRow& row : results.answers.match_lines)
        row.planted = planted_match_slope(row, protocol);
    for (ReliefRow& row : results.reliefs.reliefs)
        if (const TaskAnswer* const asked = asked_of(protocol, row.of.task, row.of.answer))
            row.planted = asked->truth.gain;
    for (GazeChoiceRow& row : results.answers.gaze_choices)
        if (const TaskAnswer* const asked = asked_of(protocol, row.of.task, row.of.answer);
            asked && asked->truth.look_share && row.area.empty() && row.measure == "dwell share")
            row.planted = asked->truth.look_share;
}

} // namespace overt
