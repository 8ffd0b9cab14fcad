/// What holds of a study's sessions and trials together: the numbers of its sentences on methods, of the list
/// of what an article has to report, and of study.json.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiment/study/results/study_results.h"

namespace overt {

/// How many trials the study's presentations are of: a trial that shows several stimuli has several.
std::int64_t trials_of_presentations(const StudyResults& results);

/// What StudyResults::trials are in words: "trial", or "presentation" where trials show several stimuli.
std::string_view unit_of_gaze(const StudyResults& results);

/// Each value that sessions have, once, in the order of the sessions, with how many have it.
template <class Of> auto over_sessions(const StudyResults& results, const Of& of) {
    std::vector<std::pair<std::decay_t<std::invoke_result_t<Of, const StudySession&>>, int>> values;
    for (const StudySession& session : results.sessions) {
        auto value = std::invoke(of, session);
        const auto found =
            std::ranges::find_if(values, [&](const auto& known) { return known.first == value; });
        if (found == values.end())
            values.emplace_back(std::move(value), 1);
        else
            ++found->second;
    }
    return values;
}

/// Of a number that trials have: those that are not excluded, as far as they have it.
struct Spread {
    double median = 0.0, least = 0.0, most = 0.0;
    int trials = 0;
    std::string_view thing = "trial"; ///< what it is counted over: see unit_of_gaze
};

/// A number that each trial has, or has not.
struct TrialMeasure {
    std::string_view name; ///< in study.json, with its unit
    std::string_view item; ///< in the list of what to report
    std::string_view unit; ///< "deg", "%", "Hz"
    int decimals = 3;      ///< more say nothing
    std::optional<double> (*of)(const StudyTrial&);
    std::string_view if_missing; ///< why no trial has it
};
enum class TrialMeasureOf : std::uint8_t {
    accuracy,
    drift,
    rms_s2s,
    sd,
    lost,
    in_blinks,
    rate,
    presentation
};
/// By TrialMeasureOf.
extern const std::array<TrialMeasure, 8> trial_measures;
const TrialMeasure& trial_measure(TrialMeasureOf which);

/// Nothing if no trial has it.
std::optional<Spread> spread_over_trials(const StudyResults& results, const TrialMeasure& of);

/// Observers, and how many of them have sessions of simulated gaze only.
struct ObserverCounts {
    int all = 0, simulated = 0;
};
ObserverCounts observer_counts(const StudyResults& results);

/// Refreshes of the presentations of trials that are not excluded.
struct RefreshCounts {
    int refreshes = 0;
    std::optional<int> missed = 0; ///< nothing: of some it is not proven
};
RefreshCounts refresh_counts(const StudyResults& results);

/// Sessions in which not all trials were run.
int incomplete_sessions(const StudyResults& results);

/// Maps that there are, of each weighting alike, and the standard deviations of their kernel over the
/// fixations.
struct MapCounts {
    int maps = 0;
    double least_sigma_mm = 0.0, most_sigma_mm = 0.0;
};
/// Nothing if there is none.
std::optional<MapCounts> map_counts(const StudyResults& results);

/// Set-ups of the tracker of all sessions, by method; those of simulated gaze apart.
std::vector<SessionSetup::Calibrations> calibrations_of(const StudyResults& results);

/// What observers said of themselves in one field of the form; an observer with several sessions counts once
/// with each value.
struct FormField {
    std::string field;
    int observers = 0;
    std::optional<Spread> numbers;                   ///< if all values are; its `trials` are observers
    std::vector<std::pair<std::string, int>> values; ///< else: each value, with how many observers say so
};
std::vector<FormField> form_fields(const StudyResults& results);

/// What was shown and asked in the trials: ids with titles, in the order of the protocols.
std::vector<NamedThing> objects_shown(const StudyResults& results);
std::vector<NamedThing> materials_shown(const StudyResults& results);
std::vector<NamedThing> tasks_asked(const StudyResults& results);

} // namespace overt
