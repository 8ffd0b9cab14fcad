/// From the records of an Open Gaze server to samples.
#pragma once

#include <cstdint>
#include <optional>

#include "devices/opengaze/opengaze_clock.h"
#include "devices/tracker/tracker_driver.h"
#include "experiment/protocol/protocol.h"

namespace overt {

/// Of one recording, in the order of the records. Nothing allocates or throws.
class OpenGazeSamples {
  public:
    /// `longest_delay`: a record is here at most so long after its time was taken.
    OpenGazeSamples(const TrackerWish& wish, TrackedPoint point, SessionDuration longest_delay) noexcept;

    /// A recording begins: what comes is not joined to what came before.
    void begin() noexcept;

    /// Puts the samples of a record that was here at `arrived`, with a gap before them where records are
    /// missing, and about once a second a reading of both clocks: that of the record since the last which
    /// came soonest.
    void take(const OpenGazeRecord& record, SessionTime arrived, OpenGazeClock& clock,
              TrackerItemSink& sink) noexcept;

    /// A line came that could not be read.
    void take_noise(TrackerItemSink& sink) noexcept;

    /// When the last record was here, or the recording began to wait for one.
    std::optional<SessionTime> last_arrival() const noexcept { return last_arrival_; }
    /// Of the last record; the clock's zero if there was none.
    TrackerTime last_time() const noexcept { return last_time_; }

  private:
    void put_eye(Eye eye, const OpenGazeEye& measured, TrackerItemSink& sink) const noexcept;
    void read_clocks(SessionTime arrived, TrackerItemSink& sink) noexcept;

    glm::dvec2 screen_px_;
    Eye eye_;
    bool both_eyes_;
    TrackedPoint point_;
    SessionDuration longest_delay_;
    std::optional<std::int64_t> counter_;
    std::optional<SessionTime> last_arrival_;
    TrackerTime last_time_{};
    bool was_noise_ = false; ///< since the last record
    std::optional<SessionTime> clocks_since_;
    ClockPair soonest_{};
};

} // namespace overt
