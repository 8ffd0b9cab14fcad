/// The kinds of rows of a running session: what goes through the ring to the writer's thread. A kind more is
/// a type in one of the two lists and an overload of RowWriter::write().
#pragma once

#include <cstdint>
#include <future>
#include <string>
#include <variant>
#include <vector>

#include "experiment/flip_report.h"
#include "experiment/ports/observer_field.h"
#include "experiment/ports/recorded_answer.h"
#include "experiment/ports/recorded_button.h"
#include "experiment/ports/recorded_calibration.h"
#include "experiment/ports/recorded_consent.h"
#include "experiment/ports/recorded_key_press.h"
#include "experiment/ports/recorded_marker.h"
#include "experiment/ports/tracker_items.h"
#include "experiment/ports/trial_outcome.h"
#include "experiment/record/recorded_box.h"
#include "experiment/record/session_header.h"

namespace overt {

struct SampleRow {
    int trial = -1;
    GazeSample sample;
};

/// What the tracker says besides samples.
struct TrackerItemRow {
    int trial = -1;
    TrackerItem item;
};

/// A SessionEvent that owns its words.
struct EventRow {
    SessionTime at;
    int trial;
    std::string kind, detail;
};

struct TrialStart {
    Trial trial;
    SessionTime at;
};

struct TrialFinish {
    Trial trial;
    TrialOutcome outcome;
    std::int64_t lost_flips = 0, lost_samples = 0; ///< since it began
};

/// What is too large or too rare for the ring itself, which carries a pointer to it, so that the order holds.
struct RowMessage {
    std::variant<EventRow, TrialStart, TrialFinish, RecordedMap, RecordedBox, std::vector<BoxClockPair>,
                 std::vector<RecordedObserverField>, RecordedConsent, RecordedAnswer, RecordedCalibration,
                 std::vector<RecordedButton>, std::vector<RecordedMarker>, std::vector<RecordedKeyPress>,
                 GazeYield>
        content;
    std::promise<void> written;
};

/// What the ring carries.
using Row = std::variant<FlipRecord, SlotFlip, SteeredFlip, MissedRefresh, SampleRow, TrackerItemRow,
                         ClockPair, RowMessage*>;

} // namespace overt
