/// What an eye tracker delivers while it records, in the order in which it says it: one stream, whatever the
/// tracker. All items are plain values: they go through rings and never allocate.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <variant>

#include <glm/vec3.hpp>

#include "experiment/clock_pair.h"
#include "experiment/gaze.h"
#include "experiment/gaze_event.h"

namespace overt {

/// What some trackers know of a sample besides gaze and pupil. Follows the sample that it belongs to.
struct SampleDetail {
    TrackerTime sampled_at;
    Eye eye = Eye::right;
    std::optional<float> confidence; ///< 0 … 1, as the tracker estimates it
    /// Where the eye is, in mm and in the tracker's own coordinates.
    std::optional<glm::vec3> eye_mm;
};

/// A fixation, saccade or blink that the tracker found itself; see GazeEvent for the meaning of its parts.
struct TrackerEvent {
    GazeEvent::Kind kind = GazeEvent::Kind::fixation;
    Eye eye = Eye::right;
    TrackerTime start, end;
    TrackerClock::duration duration{};
    std::optional<ScreenPoint> place, arrival;
    std::optional<float> pupil, amplitude_deg, peak_velocity_deg_s;
};

/// The tracker's input port changed.
struct TrackerInput {
    TrackerTime at;
    std::uint32_t value = 0;
};

/// A button of the tracker's own box.
struct TrackerButton {
    TrackerTime at;
    int number = 0;
    bool is_down = false;
};

/// Data are missing between two samples, through the link or the tracker and not through the eye.
struct TrackerGap {
    enum class Reason : std::uint8_t { overflow, connection, unreadable };
    Reason reason = Reason::overflow;
    TrackerTime after;             ///< time of the last item before it; the clock's zero if there was none
    std::int64_t lost_samples = 0; ///< 0: not known
};
std::string_view name_of(TrackerGap::Reason reason) noexcept;

/// A ClockPair is a reading of both clocks that was taken while it records.
using TrackerItem =
    std::variant<GazeSample, SampleDetail, TrackerEvent, TrackerInput, TrackerButton, TrackerGap, ClockPair>;

/// Moves all its times by so much, and gives when it was known: the end of an event, the item before a gap.
TrackerTime put_forward(TrackerItem& item, TrackerClock::duration by) noexcept;

/// An item other than a sample or a sample's detail as it stands among the record's gaze events: inputs and
/// buttons with their values in words, gaps as notes. Nothing for samples, details and clock readings.
/// Allocates.
std::optional<GazeEvent> gaze_event_of(const TrackerItem& item);

/// What gaze_event_of() was made from; nothing for messages and for notes of other things.
std::optional<TrackerItem> tracker_item_of(const GazeEvent& event);

} // namespace overt
