#include "experiment/motion_phase.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace overt {

namespace {

/// A place of a wave that is as high as at h of n half periods, 0 <= h <= n / 2, or as low.
struct WavePlace {
    int h = 0;
    bool is_negative = false;
};

WavePlace folded(int h, int n) {
    h %= 2 * n;
    if (h < 0)
        h += 2 * n;
    const bool is_negative = h > n;
    if (is_negative)
        h -= n;
    return {std::min(h, n - h), is_negative};
}

int intervals_of(const Animation& motion) { return std::max(motion.frame_count - 1, 1); }

/// h and n of wave_of(h, n): with ping_pong -cos(pi k / n) = sin(pi (2k - n) / 2n).
struct HalfPeriods {
    int h, n;
};
HalfPeriods half_periods(const Animation& motion, AnimationFrameIndex frame) {
    const int intervals = intervals_of(motion);
    if (motion.playback == Playback::ping_pong)
        return {2 * frame.value - intervals, 2 * intervals};
    return {2 * frame.value, intervals};
}

/// sin(pi h / n).
double sine_of_half_turns(int h, int n) {
    const WavePlace place = folded(h, n);
    if (place.h == 0)
        return 0.0;
    const double sine = std::sin(std::numbers::pi * place.h / n);
    return place.is_negative ? -sine : sine;
}

} // namespace

double sine_of(const Animation& motion, AnimationFrameIndex frame) {
    const auto [h, n] = half_periods(motion, frame);
    return sine_of_half_turns(h, n);
}

double triangle_of(const Animation& motion, AnimationFrameIndex frame) {
    const auto [h, n] = half_periods(motion, frame);
    const WavePlace place = folded(h, n);
    if (place.h == 0)
        return 0.0;
    const double share = 2.0 * place.h / n;
    return place.is_negative ? -share : share;
}

double rise_of(const Animation& motion, AnimationFrameIndex frame) {
    const int halves = motion.playback == Playback::ping_pong ? 2 : 1;
    const double sine = sine_of_half_turns(frame.value, halves * intervals_of(motion));
    return sine * sine;
}

double full_turns_of(const Animation& motion, AnimationFrameIndex frame, int turns) {
    return within_half_turn(360.0 * turns * frame.value / intervals_of(motion));
}

double within_half_turn(double angle_deg) {
    const double within = std::remainder(angle_deg, 360.0); // exact
    return within <= -180.0 ? within + 360.0 : within + 0.0;
}

} // namespace overt
