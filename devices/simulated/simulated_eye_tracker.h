/// An eye tracker that measures a simulated observer: with noise, with an error of calibration, on a clock of
/// its own.
#pragma once

#include <cstddef>
#include <cstdint>

#include <glm/glm.hpp>

#include "devices/simulated/simulated_observer.h"
#include "experiment/base/random.h"
#include "experiment/gaze.h"
#include "experiment/ports/clock.h"
#include "experiment/ports/eye_tracker.h"
#include "experiment/protocol/protocol.h"

namespace overt {

struct SimulatedTrackerSettings {
    double rate_hz = 2000.0; ///< of its own clock
    Eye eye = Eye::right;    ///< of one eye; of both, the one that is analysed
    bool both_eyes =
        false; ///< the left eye points 0.2 degrees beside the right one, and has noise of its own
    /// What it measures is not gaze on the screen yet: turned, scaled, shifted and bent, as a camera beside
    /// the screen sees a pupil.
    bool uncalibrated = false;
    double noise_deg = 0.05;       ///< standard deviation of each sample along each axis
    double accuracy_deg = 0.3;     ///< standard deviation, along each axis, of a recording's constant offset
    double clock_drift_ppm = 40.0; ///< its clock runs faster than the session's by this
    double steps_per_px = 10.0;    ///< gaze is rounded to 0.1 px, as an EyeLink's; 0: not rounded
    SessionDuration delivery_latency = std::chrono::milliseconds(2); ///< from sampling to poll()
    std::size_t queue_capacity = 1u << 16; ///< samples that wait for poll() before the oldest are lost
};

/// As a protocol's [tracker] has them.
SimulatedTrackerSettings simulated_tracker_settings(const TrackerSettings& settings);

/// Samples on the ticks of its own clock: each sample is a function of the seed, its tick and what the
/// observer did, whenever it is polled. Time passes by `clock` alone, so it works alike in steady and in
/// virtual time. Used on the session's thread.
class SimulatedEyeTracker final : public EyeTracker {
  public:
    /// `clock` and `observer` must outlive this. Throws InputError if the rate is not 1 … 10000 Hz.
    SimulatedEyeTracker(Clock& clock, const SimulatedObserver& observer, std::uint64_t seed,
                        const SimulatedTrackerSettings& settings = {});

    TrackerDescription description() const override;
    bool calibrates_itself() const noexcept override { return !settings_.uncalibrated; }

    /// Nine targets, each missed by a draw from the same distribution as the recordings' offsets. Takes no
    /// time.
    SetupOutcome set_up(SetupScreen& setup_screen) override;

    /// Averages the gaze of 100 ms, with the offset of the recording to come; waits up to 2 s for an open
    /// eye.
    DriftOutcome drift_check(ScreenPoint target) override;

    /// Waits as long as a request over the network takes: 0.1 ms and an exponential excess of 0.1 ms on
    /// average, the tracker's answer anywhere in between.
    std::optional<ClockPair> read_clocks() noexcept override;

    void start_recording() override;

    /// Samples up to this moment can be polled at once; the next recording gets a new offset.
    void stop_recording() override;

    std::size_t poll(std::span<TrackerItem> into) noexcept override;

    /// The truth about its clock: its time at an instant, rounded down to the microsecond.
    TrackerTime tracker_time_at(SessionTime time) const noexcept;
    /// The instant at which its clock shows a time.
    SessionTime session_time_at(TrackerTime time) const noexcept;
    /// The truth about the constant offset of the recording under way or, between two, of the one to come; x
    /// to the right, y down.
    glm::dvec2 offset_deg() const noexcept { return offset_deg_; }
    /// Samples lost because they were not polled in time.
    std::int64_t overflowed() const noexcept { return overflowed_; }

  private:
    std::int64_t tracker_ns_at(SessionTime time) const noexcept;
    SessionTime session_time_of_ns(std::int64_t tracker_ns) const noexcept;
    std::int64_t ns_of_tick(std::int64_t tick) const noexcept;
    std::int64_t first_tick_from(SessionTime time) const noexcept;
    GazeSample sample_at(std::int64_t tick, glm::dvec2 offset_deg, Eye eye) const noexcept;
    ScreenPoint as_measured(ScreenPoint place) const noexcept;
    float pupil_area_at(SessionTime time, double noise) const noexcept;
    void draw_offset();

    Clock* clock_;
    const SimulatedObserver* observer_;
    std::uint64_t seed_;
    SimulatedTrackerSettings settings_;
    glm::dvec2 px_per_deg_;
    std::int64_t clock_origin_ns_ = 0; ///< its time at the session's start
    RandomStream link_random_;
    std::uint64_t offsets_drawn_ = 0, calibrations_ = 0;
    glm::dvec2 offset_deg_{0.0};          ///< of the recording under way or to come
    glm::dvec2 recorded_offset_deg_{0.0}; ///< of the samples that can be polled
    bool recording_ = false;
    std::int64_t next_tick_ = 0; ///< to be polled next
    bool left_is_taken_ = false; ///< of that tick, where both eyes are measured
    std::int64_t end_tick_ = 0;  ///< after the last of a recording that was stopped
    std::int64_t overflowed_ = 0;
};

} // namespace overt
