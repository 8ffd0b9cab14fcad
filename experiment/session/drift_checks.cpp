#include "experiment/session/drift_checks.h"

#include <utility>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/ports/event_kinds.h"

namespace overt {

void DriftChecks::check(TrialOutcome& outcome) {
    state_.enter(SessionPhase::drift_check, state_.trial());
    has_begun_ = false;
    const TrackerSettings& settings = state_.protocol.tracker;
    if (const int trial = state_.trial(); checked_trial_ != trial) {
        checked_trial_ = trial;
        failed_checks_ = 0;
    }
    while (const std::optional<std::string> failure = failed_check(outcome)) {
        ++failed_checks_;
        state_.note_of(state_.own_tracker(), drift_check_failed_event, *failure);
        const bool may_check_again = failed_checks_ < settings.drift_checks;
        if (settings.on_drift == DriftPolicy::reject)
            control_.reject_trial("the drift check failed");
        if (settings.on_drift == DriftPolicy::recalibrate && may_check_again) {
            control_.calibrate(state_.own_tracker());
            control_.repeat_trial();
            return;
        }
        if (settings.on_drift != DriftPolicy::retry || !may_check_again)
            break;
    }
    checked_trial_.reset();
}

/// Shows the target and measures. Why the check failed; nothing if it did not, or was not made.
std::optional<std::string> DriftChecks::failed_check(TrialOutcome& outcome) {
    const Screen target{.kind = Screen::Kind::target, .text = ""};
    const SessionTime onset = state_.show(target);
    if (!std::exchange(has_begun_, true))
        began_ = onset;
    const OperatorControl::How how =
        control_
            .wait({.screen = target,
                   .onset = onset,
                   .max_s = state_.protocol.screens.drift_target_s,
                   .await = [](SessionTime) {}, // no answer is expected of the observer
                   .takes_keys = false,
                   .starts_over = true})
            .how;
    if (how != OperatorControl::How::timed_out || !state_.ports.tracker.measures_gaze())
        return {};
    DriftOutcome drift;
    try {
        drift = state_.ports.tracker.drift_check(screen_centre_);
    } catch (const DeviceError& error) {
        control_.regain_tracker(error.what());
        control_.repeat_for_lost_tracker();
        return {};
    }
    if (drift.kind == DriftOutcome::Kind::set_up_wanted) {
        // Asked for at the tracker's host: the trial begins anew once it is done.
        state_.note_of(state_.own_tracker(), drift_check_failed_event, "the tracker asked to be set up");
        control_.calibrate(state_.own_tracker());
        control_.repeat_trial();
        return {};
    }
    outcome.drift = drift.kind == DriftOutcome::Kind::measured ? std::optional(drift.error) : std::nullopt;
    if (!outcome.drift)
        return "no eye was found";
    const double limit_deg = state_.protocol.tracker.drift_limit_deg;
    if (outcome.drift->value > limit_deg)
        return fmt::format("{:.3f} deg is more than the limit of {} deg", outcome.drift->value, limit_deg);
    return {};
}

} // namespace overt
