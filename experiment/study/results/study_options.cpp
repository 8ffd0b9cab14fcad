#include "experiment/study/results/study_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace overt {

namespace {

std::string models_of(const StudyOptions& options) {
    std::string files;
    for (const ModelFile& model : options.models)
        files += (files.empty() ? "" : ", ") + (model.object.empty() ? "" : model.object + "=") +
                 model.file.filename().string();
    return files.empty() ? "none" : files;
}

std::string landmarks_of(const StudyOptions& options) {
    if (options.onto.object.empty())
        return "none";
    if (!options.onto.file.empty())
        return options.onto.file;
    return options.onto.lists.empty() ? "areas" : fmt::format("{}", fmt::join(options.onto.lists, ","));
}

std::string same_observers(const StudyOptions& options) {
    std::string text;
    for (const auto& [label, other] : options.same_observer)
        text += fmt::format("{}{}={}", text.empty() ? "" : ",", label, other);
    return text.empty() ? "none" : text;
}

std::string number_or_none(const auto& limit) { return limit ? fmt::format("{}", *limit) : "none"; }

std::string words_of(const std::optional<ChosenThresholds>& detect_events) {
    if (!detect_events)
        return "no";
    std::string words;
    for (std::size_t i = 0; i < event_thresholds.size(); ++i)
        if (const std::optional<double>& value = detect_events->values[i])
            words += fmt::format("{}{} {}", words.empty() ? "" : ", ", event_thresholds[i].key, *value);
    return words.empty() ? "usual thresholds" : words;
}

} // namespace

std::vector<ExclusionRule> rules_of(const ExclusionRules& rules) {
    std::vector<ExclusionRule> set;
    if (rules.most_lost_share)
        set.push_back(ExclusionRule::lost_share);
    if (rules.most_accuracy_deg)
        set.push_back(ExclusionRule::accuracy);
    if (rules.most_drift_deg)
        set.push_back(ExclusionRule::drift);
    if (rules.most_missed_refreshes)
        set.push_back(ExclusionRule::missed_refreshes);
    return set;
}

std::optional<ExclusionRule> broken_rule(const StudyQuality& quality, const ExclusionRules& rules) {
    const auto is_beyond = [](const auto& value, const auto& limit) {
        return limit && value && *value > *limit;
    };
    if (rules.most_lost_share && quality.lost_share() > *rules.most_lost_share)
        return ExclusionRule::lost_share;
    if (is_beyond(quality.accuracy_deg, rules.most_accuracy_deg))
        return ExclusionRule::accuracy;
    if (is_beyond(quality.drift_deg, rules.most_drift_deg))
        return ExclusionRule::drift;
    // A rule that cannot be looked at is not kept.
    if (rules.most_missed_refreshes &&
        (!quality.missed_refreshes || *quality.missed_refreshes > *rules.most_missed_refreshes))
        return ExclusionRule::missed_refreshes;
    return std::nullopt;
}

std::vector<StudyParameter> parameters_of(const StudyOptions& options) {
    const ExclusionRules& rules = options.exclude;
    return {
        {"by", fmt::format("{}", fmt::join(options.by, ",")), "",
         "Columns of the table of trials whose values make the groups."},
        {"compare", options.compare, "", "The column whose levels are compared within observers."},
        {"area", options.areas.empty() ? "all" : fmt::format("{}", fmt::join(options.areas, ",")), "",
         "Areas whose shares are compared and corrected over; the first of several names is that of figure "
         "4."},
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
         "Share of a fixation's samples that must meet the object, or miss it by no more than the reach, "
         "for it "
         "to be counted."},
        {"reach", options.reach_deg ? fmt::format("{}", *options.reach_deg) : "accuracy",
         options.reach_deg ? "deg" : "",
         "A sample that misses the object by no more than this counts at the nearest place of its "
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
        {"detect-events", words_of(options.detect_events), "",
         "Whether fixations, saccades and blinks were found anew in the samples of all sessions, and the "
         "thresholds that were chosen for it; others go with each recording's rate and noise. no: those on "
         "record, and found where an imported recording has none."},
        {"same-observer", same_observers(options), "",
         "Labels of observers that stand for another observer's, whose sessions are then counted as one "
         "person's."},
        {"areas", options.screen_areas_file.empty() ? "none" : options.screen_areas_file, "",
         "File with areas of the screen, besides those that imported recordings tell by messages."},
        {"model", models_of(options), "",
         "Files with maps of models, which are held against observers: numbers at the vertices of a mesh."},
        {"template", options.onto.object.empty() ? "none" : options.onto.object, "",
         "The object to whose surface gaze on all objects is brought."},
        {"landmarks", landmarks_of(options), "",
         "By which places that correspond: lists of [[points]] of the protocol, a file, or the middles of "
         "the "
         "areas that objects have in common."},
        {"time-step", fmt::format("{}", options.time_step_s), "s", "Stretches of the time course."},
        {"confidence", fmt::format("{}", options.confidence), "", "Level of all intervals."},
        {"smallest-effect", fmt::format("{}", options.smallest_effect), "",
         "Smallest effect size of interest, in standard deviations of observers' differences: the bounds of "
         "tests of equivalence."},
        {"resamples", fmt::format("{}", options.resamples), "",
         "Draws of the bootstrap over observers (BCa)."},
        {"permutations", fmt::format("{}", options.permutations), "",
         "Random permutations, where there are too many to make all."},
        {"tfce", options.threshold_free ? "yes" : "no", "",
         "Whether maps of differences are tested without a threshold, too (threshold-free cluster "
         "enhancement)."},
        {"seed", fmt::format("{}", options.seed), "", "Seed of all that is drawn at random."},
    };
}

} // namespace overt
