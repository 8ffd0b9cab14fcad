#include "devices/tracker/sample_rate_watch.h"

#include <chrono>
#include <cmath>

#include <fmt/format.h>

namespace overt {
namespace {

constexpr double tolerable_share = 0.02;

} // namespace

bool is_same_rate(double one_hz, double other_hz) noexcept {
    return std::abs(one_hz - other_hz) <= tolerable_share * other_hz;
}

std::optional<double> SampleRateWatch::rate_hz() const noexcept {
    const double span_s = std::chrono::duration<double>(span_).count();
    return span_s >= 1.0 ? std::optional(static_cast<double>(intervals_) / span_s) : std::nullopt;
}

std::optional<std::string> SampleRateWatch::warning(const TrackerDescription& granted) const {
    const std::optional<double> came_hz = rate_hz();
    if (!came_hz || granted.sample_rate_hz <= 0.0 || is_same_rate(*came_hz, granted.sample_rate_hz))
        return std::nullopt;
    return fmt::format("{:.5g} samples came in a second of the recordings, and not {:.5g} as when it was "
                       "connected: what is missing counts as lost gaze",
                       *came_hz, granted.sample_rate_hz);
}

} // namespace overt
