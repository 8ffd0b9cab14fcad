#include "experiment/study/answer_gaze.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "experiment/statistics/bootstrap.h"
#include "experiment/statistics/permutation.h"
#include "experiment/study/difference_maps.h"

namespace overt {

namespace {

constexpr double last_stretch_s = 1.0;
constexpr std::size_t most_compared_choices = 3;

/// A fixation before an answer, by the time to it.
struct LookBefore {
    double begin_s = 0.0, end_s = 0.0; ///< less than, and at most, 0: the answer
    std::size_t presentation = 0;      ///< of the answer's
    const StudyFixation* fixation = nullptr;
};

std::vector<LookBefore> looks_before(std::span<const GazeBeforeAnswer* const> presentations) {
    std::vector<LookBefore> looks;
    for (std::size_t i = 0; i < presentations.size(); ++i)
        for (const StudyFixation* one : presentations[i]->fixations) {
            const double begin = one->onset_s - presentations[i]->until_s;
            looks.push_back({begin, std::min(0.0, begin + one->duration_s), i, one});
        }
    std::ranges::stable_sort(looks, {}, &LookBefore::begin_s);
    return looks;
}

/// What of the looks before an answer satisfies a condition.
struct LookSummary {
    double dwell_s = 0.0, last_s = 0.0;
    int visits = 0;
    bool is_first = false, is_last = false;
    std::optional<double> begin_s; ///< of the first
};

LookSummary summary_of(const std::vector<LookBefore>& looks, const auto& is_there) {
    LookSummary found;
    bool was_there = false;
    for (std::size_t i = 0; i < looks.size(); ++i) {
        const LookBefore& look = looks[i];
        const bool there = is_there(look);
        if (there) {
            found.dwell_s += look.end_s - look.begin_s;
            found.last_s += std::max(0.0, look.end_s - std::max(look.begin_s, -last_stretch_s));
            found.visits += was_there ? 0 : 1;
            if (!found.begin_s)
                found.begin_s = look.begin_s;
            found.is_first = found.is_first || i == 0;
            found.is_last = i + 1 == looks.size();
        }
        was_there = there;
    }
    return found;
}

/// The presentations of each answer, side by side.
std::vector<std::vector<const GazeBeforeAnswer*>> by_answer(const std::vector<GazeBeforeAnswer>& gaze) {
    std::vector<std::vector<const GazeBeforeAnswer*>> all;
    for (const GazeBeforeAnswer& one : gaze) {
        if (all.empty() || all.back().front()->answer != one.answer)
            all.emplace_back();
        all.back().push_back(&one);
    }
    return all;
}

/// Whether it is one of the slots that the trial shows something in.
bool is_of_slots(const StudyAnswer& answer) {
    return answer.shown.size() > 1 &&
           std::ranges::find(answer.shown, answer.value, &AnsweredStimulus::slot) != answer.shown.end();
}

std::optional<std::size_t> area_of(const StudyResults& results, int trial, const std::string& area) {
    const int object = results.trials[static_cast<std::size_t>(trial)].object;
    return results.objects[static_cast<std::size_t>(object)].areas.find(area);
}

bool is_on_area(const StudyResults& results, const GazeBeforeAnswer& of, std::size_t area,
                const StudyFixation& fixation) {
    const int object = results.trials[static_cast<std::size_t>(of.trial)].object;
    return fixation.part &&
           results.objects[static_cast<std::size_t>(object)].areas.holds(area, fixation.part);
}

/// Mean of numbers, as they come.
struct RunningMean {
    double sum = 0.0;
    int count = 0;
    void add(double value) {
        sum += value;
        ++count;
    }
    double value() const { return sum / count; }
};

struct SlotMeasure {
    const char* name;
    std::optional<double> (*value)(const AnswerGazeRow&);
};
constexpr SlotMeasure slot_measures[] = {
    {"dwell share", [](const AnswerGazeRow& row) { return row.dwell_share; }},
    {"share of the last second", [](const AnswerGazeRow& row) { return row.last_second_share; }},
    {"first look",
     [](const AnswerGazeRow& row) {
         return row.dwell_share ? std::optional(row.is_first ? 1.0 : 0.0) : std::nullopt;
     }},
    {"last look", [](const AnswerGazeRow& row) {
         return row.dwell_share ? std::optional(row.is_last ? 1.0 : 0.0) : std::nullopt;
     }}};

/// An observer's value and what it would be by chance.
struct ObserverChoice {
    double value = 0.0, chance = 0.0;
    int trials = 0;
};

std::optional<ObserverChoice> slot_choice(const std::vector<const AnswerGazeRow*>& own,
                                          const SlotMeasure& measure) {
    std::map<std::string, RunningMean> of_slot, chosen_of_slot;
    RunningMean chosen;
    for (const AnswerGazeRow* row : own) {
        const std::optional<double> value = measure.value(*row);
        if (!value || !row->is_chosen)
            continue;
        of_slot[row->slot].add(*value);
        chosen_of_slot[row->slot].add(*row->is_chosen ? 1.0 : 0.0);
        if (*row->is_chosen)
            chosen.add(*value);
    }
    if (chosen.count == 0)
        return std::nullopt;
    ObserverChoice found{chosen.value(), 0.0, chosen.count};
    for (const auto& [slot, mean] : of_slot)
        found.chance += chosen_of_slot[slot].value() * mean.value();
    return found;
}

/// Part of the time on stimuli that was spent on an area, before a and before b.
struct AreaChoice {
    double a = 0.0, b = 0.0;
    int trials = 0; ///< with an answer, whichever of its stimuli were looked at
};

std::optional<AreaChoice> area_choice(const std::vector<const AnswerGazeRow*>& own, const std::string& area,
                                      const auto& is_a, const auto& is_b) {
    RunningMean a, b;
    std::set<std::pair<int, int>> trials; ///< session and number
    const AnswerGazeRow* whole = nullptr;
    for (const AnswerGazeRow* row : own) {
        if (row->area.empty())
            whole = row;
        if (row->area != area || !whole || !(whole->dwell_s > 0.0))
            continue;
        if (is_a(*row))
            a.add(row->dwell_s / whole->dwell_s);
        else if (is_b(*row))
            b.add(row->dwell_s / whole->dwell_s);
        else
            continue;
        trials.emplace(row->session, row->trial);
    }
    if (a.count == 0 || b.count == 0)
        return std::nullopt;
    return AreaChoice{a.value(), b.value(), static_cast<int>(trials.size())};
}

/// The rows of an answer.
class GazeChoiceMaker {
  public:
    GazeChoiceMaker(std::vector<GazeChoiceRow>& rows, const AnswerOf& of,
                    std::map<std::string, std::vector<const AnswerGazeRow*>> observers,
                    const StudyOptions& options)
        : rows_(rows), of_(of), observers_(std::move(observers)), options_(options), from_(rows.size()) {}

