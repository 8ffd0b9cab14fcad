#include "app/tracker/stream_figures.h"

#include <algorithm>

namespace overt {

void StreamFigures::take(const TrackerItem& item) {
    if (const auto* pair = std::get_if<ClockPair>(&item))
        return take(*pair);
    if (std::holds_alternative<TrackerGap>(item))
        ++gaps_;
    if (std::holds_alternative<TrackerEvent>(item))
        ++events_;
    const auto* sample = std::get_if<GazeSample>(&item);
    if (!sample)
        return;
    ++samples_;
    without_gaze_ += sample->gaze ? 0 : 1;
    OfEye& eye = eyes_[static_cast<std::size_t>(sample->eye)];
    if (eye.count == 0) {
        eye.first = sample->sampled_at;
    } else {
        const std::int64_t interval_us = (sample->sampled_at - eye.last).count();
        repeated_ += interval_us == 0 ? 1 : 0;
        out_of_order_ += interval_us < 0 ? 1 : 0;
        eye.intervals_us.push_back(interval_us);
    }
    eye.last = sample->sampled_at;
    ++eye.count;
}

std::optional<double> StreamFigures::rate_hz(Eye eye) const {
    const OfEye& one = of(eye);
    if (one.count < 2 || one.last <= one.first)
        return std::nullopt;
    return 1e6 * static_cast<double>(one.count - 1) / static_cast<double>((one.last - one.first).count());
}

std::int64_t StreamFigures::usual_us(Eye eye) const {
    std::vector<std::int64_t> sorted = of(eye).intervals_us;
    if (sorted.empty())
        return 0;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    return *middle;
}

std::int64_t StreamFigures::holes(Eye eye) const {
    const std::int64_t usual = usual_us(eye);
    return std::ranges::count_if(of(eye).intervals_us,
                                 [&](std::int64_t interval) { return 2 * interval > 3 * usual; });
}

std::int64_t StreamFigures::missing(Eye eye) const {
    const std::int64_t usual = usual_us(eye);
    std::int64_t missing = 0;
    for (const std::int64_t interval : of(eye).intervals_us)
        if (2 * interval > 3 * usual && usual > 0)
            missing += (interval + usual / 2) / usual - 1;
    return missing;
}

double StreamFigures::clock_span_s() const {
    return pairs_.empty() ? 0.0 : to_seconds(pairs_.back().after - pairs_.front().before);
}

std::optional<double> StreamFigures::worst_off_line_us() const {
    const std::optional<ClockMap> line = clock();
    if (!line)
        return std::nullopt;
    double worst = 0.0;
    for (const ClockPair& pair : pairs_) {
        const SessionTime told = line->to_session(pair.other).time;
        const double outside_s = std::max(to_seconds(pair.before - told), to_seconds(told - pair.after));
        worst = std::max(worst, 1e6 * outside_s);
    }
    return worst;
}

double StreamFigures::longest_interval_ms(Eye eye) const {
    const std::vector<std::int64_t>& intervals = of(eye).intervals_us;
    return intervals.empty() ? 0.0 : 1e-3 * static_cast<double>(*std::ranges::max_element(intervals));
}

std::optional<ClockMap> StreamFigures::clock() const {
    return pairs_.empty() ? std::nullopt : std::optional<ClockMap>(ClockMap(pairs_));
}

std::optional<double> StreamFigures::best_half_trip_us() const {
    if (pairs_.empty())
        return std::nullopt;
    SessionDuration shortest = SessionDuration::max();
    for (const ClockPair& pair : pairs_)
        shortest = std::min(shortest, pair.after - pair.before);
    return 0.5e6 * to_seconds(shortest);
}

} // namespace overt
