/// Which sample was taken when: a line through the time stamps of a recording's blocks.
#pragma once

#include <cstdint>
#include <vector>

#include "experiment/session_time.h"

namespace overt {

/// A sound card counts samples exactly, but says only roughly when a block was taken, and its crystal differs
/// from the session clock's. The line is fitted by least squares, sample over session time, a second time
/// without the stamps that lie far off (their block was handed over late). Where the blocks span less than
/// half a second, or say a rate that no crystal has, the nominal rate is taken.
class SampleClock {
  public:
    explicit SampleClock(double nominal_rate_hz) : nominal_rate_hz_(nominal_rate_hz) {}

    /// The sample with this index was taken at this time, as far as the sound system knows.
    void add(std::int64_t sample, SessionTime at);

    bool is_empty() const { return stamps_.empty(); }

    struct Place {
        double sample = 0.0;           ///< not whole
        SessionDuration uncertainty{}; ///< two standard errors of the line there, and half a sample
    };
    /// Not for an empty clock.
    Place sample_at(SessionTime time) const;

    /// Samples to a second of the session clock.
    double rate_hz() const;

  private:
    struct Stamp {
        double sample, at_s;
    };
    struct Line {
        double count = 0.0, mean_sample = 0.0, mean_s = 0.0, rate_hz = 0.0;
        double residual_s = 0.0; ///< standard deviation of the stamps about the line
        double spread_s2 = 0.0;  ///< sum of squared distances of the times from their mean
        bool has_slope = false;
        double off_s(const Stamp& stamp) const {
            return stamp.at_s - mean_s - (stamp.sample - mean_sample) / rate_hz;
        }
    };
    Line line_through(const std::vector<Stamp>& stamps) const;
    Line line() const;

    double nominal_rate_hz_;
    SessionTime origin_;
    std::vector<Stamp> stamps_;
};

} // namespace overt