    void add(GazeChoiceRow row, const auto& choice_of_observer) {
        row.of = of_;
        std::vector<double> values, differences;
        std::vector<GazeChoiceRow> single;
        double chance = 0.0;
        for (const auto& [observer, own] : observers_) {
            const std::optional<ObserverChoice> found = choice_of_observer(own);
            if (!found)
                continue;
            values.push_back(found->value);
            differences.push_back(found->value - found->chance);
            chance += found->chance;
            row.trials += found->trials;
            GazeChoiceRow& one = single.emplace_back(row);
            one.of.observer = observer;
            one.value = Estimate::of(found->value);
            one.chance = found->chance;
            one.observers = 1;
            one.trials = found->trials;
        }
        if (values.empty())
            return;
        row.observers = static_cast<int>(values.size());
        row.chance = chance / row.observers;
        row.value = estimated_mean(values, options_.bootstrap(), "");
        row.of_observers = values;
        if (const auto test = sign_flip_test(differences, options_.permutation()))
            row.p = test->p;
        row.evidence = options_.evidence(differences);
        rows_.push_back(std::move(row));
        std::ranges::move(single, std::back_inserter(single_));
    }

    void finish() {
        std::vector<double> tested;
        std::vector<GazeChoiceRow*> own;
        for (std::size_t i = from_; i < rows_.size(); ++i)
            if (rows_[i].p) {
                tested.push_back(*rows_[i].p);
                own.push_back(&rows_[i]);
            }
        const std::vector<double> after = holm(tested);
        for (std::size_t i = 0; i < own.size(); ++i)
            own[i]->p_holm = after[i];
        std::ranges::move(single_, std::back_inserter(rows_));
    }

