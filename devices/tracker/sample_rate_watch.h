/// How many samples really come in a second.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "experiment/gaze.h"
#include "experiment/ports/eye_tracker.h"

namespace overt {

/// Counts over all recordings of a tracker, by its own clock: samples of one time, as of both eyes, are one
/// measurement; what lies between recordings does not count. Allocates and throws nothing but in words.
class SampleRateWatch {
  public:
    /// A recording begins.
    void begin() noexcept { has_last_ = false; }

    void take(const GazeSample& sample) noexcept {
        if (has_last_ && sample.sampled_at > last_) {
            ++intervals_;
            span_ += sample.sampled_at - last_;
        }
        if (!has_last_ || sample.sampled_at > last_)
            last_ = sample.sampled_at;
        has_last_ = true;
    }

    /// Nothing before a second of recordings.
    std::optional<double> rate_hz() const noexcept;

    /// A sentence, if what came is not what was granted: more than 2 % apart, which is more than a rate that
    /// was measured over a second is off.
    std::optional<std::string> warning(const TrackerDescription& granted) const;

  private:
    std::int64_t intervals_ = 0;
    TrackerClock::duration span_{};
    TrackerTime last_{};
    bool has_last_ = false;
};

/// Whether two rates are one, as far as a second of samples tells.
bool is_same_rate(double one_hz, double other_hz) noexcept;

} // namespace overt
