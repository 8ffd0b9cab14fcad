#include "experiment/events/main_sequence.h"

#include <algorithm>

namespace overt {

SessionDuration saccade_duration(Degrees amplitude) { return from_seconds(0.021 + 0.0022 * amplitude.value); }

double saccade_progress(double share) {
    const double s = std::clamp(share, 0.0, 1.0);
    return s * s * s * (10.0 + s * (-15.0 + 6.0 * s));
}

} // namespace overt
