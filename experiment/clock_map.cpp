#include "experiment/clock_map.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "experiment/base/error.h"
#include "experiment/box_time.h"

namespace overt {
namespace {

/// A reading of the other clock may be anywhere within its tick: both trackers and boxes count microseconds.
constexpr double tick_ns = 1000.0;

template <class Pair> SessionTime midpoint(const Pair& pair) {
    return pair.before + (pair.after - pair.before) / 2;
}

template <class Pair> double half_width_ns(const Pair& pair) {
    return 0.5 * std::abs(static_cast<double>((pair.after - pair.before).count())) + tick_ns;
}

double square(double value) { return value * value; }

} // namespace

template <class OtherClock>
ClockMapOf<OtherClock>::ClockMapOf(std::span<const ClockPairOf<OtherClock>> pairs) {
    OVERT_EXPECTS(!pairs.empty());
    reference_other_ = pairs.front().other;
    reference_session_ = midpoint(pairs.front());
    fit_line(pairs);
}

template <class OtherClock> double ClockMapOf<OtherClock>::nanoseconds_since_reference(OtherTime time) const {
    static_assert(std::is_same_v<typename OtherClock::period, std::micro>);
    return tick_ns * static_cast<double>((time - reference_other_).count());
}

template <class OtherClock>
void ClockMapOf<OtherClock>::fit_line(std::span<const ClockPairOf<OtherClock>> pairs) {
    struct Point {
        double x_ns, y_ns, half_width_ns, weight;
    };
    std::vector<Point> points;
    for (const ClockPairOf<OtherClock>& pair : pairs) {
        // The difference is taken in integers: both terms are large and it is small.
        const SessionDuration elapsed = pair.other - reference_other_;
        const SessionDuration correction = (midpoint(pair) - reference_session_) - elapsed;
        const double width = half_width_ns(pair);
        points.push_back({nanoseconds_since_reference(pair.other), static_cast<double>(correction.count()),
                          width, 1.0 / square(width)});
    }

    double weights = 0.0, sum_x = 0.0, sum_y = 0.0, sum_width = 0.0;
    for (const Point& point : points) {
        weights += point.weight;
        sum_x += point.weight * point.x_ns;
        sum_y += point.weight * point.y_ns;
        sum_width += point.weight * point.half_width_ns;
    }
    centre_ns_ = sum_x / weights;
    offset_ns_ = sum_y / weights;
    offset_uncertainty_ns_ = sum_width / weights;

    double spread = 0.0, covariance = 0.0, leverage = 0.0, distance = 0.0;
    for (const Point& point : points) {
        const double x = point.x_ns - centre_ns_;
        spread += point.weight * square(x);
        covariance += point.weight * x * (point.y_ns - offset_ns_);
        leverage += point.weight * std::abs(x) * point.half_width_ns;
        distance += point.weight * std::abs(x);
    }
    constexpr double largest_drift = largest_drift_ppm * 1e-6;
    const bool rate_is_known = spread > 0.0 && leverage / spread < largest_drift;
    if (rate_is_known) {
        slope_ = covariance / spread;
        slope_uncertainty_ = leverage / spread;
    } else {
        slope_uncertainty_ = largest_drift;
        offset_uncertainty_ns_ += largest_drift * distance / weights;
    }
    for (const Point& point : points) {
        const double x = point.x_ns - centre_ns_;
        const double explained = point.half_width_ns + (rate_is_known ? 0.0 : largest_drift * std::abs(x));
        const double residual = std::abs(point.y_ns - offset_ns_ - slope_ * x);
        worst_excess_ns_ = std::max(worst_excess_ns_, residual - explained);
    }
}

template <class OtherClock> MappedTime ClockMapOf<OtherClock>::to_session(OtherTime time) const {
    const SessionDuration elapsed = time - reference_other_;
    const double from_centre_ns = nanoseconds_since_reference(time) - centre_ns_;
    const double correction_ns = offset_ns_ + slope_ * from_centre_ns;
    const double uncertainty_ns =
        offset_uncertainty_ns_ + slope_uncertainty_ * std::abs(from_centre_ns) + worst_excess_ns_ + tick_ns;
    return {reference_session_ + elapsed + SessionDuration(std::llround(correction_ns)),
            SessionDuration(std::llround(std::ceil(uncertainty_ns)))};
}

template <class OtherClock>
typename ClockMapOf<OtherClock>::OtherTime ClockMapOf<OtherClock>::to_other(SessionTime time) const {
    using Microseconds = typename OtherClock::duration;
    // The clocks' rates differ by little, so each step leaves that little of the error before.
    OtherTime found = reference_other_ + std::chrono::floor<Microseconds>(time - reference_session_);
    for (int step = 0; step < 8; ++step) {
        const Microseconds error = std::chrono::floor<Microseconds>(time - to_session(found).time);
        if (error == Microseconds(0))
            break;
        found += error;
    }
    return found;
}

template class ClockMapOf<TrackerClock>;
template class ClockMapOf<BoxClock>;

} // namespace overt
