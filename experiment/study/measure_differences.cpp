#include "experiment/study/measure_differences.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "experiment/statistics/bootstrap.h"
#include "experiment/statistics/permutation.h"
#include "experiment/study/area_looks.h"
#include "experiment/study/gaze_motion.h"
#include "experiment/study/surface_transitions.h"

namespace overt {

namespace {

MeasureSums once(const std::optional<double>& value) {
    return value ? MeasureSums{*value, 1.0} : MeasureSums{};
}

const StudyTrial& trial_at(const StudyResults& results, int trial) {
    return results.trials[static_cast<std::size_t>(trial)];
}

void add_area_measures(std::vector<MeasureOfTrials>& to, const StudyResults& results,
                       const std::string& area) {
    const auto add = [&](const char* name, const char* unit, auto of_look) {
        to.push_back({name, area, unit, [&results, area, of_look](int trial) {
                          const StudyTrial& of = trial_at(results, trial);
                          const std::optional<SurfaceAreaLook> look = area_look(results, of, area);
                          return look ? of_look(*look, of) : MeasureSums{};
                      }});
    };
    using Look = SurfaceAreaLook;
    add("dwell_s", "s", [](const Look& look, const StudyTrial&) { return once(look.dwell_s); });
    add("visits", "", [](const Look& look, const StudyTrial&) { return once(look.visits); });
    add("visit_s", "s", [](const Look& look, const StudyTrial&) {
        return MeasureSums{look.dwell_s, static_cast<double>(look.visits)};
    });
    add("reached", "",
        [](const Look& look, const StudyTrial&) { return once(look.first_arrival_s ? 1.0 : 0.0); });
    add("first_arrival_s", "s", [](const Look& look, const StudyTrial& trial) {
        return once(look.first_arrival_s.value_or(trial.presentation_s));
    });
}

void add_transitions(std::vector<MeasureOfTrials>& to, const StudyResults& results) {
    for (const std::string& from : results.compared_areas) {
        for (const std::string& next : results.compared_areas) {
            to.push_back(
                {"transition", fmt::format("{} > {}", from, next), "", [&results, from, next](int trial) {
                     const TransitionCount count = transitions_between(results, trial, from, next);
                     return MeasureSums{static_cast<double>(count.to), static_cast<double>(count.departures)};
                 }});
        }
    }
}

/// Sums over a trial's counted fixations.
template <class OfFixation>
std::function<MeasureSums(int)> over_fixations(const StudyResults& results, OfFixation of_fixation) {
    return [&results, of_fixation](int trial) {
        MeasureSums sums;
        for_each_counted(results, trial,
                         [&](const StudyFixation& fixation) { sums.add(of_fixation(fixation)); });
        return sums;
    };
}

void add_gains(std::vector<MeasureOfTrials>& to, const StudyResults& results) {
    to.push_back({"surface_gain", "", "", over_fixations(results, [](const StudyFixation& fixation) {
                      return sees_surface_move(fixation)
                                 ? MeasureSums{fixation.duration_s * fixation.gaze_with_surface_deg2,
                                               fixation.duration_s * fixation.surface_way_deg2}
                                 : MeasureSums{};
                  })});
    to.push_back({"corrected_gain", "", "", over_fixations(results, [](const StudyFixation& fixation) {
                      const auto& displaced = fixation.displaced_motion;
                      if (!displaced || !sees_surface_move(fixation))
                          return MeasureSums{};
                      return MeasureSums{fixation.duration_s * (2.0 * fixation.gaze_with_surface_deg2 -
                                                                displaced->gaze_with_surface_deg2),
                                         fixation.duration_s *
                                             (2.0 * fixation.surface_way_deg2 - displaced->surface_way_deg2),
                                         least_way_left * fixation.duration_s * fixation.surface_way_deg2};
                  })});
}

void add_light(std::vector<MeasureOfTrials>& to, const StudyResults& results) {
    const auto add = [&](const char* name, auto of_light) {
        to.push_back({name, "", "", over_fixations(results, [of_light](const StudyFixation& fixation) {
                          return fixation.light ? MeasureSums{fixation.duration_s * of_light(*fixation.light),
                                                              fixation.duration_s}
                                                : MeasureSums{};
                      })});
    };
    add("lightness", [](const FixationLight& light) { return light.met; });
    add("over_place", [](const FixationLight& light) { return light.met - light.at_place; });
    add("over_point", [](const FixationLight& light) { return light.met - light.at_point; });
}

/// What is compared with each other: an observer's trials on an object, alike in the other columns.
struct MeasureCell {
    std::string observer;
    std::vector<std::string> alike;
    auto operator<=>(const MeasureCell&) const = default;
};

/// By cell, of all trials that count: a trial's level, and its number.
using MeasureCells = std::map<MeasureCell, std::vector<std::pair<std::string, int>>>;

MeasureCells cells_of_measures(const StudyResults& results, const StudyOptions& options) {
    MeasureCells cells;
    for (int trial = 0; trial < static_cast<int>(results.trials.size()); ++trial) {
        const StudyTrial& of = trial_at(results, trial);
        if (of.excluded)
            continue;
        MeasureCell cell{observer_of(results, trial), {std::to_string(of.object)}};
        for (const std::string& column : options.by) {
            if (column != options.compare && column != "object")
                cell.alike.push_back(of.key(column));
        }
        cells[std::move(cell)].emplace_back(of.key(options.compare), trial);
    }
    return cells;
}

MeasureDifferenceRow difference_row(const MeasureOfTrials& measure, const MeasureCells& cells,
                                    const std::string& a, const std::string& b, const StudyOptions& options) {
    MeasureDifferenceRow row;
    row.measure = measure.name;
    row.of = measure.of;
    row.unit = measure.unit;
    row.column = options.compare;
    row.a = a;
    row.b = b;
    std::map<std::string, std::pair<double, int>> of_observers;
    for (const auto& [cell, trials] : cells) {
        MeasureSums in_a, in_b;
        for (const auto& [level, trial] : trials) {
            if (level == a)
                in_a.add(measure.sums(trial));
            else if (level == b)
                in_b.add(measure.sums(trial));
        }
        if (!in_a.tells() || !in_b.tells())
            continue;
        auto& [sum, count] = of_observers[cell.observer];
        sum += in_a.sum / in_a.weight - in_b.sum / in_b.weight;
        ++count;
        ++row.comparisons;
    }
    std::vector<double> differences;
    for (const auto& [observer, of] : of_observers)
        differences.push_back(of.first / of.second);
    row.observers = static_cast<int>(differences.size());
    row.difference =
        estimated_mean(differences, options.bootstrap(), "no observer has the measure in both levels");
    if (const auto test = sign_flip_test(differences, options.permutation()))
        row.p = test->p;
    row.evidence = options.evidence(differences);
    return row;
}

void correct_measures(std::vector<MeasureDifferenceRow>& rows) {
    std::map<std::string, std::vector<MeasureDifferenceRow*>> of_measures;
    for (MeasureDifferenceRow& row : rows) {
        if (row.p)
            of_measures[row.measure].push_back(&row);
    }
    for (const auto& [measure, own] : of_measures) {
        std::vector<double> p;
        for (const MeasureDifferenceRow* row : own)
            p.push_back(*row->p);
        const std::vector<double> corrected = holm(p);
        for (std::size_t i = 0; i < own.size(); ++i)
            own[i]->p_holm = corrected[i];
    }
}

} // namespace

std::vector<MeasureOfTrials> looking_measures(const StudyResults& results) {
    std::vector<MeasureOfTrials> measures;
    for (const std::string& area : results.compared_areas)
        add_area_measures(measures, results, area);
    add_transitions(measures, results);
    add_gains(measures, results);
    add_light(measures, results);
    return measures;
}

std::vector<MeasureDifferenceRow> measure_differences(const StudyResults& results,
                                                      const std::vector<MeasureOfTrials>& measures,
                                                      const LevelLists& levels, const StudyOptions& options) {
    const std::vector<std::string> compared = levels_of(results, options.compare, levels);
    const MeasureCells cells = cells_of_measures(results, options);
    std::vector<MeasureDifferenceRow> rows;
    for (const MeasureOfTrials& measure : measures) {
        for (std::size_t a = 0; a < compared.size(); ++a) {
            for (std::size_t b = a + 1; b < compared.size(); ++b) {
                MeasureDifferenceRow row = difference_row(measure, cells, compared[a], compared[b], options);
                if (row.comparisons > 0)
                    rows.push_back(std::move(row));
            }
        }
    }
    correct_measures(rows);
    return rows;
}

} // namespace overt
