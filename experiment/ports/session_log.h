/// The port through which a session is recorded.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "experiment/clock_pair.h"
#include "experiment/flip_report.h"
#include "experiment/gaze.h"
#include "experiment/ports/observer_field.h"
#include "experiment/ports/recorded_answer.h"
#include "experiment/ports/recorded_button.h"
#include "experiment/ports/recorded_calibration.h"
#include "experiment/ports/recorded_consent.h"
#include "experiment/ports/recorded_key_press.h"
#include "experiment/ports/recorded_marker.h"
#include "experiment/ports/tracker_items.h"
#include "experiment/ports/trial_outcome.h"
#include "experiment/trial.h"

namespace overt {

/// What happened, besides flips and samples.
struct SessionEvent {
    SessionTime at;
    int trial = -1; ///< -1: outside of trials
    std::string_view kind;
    std::string detail;
};

/// Records a session. flip(), slot_flip(), missed() and sample() allocate, open and throw nothing and may
/// wait for the disk only where time is virtual; the others may throw RecordError.
class SessionLog {
  public:
    virtual ~SessionLog() = default;
    virtual void flip(const FlipRecord& flip) noexcept = 0;
    /// Comes after the flip that it belongs to.
    virtual void slot_flip(const SlotFlip& /*flip*/) noexcept {}
    /// Comes after the flip that it belongs to. Allocates, opens and throws nothing, as flip().
    virtual void steered_flip(const SteeredFlip& /*flip*/) noexcept {}
    /// Comes before the flip that ended it.
    virtual void missed(const MissedRefresh& refresh) noexcept = 0;
    virtual void sample(int trial, const GazeSample& sample) noexcept = 0;
    /// Of the tracker, other than samples and clock readings. As sample(): allocates, opens and throws
    /// nothing.
    virtual void tracker_item(int /*trial*/, const TrackerItem& /*item*/) noexcept {}
    virtual void clock_pair(const ClockPair& pair) noexcept = 0;
    virtual void event(const SessionEvent& event) = 0;
    virtual void calibration(const RecordedCalibration& /*calibration*/) {}
    /// What the observer filled in; replaces what was noted before.
    virtual void observer_fields(const std::vector<RecordedObserverField>& /*fields*/) {}
    virtual void consent(const RecordedConsent& /*consent*/) {}
    /// Of response boxes. Those of a trial come before its trial_finished().
    virtual void buttons(const std::vector<RecordedButton>& /*buttons*/) {}
    /// Keys and buttons that were pressed in trials. The same.
    virtual void key_presses(const std::vector<RecordedKeyPress>& /*presses*/) {}
    /// Of the attempt that was started last, by this record's tracker; before its trial_finished().
    virtual void gaze_came(const GazeYield& /*gaze*/) {}
    /// What became of markers at their outputs. The same.
    virtual void markers(const std::vector<RecordedMarker>& /*markers*/) {}
    /// Of the attempt that was started last.
    virtual void answer_recorded(const RecordedAnswer& /*answer*/) {}
    virtual void trial_started(const Trial& trial, SessionTime at) = 0;
    /// All of the trial's rows are on disk when this returns.
    virtual void trial_finished(const Trial& trial, const TrialOutcome& outcome) = 0;
};

} // namespace overt
