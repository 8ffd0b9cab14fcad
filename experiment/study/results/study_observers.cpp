#include "experiment/study/results/study_observers.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/counted.h"
#include "experiment/observer_label.h"
#include "experiment/study/results/study_groups.h"

namespace overt {

namespace {

/// Why an observer is not in N; empty: is.
std::string why_not_counted(const StudyResults& results, const std::string& label) {
    int trials = 0, with_gaze = 0, counted_trials = 0;
    for (int t = 0; t < static_cast<int>(results.trials.size()); ++t) {
        if (observer_of(results, t) != label)
            continue;
        const StudyTrial& trial = results.trials[static_cast<std::size_t>(t)];
        ++trials;
        with_gaze += trial.has_gaze;
        counted_trials += !trial.excluded;
    }
    return trials == 0           ? "no trial came to its end"
           : with_gaze == 0      ? "no gaze was recorded in any trial"
           : counted_trials == 0 ? "all trials are excluded"
                                 : "";
}

} // namespace

std::vector<StudyObserver> study_observers(const StudyResults& results) {
    std::vector<StudyObserver> observers;
    for (const StudySession& session : results.sessions) {
        auto found = std::ranges::find(observers, session.observer, &StudyObserver::label);
        if (found == observers.end()) {
            observers.push_back(
                {session.observer, false, why_not_counted(results, session.observer), {}, 0, 0, 0});
            found = observers.end() - 1;
            found->counts = found->why.empty();
        }
        ++found->sessions;
    }
    for (int t = 0; t < static_cast<int>(results.trials.size()); ++t) {
        const auto of = std::ranges::find(observers, observer_of(results, t), &StudyObserver::label);
        if (of == observers.end() || results.trials[static_cast<std::size_t>(t)].excluded)
            continue;
        ++of->trials;
        for_each_counted(results, t, [&](const StudyFixation&) { ++of->fixations; });
    }
    for (StudyObserver& one : observers)
        for (const StudyObserver& other : observers)
            if (are_alike(one.label, other.label))
                one.alike.push_back(other.label);
    return observers;
}

std::vector<std::string> remarks_on_observers(const std::vector<StudyObserver>& observers) {
    std::vector<std::string> remarks;
    const auto counting = std::ranges::count_if(observers, &StudyObserver::counts);
    std::vector<std::string> left_out, without_fixations;
    for (const StudyObserver& one : observers) {
        if (!one.counts)
            left_out.push_back(fmt::format("{} ({})", one.label, one.why));
        else if (one.fixations == 0)
            without_fixations.push_back(one.label);
    }
    if (!left_out.empty())
        remarks.push_back(fmt::format("N is {} of {} who were given. Not counted: {}.", counting,
                                      counted(observers.size(), "observer"), fmt::join(left_out, ", ")));
    if (!without_fixations.empty() && static_cast<std::ptrdiff_t>(without_fixations.size()) < counting)
        remarks.push_back(
            fmt::format("Of observer {} there is gaze and no counted fixation: N has them, and the "
                        "means over observers do not.",
                        fmt::join(without_fixations, ", ")));
    for (const StudyObserver& one : observers) {
        if (one.alike.empty() ||
            std::ranges::any_of(one.alike, [&](auto& other) { return other < one.label; }))
            continue; // said of the first of them
        std::vector<std::string> options;
        for (const std::string& other : one.alike)
            options.push_back(fmt::format("--same-observer {}={}", other, one.label));
        remarks.push_back(fmt::format("Observers {} and {} count as different people, though their labels "
                                      "differ in case or leading zeros "
                                      "only. If they are one person, analyse again with {}.",
                                      one.label, fmt::join(one.alike, " and "), fmt::join(options, " ")));
    }
    return remarks;
}

} // namespace overt
