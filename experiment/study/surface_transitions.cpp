#include "experiment/study/surface_transitions.h"

#include <algorithm>
#include <utility>

namespace overt {

namespace {

const std::string no_departure = "no fixation followed one on the first area";

/// Of one observer between two areas.
struct TransitionCounts {
    int all = 0;     ///< on objects with both areas
    int next = 0;    ///< of these to the second
    int from = 0;    ///< from the first
    int from_to = 0; ///< from the first to the second
};

/// The parts of successive fixations of an observer, by object: transitions alike are counted together.
struct PartTransitions {
    int object = 0;
    std::vector<int> counts; ///< by part of the one times the number of parts plus part of the next
};

std::vector<PartTransitions> part_transitions(const StudyResults& results, const std::vector<int>& trials) {
    std::vector<PartTransitions> found;
    for (const int index : trials) {
        const StudyTrial& trial = results.trials[static_cast<std::size_t>(index)];
        const std::size_t parts = results.objects[static_cast<std::size_t>(trial.object)].part_names.size();
        auto own = std::ranges::find(found, trial.object, &PartTransitions::object);
        if (own == found.end())
            own = found.insert(found.end(), {trial.object, std::vector<int>(parts * parts, 0)});
        constexpr int none = -1;
        int before = none;
        for (std::size_t i = trial.first_fixation; i < trial.first_fixation + trial.fixations; ++i) {
            const StudyFixation& fixation = results.fixations[i];
            if (fixation.why == NotCounted::not_on_surface)
                before = none;
            if (!fixation.counted())
                continue;
            if (before != none && fixation.part)
                ++own->counts[static_cast<std::size_t>(before) * parts + *fixation.part];
            before = fixation.part ? int{*fixation.part} : none;
        }
    }
    return found;
}

TransitionCounts counts_between(const StudyResults& results, const std::vector<PartTransitions>& of,
                                const std::string& from, const std::string& to) {
    TransitionCounts counts;
    for (const PartTransitions& one : of) {
        const StudyObject& object = results.objects[static_cast<std::size_t>(one.object)];
        const std::optional<std::size_t> a = object.areas.find(from), b = object.areas.find(to);
        if (!a || !b)
            continue;
        const std::size_t parts = object.part_names.size();
        for (std::size_t i = 0; i < one.counts.size(); ++i) {
            const bool is_from = object.areas.holds(*a, static_cast<PartIndex>(i / parts)),
                       is_to = object.areas.holds(*b, static_cast<PartIndex>(i % parts));
            counts.all += one.counts[i];
            counts.next += is_to ? one.counts[i] : 0;
            counts.from += is_from ? one.counts[i] : 0;
            counts.from_to += is_from && is_to ? one.counts[i] : 0;
        }
    }
    return counts;
}

} // namespace

TransitionCount transitions_between(const StudyResults& results, int trial, const std::string& from,
                                    const std::string& to) {
    const TransitionCounts counts = counts_between(results, part_transitions(results, {trial}), from, to);
    return {counts.from_to, counts.from};
}

std::vector<SurfaceTransitionRow> surface_transitions(const StudyResults& results, const LevelLists& order,
                                                      const StudyOptions& options) {
    std::vector<SurfaceTransitionRow> rows;
    for (const StudyGroup& group : all_and_levels(results, results.by, order)) {
        std::vector<std::vector<PartTransitions>> observers;
        for (const auto& [observer, own] : by_observer(results, group.trials))
            observers.push_back(part_transitions(results, own));
        for (const std::string& from : results.areas) {
            for (const std::string& to : results.areas) {
                SurfaceTransitionRow row;
                row.keys = group.keys;
                row.from = from;
                row.to = to;
                std::vector<double> probabilities, chances, differences;
                bool is_on_one_object = false;
                for (const StudyObject& object : results.objects)
                    is_on_one_object = is_on_one_object || (object.areas.has(from) && object.areas.has(to));
                if (!is_on_one_object)
                    continue;
                for (const std::vector<PartTransitions>& observer : observers) {
                    const TransitionCounts counts = counts_between(results, observer, from, to);
                    row.transitions += counts.from_to;
                    row.departures += counts.from;
                    if (counts.from == 0)
                        continue;
                    probabilities.push_back(static_cast<double>(counts.from_to) / counts.from);
                    chances.push_back(static_cast<double>(counts.next) / counts.all);
                    differences.push_back(probabilities.back() - chances.back());
                }
                row.observers = static_cast<int>(probabilities.size());
                const auto mean = [&](const std::vector<double>& values, Interval range) {
                    return estimated_mean(values, options.bootstrap(), no_departure, range);
                };
                row.probability = mean(probabilities, zero_to_one);
                row.chance = mean(chances, zero_to_one);
                row.over_chance = mean(differences, {-1.0, 1.0});
                rows.push_back(std::move(row));
            }
        }
    }
    return rows;
}

} // namespace overt
