#include "experiment/audio/sample_clock.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "experiment/base/error.h"

namespace overt {

namespace {

/// Over less, stamps that scatter by a millisecond say nothing of the rate.
constexpr double shortest_span_s = 0.5;

/// No crystal is further off its nominal rate: such a line was bent by stamps of a device that had just
/// begun.
constexpr double largest_drift = 1e-3;

/// Stamps further off the line than this many standard deviations, by the median, were taken late.
constexpr double outlier_sd = 3.0, least_outlier_s = 2e-4;
constexpr int most_rounds = 8;

} // namespace

void SampleClock::add(std::int64_t sample, SessionTime at) {
    if (stamps_.empty())
        origin_ = at;
    stamps_.push_back({static_cast<double>(sample), to_seconds(at - origin_)});
}

SampleClock::Line SampleClock::line_through(const std::vector<Stamp>& stamps) const {
    Line line;
    line.count = static_cast<double>(stamps.size());
    for (const Stamp& stamp : stamps) {
        line.mean_sample += stamp.sample / line.count;
        line.mean_s += stamp.at_s / line.count;
    }
    double mixed = 0.0;
    for (const Stamp& stamp : stamps) {
        line.spread_s2 += (stamp.at_s - line.mean_s) * (stamp.at_s - line.mean_s);
        mixed += (stamp.at_s - line.mean_s) * (stamp.sample - line.mean_sample);
    }
    line.rate_hz = nominal_rate_hz_;
    if (stamps.size() > 2 && stamps.back().at_s - stamps.front().at_s >= shortest_span_s) {
        const double rate_hz = mixed / line.spread_s2;
        line.has_slope = std::abs(rate_hz / nominal_rate_hz_ - 1.0) < largest_drift;
        if (line.has_slope)
            line.rate_hz = rate_hz;
    }
    double squares = 0.0;
    for (const Stamp& stamp : stamps)
        squares += line.off_s(stamp) * line.off_s(stamp);
    line.residual_s = stamps.size() > 2 ? std::sqrt(squares / (line.count - 2.0)) : 1e-3;
    return line;
}

SampleClock::Line SampleClock::line() const {
    OVERT_EXPECTS(!stamps_.empty());
    Line line = line_through(stamps_);
    // Each time the line lies closer to the stamps that were taken in time, and tells the others better.
    for (int round = 0; round < most_rounds; ++round) {
        std::vector<double> off_s;
        for (const Stamp& stamp : stamps_)
            off_s.push_back(std::abs(line.off_s(stamp)));
        const auto middle = off_s.begin() + std::ssize(off_s) / 2;
        std::nth_element(off_s.begin(), middle, off_s.end());
        const double limit_s = std::max(least_outlier_s, outlier_sd * 1.4826 * *middle);
        std::vector<Stamp> kept;
        for (const Stamp& stamp : stamps_)
            if (std::abs(line.off_s(stamp)) <= limit_s)
                kept.push_back(stamp);
        const Line closer = kept.size() > stamps_.size() / 2 ? line_through(kept) : line;
        const bool is_settled = closer.count == line.count;
        line = closer;
        if (is_settled)
            break;
    }
    return line;
}

SampleClock::Place SampleClock::sample_at(SessionTime time) const {
    const Line fit = line();
    const double since_mean_s = to_seconds(time - origin_) - fit.mean_s;
    const double lever = fit.has_slope ? since_mean_s * since_mean_s / fit.spread_s2 : 0.0;
    const double two_errors_s = 2.0 * fit.residual_s * std::sqrt(1.0 / fit.count + lever);
    return {fit.mean_sample + since_mean_s * fit.rate_hz,
            from_seconds(two_errors_s + 0.5 / nominal_rate_hz_)};
}

double SampleClock::rate_hz() const { return line().rate_hz; }

} // namespace overt
