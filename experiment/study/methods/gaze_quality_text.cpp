#include <fmt/format.h>

#include "experiment/study/methods/methods_topics.h"
#include "experiment/study/methods/sentences.h"

namespace overt {

namespace {

std::string spread_text(const StudyResults& results, TrialMeasureOf which) {
    const TrialMeasure& of = trial_measure(which);
    const std::optional<Spread> spread = spread_over_trials(results, of);
    return spread ? as_spread(*spread, of.unit, of.decimals) : std::string();
}

/// Who calibrated, of a session's method: "tracker", "tracker, 9 points", "polynomial, 9 points".
std::string calibrator_of(const std::string& method, bool is_simulated) {
    const std::string tracker = is_simulated ? "the simulated eye tracker" : "the eye tracker itself";
    constexpr std::string_view by_tracker = "tracker";
    if (method == by_tracker)
        return "by " + tracker;
    if (method.starts_with("tracker, "))
        return fmt::format("by {} ({})", tracker, method.substr(by_tracker.size() + 2));
    return method.empty() ? std::string() : fmt::format("by overt ({})", method);
}

void add_calibrations(std::string& text, const StudyResults& results) {
    int times = 0, beyond = 0;
    std::vector<std::string> methods;
    for (const SessionSetup::Calibrations& one : calibrations_of(results)) {
        times += one.times;
        beyond += one.beyond_limits;
        const std::string by = calibrator_of(one.method, one.is_simulated);
        methods.push_back(fmt::format("{}{}{}", as_counted(one.times, "time"), by.empty() ? "" : " ", by));
    }
    if (times == 0) {
        add_sentence(text, "no calibration is on record");
        return;
    }
    add_sentence(text, fmt::format("gaze was calibrated {}", joined_words(methods)));
    if (beyond > 0)
        add_sentence(text, fmt::format("{} {} accepted though the validation was beyond the limits of the "
                                       "protocol",
                                       share_of(beyond, times, "calibration"), beyond == 1 ? "was" : "were"));
}

void add_losses(std::string& text, const StudyResults& results) {
    const std::string lost = spread_text(results, TrialMeasureOf::lost);
    if (lost.empty()) {
        add_sentence(text, "there are no samples of gaze");
        return;
    }
    add_sentence(text, fmt::format("of the samples of a trial, {} had no gaze outside of blinks, and {} had "
                                   "none in blinks",
                                   lost, spread_text(results, TrialMeasureOf::in_blinks)));
}

void add_refreshes(std::string& text, const StudyResults& results) {
    const RefreshCounts counts = refresh_counts(results);
    if (counts.refreshes == 0)
        add_sentence(text, "how many refreshes of the display were missed is not on record");
    else if (!counts.missed)
        add_sentence(text, "how many refreshes of the display were missed is not proven");
    else
        add_sentence(text, fmt::format("{} of {} refreshes of the display {} missed",
                                       *counts.missed == 0 ? "none" : as_count(*counts.missed),
                                       as_count(counts.refreshes), *counts.missed > 1 ? "were" : "was"));
}

} // namespace

std::string gaze_quality_text(const StudyResults& results) {
    std::string text;
    if (std::ranges::all_of(results.sessions, [](const StudySession& session) {
            return session.setup.gaze.origin == GazeOrigin::none;
        })) {
        add_refreshes(text, results);
        return text;
    }
    add_calibrations(text, results);
    const std::string accuracy = spread_text(results, TrialMeasureOf::accuracy),
                      drift = spread_text(results, TrialMeasureOf::drift),
                      rms = spread_text(results, TrialMeasureOf::rms_s2s),
                      sd = spread_text(results, TrialMeasureOf::sd),
                      rate = spread_text(results, TrialMeasureOf::rate);
    if (accuracy.empty())
        add_sentence(text, "no trial follows a validation, so that the accuracy of gaze is not known");
    else
        add_sentence(text, fmt::format("the mean error of the validation before a trial was {}", accuracy));
    if (!drift.empty())
        add_sentence(text, fmt::format("the drift check before a trial found an error of {}", drift));
    if (rms.empty() && sd.empty())
        add_sentence(text, "the precision of gaze is not known");
    if (!rms.empty())
        add_sentence(text,
                     fmt::format("precision within fixations was {} from sample to sample (RMS-S2S)", rms));
    if (!sd.empty())
        add_sentence(text,
                     fmt::format("as standard deviation within fixations (SD), around the eye's own motion "
                                 "(a line through each fifth of a second), it was {}",
                                 sd));
    if (!rate.empty())
        add_sentence(text, fmt::format("the sampling rate by the time stamps was {}", rate));
    add_losses(text, results);
    add_refreshes(text, results);
    return text;
}

} // namespace overt