  private:
    std::vector<GazeChoiceRow>& rows_;
    AnswerOf of_;
    std::map<std::string, std::vector<const AnswerGazeRow*>> observers_;
    const StudyOptions& options_;
    std::size_t from_;
    std::vector<GazeChoiceRow> single_;
};

} // namespace

std::vector<GazeBeforeAnswer> gaze_before_answers(const StudyResults& results) {
    std::map<std::pair<int, int>, std::vector<int>> presentations;
    for (std::size_t t = 0; t < results.trials.size(); ++t)
        if (!results.trials[t].excluded)
            presentations[{results.trials[t].session, results.trials[t].number}].push_back(
                static_cast<int>(t));
    std::vector<GazeBeforeAnswer> all;
    for (const StudyAnswer& answer : results.answers.given) {
        const auto found = presentations.find({answer.session, answer.trial});
        if (answer.is_missed || found == presentations.end())
            continue;
        for (const int trial : found->second) {
            const std::string& slot = results.trials[static_cast<std::size_t>(trial)].key("slot");
            const auto shown = answer.shown.size() == 1
                                   ? answer.shown.begin()
                                   : std::ranges::find(answer.shown, slot, &AnsweredStimulus::slot);
            if (shown == answer.shown.end() || !shown->until_answer_s)
                continue;
            GazeBeforeAnswer& gaze =
                all.emplace_back(GazeBeforeAnswer{&answer, trial, shown->slot, *shown->until_answer_s, {}});
            for_each_counted(results, trial, [&](const StudyFixation& fixation) {
                if (fixation.onset_s < gaze.until_s)
                    gaze.fixations.push_back(&fixation);
            });
        }
    }
    return all;
}

std::vector<AnswerGazeRow> answer_gaze(const StudyResults& results) {
    std::vector<AnswerGazeRow> rows;
    const std::vector<GazeBeforeAnswer> gaze = gaze_before_answers(results);
    for (const std::vector<const GazeBeforeAnswer*>& presentations : by_answer(gaze)) {
        const std::vector<LookBefore> looks = looks_before(presentations);
        const LookSummary all = summary_of(looks, [](const LookBefore&) { return true; });
        const StudyAnswer& answer = *presentations.front()->answer;
        const bool has_slots = asks_for_choice(answer) && is_of_slots(answer);
        for (std::size_t i = 0; i < presentations.size(); ++i) {
            const GazeBeforeAnswer& of = *presentations[i];
            const auto add = [&](const std::string& area, const auto& is_there) {
                const LookSummary found = summary_of(looks, is_there);
                AnswerGazeRow& row = rows.emplace_back();
                row.observer = answer.observer;
                row.task = answer.task;
                row.answer = answer.answer;
                row.item = answer.item;
                row.value = answer.value;
                row.session = answer.session;
                row.trial = answer.trial;
                row.slot = of.slot;
                row.area = area;
                if (has_slots)
                    row.is_chosen = of.slot == answer.value;
                row.until_s = of.until_s;
                row.dwell_s = found.dwell_s;
                if (all.dwell_s > 0.0)
                    row.dwell_share = found.dwell_s / all.dwell_s;
                if (all.last_s > 0.0)
                    row.last_second_share = found.last_s / all.last_s;
                row.visits = found.visits;
                row.is_first = found.is_first;
                row.is_last = found.is_last;
                if (found.begin_s)
                    row.first_arrival_s = of.until_s + *found.begin_s;
            };
            add("", [&](const LookBefore& look) { return look.presentation == i; });
            for (const std::string& area : results.compared_areas)
                if (const std::optional<std::size_t> index = area_of(results, of.trial, area))
                    add(area, [&](const LookBefore& look) {
                        return look.presentation == i && is_on_area(results, of, *index, *look.fixation);
                    });
        }
    }
    return rows;
}

std::vector<GazeChoiceRow> gaze_choices(const StudyResults& results, const StudyOptions& options) {
    // Of each answer the rows of each observer, in their order: an area's after those of the whole.
    struct Own {
        std::map<std::string, std::vector<const AnswerGazeRow*>> observers;
        std::set<std::string> values;
        bool has_slots = false;
    };
    std::map<AnswerOf, Own> answers;
    std::set<AnswerOf> of_choices;
    for (const StudyAnswer& one : results.answers.given)
        if (asks_for_choice(one))
            of_choices.insert({"", one.task, one.answer, one.item});
    for (const AnswerGazeRow& row : results.answers.gaze) {
        const AnswerOf of{"", row.task, row.answer, row.item};
        if (!of_choices.contains(of))
            continue;
        Own& own = answers[of];
        own.observers[row.observer].push_back(&row);
        own.values.insert(row.value);
        own.has_slots = own.has_slots || row.is_chosen.has_value();
    }
    std::vector<GazeChoiceRow> rows;
    for (auto& [of, own] : answers) {
        GazeChoiceMaker maker(rows, of, std::move(own.observers), options);
        if (own.has_slots) {
            for (const SlotMeasure& measure : slot_measures) {
                GazeChoiceRow row;
                row.measure = measure.name;
                maker.add(std::move(row), [&](const std::vector<const AnswerGazeRow*>& of_observer) {
                    std::vector<const AnswerGazeRow*> whole;
                    for (const AnswerGazeRow* one : of_observer)
                        if (one->area.empty())
                            whole.push_back(one);
                    return slot_choice(whole, measure);
                });
            }
        }
        const auto add_areas = [&](const std::string& a, const std::string& b, const auto& is_a,
                                   const auto& is_b) {
            for (const std::string& area : results.compared_areas) {
                GazeChoiceRow row;
                row.measure = "share of the time on the stimulus";
                row.area = area;
                row.a = a;
                row.b = b;
                maker.add(std::move(row),
                          [&](const std::vector<const AnswerGazeRow*>& of_observer)
                              -> std::optional<ObserverChoice> {
                              const auto found = area_choice(of_observer, area, is_a, is_b);
                              if (!found)
                                  return std::nullopt;
                              return ObserverChoice{found->a - found->b, 0.0, found->trials};
                          });
            }
        };
        if (own.has_slots) {
            add_areas(
                chosen_stimulus, other_stimulus,
                [](const AnswerGazeRow& row) { return row.is_chosen == true; },
                [](const AnswerGazeRow& row) { return row.is_chosen == false; });
        } else if (own.values.size() <= most_compared_choices) {
            for (auto a = own.values.begin(); a != own.values.end(); ++a)
                for (auto b = std::next(a); b != own.values.end(); ++b)
                    add_areas(
                        *a, *b, [&](const AnswerGazeRow& row) { return row.value == *a; },
                        [&](const AnswerGazeRow& row) { return row.value == *b; });
        }
        maker.finish();
    }
    return rows;
}

std::vector<DifferenceMap> answer_maps(const StudyResults& results, const ObjectFixationMaps& maps,
                                       const StudyOptions& options) {
    const std::vector<GazeBeforeAnswer> gaze = gaze_before_answers(results);
    // By answer, object, a and b: of each observer the fixations before either.
    using Of = std::tuple<std::string, std::string, std::string, int>;
    struct Fixated {
        std::map<std::string, std::map<std::string, Fixations>> observers; ///< by observer and value
        std::set<std::string> values;
    };
    std::map<Of, Fixated> answers;
    for (const GazeBeforeAnswer& one : gaze) {
        if (!asks_for_choice(*one.answer))
            continue;
        const int object = results.trials[static_cast<std::size_t>(one.trial)].object;
        Fixated& own = answers[{one.answer->task, one.answer->answer, one.answer->item, object}];
        const std::string value = !is_of_slots(*one.answer)       ? one.answer->value
                                  : one.slot == one.answer->value ? chosen_stimulus
                                                                  : other_stimulus;
        own.values.insert(value);
        Fixations& to = own.observers[one.answer->observer][value];
        to.insert(to.end(), one.fixations.begin(), one.fixations.end());
    }
    std::vector<ComparedLevels> all;
    for (const auto& [of, own] : answers) {
        const auto& [task, answer, item, object] = of;
        if (!maps[static_cast<std::size_t>(object)] || own.values.size() > most_compared_choices)
            continue;
        for (auto a = own.values.begin(); a != own.values.end(); ++a)
            for (auto b = std::next(a); b != own.values.end(); ++b) {
                DifferenceMap row;
                row.keys = {{"task", task}};
                row.object = object;
                row.column = item.empty() ? answer : answer + " " + item;
                row.a = *a;
                row.b = *b;
                std::vector<ComparedFixations> compared;
                for (const auto& [observer, by_value] : own.observers) {
                    const auto in_a = by_value.find(*a), in_b = by_value.find(*b);
                    if (in_a != by_value.end() && in_b != by_value.end() && !in_a->second.empty() &&
                        !in_b->second.empty())
                        compared.push_back({observer, in_a->second, in_b->second});
                }
                if (!compared.empty())
                    all.push_back({std::move(row), std::move(compared)});
            }
    }
    return find_differences(std::move(all), maps, options, "one observer alone gave both answers");
}

} // namespace overt
