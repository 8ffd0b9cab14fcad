/// What a tracker's stream is like: how fast it samples, what it loses, how it keeps time.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "experiment/clock_map.h"
#include "experiment/ports/tracker_items.h"

namespace overt {

/// Takes the items of one recording, in order.
class StreamFigures {
  public:
    void take(const TrackerItem& item);
    void take(const ClockPair& pair) { pairs_.push_back(pair); }

    std::int64_t samples() const { return samples_; } ///< of both eyes, if both are measured
    std::int64_t without_gaze() const { return without_gaze_; }
    std::int64_t repeated() const { return repeated_; } ///< same eye and time as the one before
    std::int64_t out_of_order() const { return out_of_order_; }
    std::int64_t gaps() const { return gaps_; } ///< that the tracker or its driver told
    std::int64_t events() const { return events_; }
    bool has(Eye eye) const { return of(eye).count > 0; }

    /// Samples of one eye to a second of the tracker's clock, from first to last; nothing of fewer than two.
    std::optional<double> rate_hz(Eye eye) const;
    /// Times between successive samples of one eye that exceed one and a half of the usual (median) time.
    std::int64_t holes(Eye eye) const;
    /// Samples that would fill these times, at the usual one.
    std::int64_t missing(Eye eye) const;
    /// The longest of these times, ms.
    double longest_interval_ms(Eye eye) const;

    /// Nothing without clock readings.
    std::optional<ClockMap> clock() const;
    std::size_t clock_readings() const { return pairs_.size(); }
    /// From the first reading of the clock to the last, by this computer's.
    double clock_span_s() const;
    /// How far a reading lies off the line through all of them at most, beyond half of its own round trip,
    /// µs: 0 for clocks that run steadily. Nothing without readings.
    std::optional<double> worst_off_line_us() const;
    /// Half of the shortest round trip, µs.
    std::optional<double> best_half_trip_us() const;

  private:
    struct OfEye {
        std::int64_t count = 0;
        TrackerTime first, last;
        std::vector<std::int64_t> intervals_us;
    };
    const OfEye& of(Eye eye) const { return eyes_[static_cast<std::size_t>(eye)]; }
    std::int64_t usual_us(Eye eye) const;

    std::array<OfEye, 2> eyes_;
    std::int64_t samples_ = 0, without_gaze_ = 0, repeated_ = 0, out_of_order_ = 0, gaps_ = 0, events_ = 0;
    std::vector<ClockPair> pairs_;
};

} // namespace overt
