/// A motion for tests that only ask how many frames there are, and how fast they go by.
#pragma once

#include "experiment/animation.h"

namespace overt {

inline Animation motion_of(int frame_count, double frame_rate_hz, double duration_s) {
    Animation motion;
    motion.frame_count = frame_count;
    motion.frame_rate_hz = frame_rate_hz;
    motion.duration_s = duration_s;
    return motion;
}

} // namespace overt
