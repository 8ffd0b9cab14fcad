#include "experiment/maps/coordinate_codec.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "experiment/base/error.h"

namespace overt {

CoordinateCodec::CoordinateCodec(const Bounds& bounds, int scale) : bounds_(bounds), scale_(scale) {
    if (scale != usual_scale && scale != paper_scale) {
        throw InputError(fmt::format("coordinates are coded with a scale of 65535 or 65536, not {}", scale));
    }
    for (int axis = 0; axis < 3; ++axis) {
        const double low = bounds.min[axis], high = bounds.max[axis];
        if (!std::isfinite(low) || !std::isfinite(high) || low > high) {
            throw InputError(
                fmt::format("coordinates from {} to {} make no box to code them by: on each axis "
                            "two finite numbers are needed, the smaller one first",
                            low, high));
        }
    }
}

CoordinateCode CoordinateCodec::encode(glm::dvec3 position) const {
    CoordinateCode code(0);
    for (int axis = 0; axis < 3; ++axis) {
        const double low = bounds_.min[axis], extent = bounds_.max[axis] - low;
        if (!(extent > 0.0))
            continue;
        const double exact = scale_ * ((position[axis] - low) / extent);
        code[axis] = static_cast<std::uint16_t>(std::clamp(std::floor(exact + 0.5), 0.0, 65535.0));
    }
    return code;
}

glm::dvec3 CoordinateCodec::decode(CoordinateCode code) const {
    glm::dvec3 position;
    for (int axis = 0; axis < 3; ++axis) {
        const double share = code[axis] / static_cast<double>(scale_);
        // From the nearer end, so that both ends are exact.
        position[axis] = share < 0.5
                             ? bounds_.min[axis] + share * (bounds_.max[axis] - bounds_.min[axis])
                             : bounds_.max[axis] - (1.0 - share) * (bounds_.max[axis] - bounds_.min[axis]);
    }
    return position;
}

} // namespace overt
