/// How many gaze samples there were, and of what kind.
#pragma once

#include <cstdint>

namespace overt {

/// Of one trial.
struct SampleCounts {
    std::int64_t samples = 0, without_gaze = 0, on_object = 0, off_plan = 0;
    SampleCounts& operator+=(const SampleCounts& more) {
        samples += more.samples;
        without_gaze += more.without_gaze;
        on_object += more.on_object;
        off_plan += more.off_plan;
        return *this;
    }
};

} // namespace overt
