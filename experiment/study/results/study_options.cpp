#include "experiment/study/results/study_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace overt {

namespace {

std::string same_observers(const StudyOptions& options) {
    std::string text;
    for (const auto& [label, other] : options.same_observer)
        text += fmt::format("{}{}={}", text.empty() ? "" : ",", label, other);
    return text.empty() ? "none" : text;
}

std::string number_or_none(const auto& limit) { return limit ? fmt::format("{}", *limit) : "none"; }

} // namespace

std::vector<StudyParameter> parameters_of(const StudyOptions& options) {
    const ExclusionRules& rules = options.exclude;
    return {
        {"by", fmt::format("{}", fmt::join(options.by, ",")), "",
         "Columns of the table of trials whose values make the groups."},
        {"compare", options.compare, "", "The column whose levels are compared within observers."},
        {"sigma", fmt::format("{}", options.sigma.value), options.sigma.is_mm ? "mm" : "deg",
         "Standard deviation of the maps' kernel: millimetres of the object itself, or degrees of visual "
         "angle, which "
         "are converted at the depth of each fixation."},
        {"kernel", std::string(name_of(options.kernel)), "",
         "How maps are blurred: geodesic is heat along the surface, euclidean a Gaussian in space on the "
         "vertices, voxel the same on a grid."},
        {"shortest-fixation", fmt::format("{}", options.shortest_fixation_s), "s",
         "Fixations shorter than this are not counted."},
        {"least-on-surface", fmt::format("{}", options.least_on_surface), "",
         "Share of a fixation's samples that must meet the sculpture, or miss it by no more than the reach, "
         "for it "
         "to be counted."},
        {"reach", options.reach_deg ? fmt::format("{}", *options.reach_deg) : "accuracy",
         options.reach_deg ? "deg" : "",
         "A sample that misses the sculpture by no more than this counts at the nearest place of its "
         "outline; "
         "accuracy: the mean error of the validation before the trial, 0 if there was none."},
        {"most-lost", number_or_none(rules.most_lost_share), "",
         "Trials that lost a larger share of their samples, blinks apart, are excluded."},
        {"most-accuracy", number_or_none(rules.most_accuracy_deg), "deg",
         "Trials after a validation with a larger mean error are excluded."},
        {"most-drift", number_or_none(rules.most_drift_deg), "deg",
         "Trials with a larger error at the drift check are excluded."},
        {"most-missed", number_or_none(rules.most_missed_refreshes), "refreshes",
         "Trials with more missed refreshes are excluded."},
        {"same-observer", same_observers(options), "",
         "Labels of observers that stand for another observer's, whose sessions are then counted as one "
         "person's."},
        {"time-step", fmt::format("{}", options.time_step_s), "s", "Stretches of the time course."},
        {"confidence", fmt::format("{}", options.confidence), "", "Level of all intervals."},
        {"resamples", fmt::format("{}", options.resamples), "",
         "Draws of the bootstrap over observers (BCa)."},
        {"permutations", fmt::format("{}", options.permutations), "",
         "Random permutations, where there are too many to make all."},
        {"splits", fmt::format("{}", options.splits), "", "Random splits into halves."},
        {"seed", fmt::format("{}", options.seed), "", "Seed of all that is drawn at random."},
    };
}

} // namespace overt
