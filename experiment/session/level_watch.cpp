#include "experiment/session/level_watch.h"

#include <algorithm>
#include <cmath>

namespace overt {

namespace {

constexpr double bar_interval_s = 0.1, warns_of_clipping_s = 2.0, warns_of_silence_after_s = 5.0;
constexpr double quietest_db = -60.0;
constexpr float voice_share = 0.01f; // -40 dB: a quiet voice at an arm's length, well above a room's noise

double place_of(float share) {
    const double db = share > 0.0f ? 20.0 * std::log10(static_cast<double>(share)) : quietest_db;
    return std::clamp((db - quietest_db) / -quietest_db, 0.0, 1.0);
}

} // namespace

std::optional<LevelBar> LevelWatch::take(const AudioLevel& level, SessionTime now) {
    loudest_.peak = std::max(loudest_.peak, level.peak);
    loudest_.rms = std::max(loudest_.rms, level.rms);
    was_heard_ = was_heard_ || level.peak >= voice_share;
    if (level.is_clipping)
        clipped_ = now;
    if (now - drawn_ < from_seconds(bar_interval_s))
        return std::nullopt;
    drawn_ = now;
    LevelBar bar{place_of(loudest_.rms), place_of(loudest_.peak), {}};
    if (clipped_ && now - *clipped_ < from_seconds(warns_of_clipping_s))
        bar.warning = words_.too_loud;
    else if (!was_heard_ && now - since_ > from_seconds(warns_of_silence_after_s))
        bar.warning = words_.no_voice;
    loudest_ = {};
    return bar;
}

} // namespace overt
