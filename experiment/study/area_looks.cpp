#include "experiment/study/area_looks.h"

#include <algorithm>
#include <string>

#include "experiment/statistics/area_visits.h"

namespace overt {

namespace {

const std::string no_such_trial = "no trial's object has this area";
const std::string never_reached = "no trial's gaze reached this area";

/// Sums of an observer's trials.
struct LookSums {
    double dwell_s = 0.0, first_arrival_s = 0.0, first_arrival_number = 0.0;
    int trials = 0, visits = 0, arrivals = 0;

    void add(const SurfaceAreaLook& look, double presentation_s) {
        ++trials;
        dwell_s += look.dwell_s;
        visits += look.visits;
        first_arrival_s += look.first_arrival_s.value_or(presentation_s);
        if (look.first_arrival_s) {
            ++arrivals;
            first_arrival_number += look.first_arrival_number;
        }
    }
};

} // namespace

std::optional<SurfaceAreaLook> area_look(const StudyResults& results, const StudyTrial& trial,
                                         std::string_view area) {
    const StudyObject& object = results.objects[static_cast<std::size_t>(trial.object)];
    const std::optional<std::size_t> of = object.areas.find(area);
    if (!of)
        return std::nullopt;
    SurfaceAreaLook look;
    std::vector<AreaLook> looks;
    int number = 0;
    for (std::size_t i = trial.first_fixation; i < trial.first_fixation + trial.fixations; ++i) {
        const StudyFixation& fixation = results.fixations[i];
        if (!fixation.counted() && fixation.why != NotCounted::not_on_surface)
            continue;
        number += fixation.counted();
        const bool is_on_it = fixation.counted() && object.areas.holds(*of, fixation.part);
        if (is_on_it && look.first_arrival_number == 0)
            look.first_arrival_number = number;
        looks.push_back({fixation.onset_s, fixation.duration_s,
                         is_on_it ? std::vector<std::size_t>{0} : std::vector<std::size_t>()});
    }
    const AreaVisits found = area_visits(looks, 1).front();
    look.dwell_s = found.dwell_s;
    look.visits = found.visits;
    look.first_arrival_s = found.first_arrival_s;
    return look;
}

void add_looks(AreaRow& row, const StudyResults& results,
               std::span<const std::vector<int>> trials_of_observers, const BootstrapSettings& bootstrap) {
    std::vector<double> dwell, visits, visit, reached, arrival, number;
    for (const std::vector<int>& own : trials_of_observers) {
        LookSums sums;
        for (const int trial : own) {
            const StudyTrial& of = results.trials[static_cast<std::size_t>(trial)];
            if (const std::optional<SurfaceAreaLook> look = area_look(results, of, row.area))
                sums.add(*look, of.presentation_s);
        }
        row.looks += sums.trials;
        row.arrivals += sums.arrivals;
        if (sums.trials == 0)
            continue;
        const double trials = sums.trials;
        dwell.push_back(sums.dwell_s / trials);
        visits.push_back(sums.visits / trials);
        reached.push_back(sums.arrivals / trials);
        arrival.push_back(sums.first_arrival_s / trials);
        if (sums.visits > 0)
            visit.push_back(sums.dwell_s / sums.visits);
        if (sums.arrivals > 0)
            number.push_back(sums.first_arrival_number / sums.arrivals);
    }
    row.dwell_s = estimated_mean(dwell, bootstrap, no_such_trial, from_zero_on);
    row.visits = estimated_mean(visits, bootstrap, no_such_trial, from_zero_on);
    row.visit_s =
        estimated_mean(visit, bootstrap, dwell.empty() ? no_such_trial : never_reached, from_zero_on);
    row.reached = estimated_mean(reached, bootstrap, no_such_trial, zero_to_one);
    row.first_arrival_s = estimated_mean(arrival, bootstrap, no_such_trial, from_zero_on);
    // The first fixation there can be has the number 1.
    row.first_arrival_number = estimated_mean(
        number, bootstrap, dwell.empty() ? no_such_trial : never_reached, {1.0, from_zero_on.high});
}

} // namespace overt
