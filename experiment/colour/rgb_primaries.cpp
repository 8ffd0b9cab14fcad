#include "experiment/colour/rgb_primaries.h"

#include <cmath>

namespace overt {

namespace {

glm::dvec3 xyz_of_chromaticity(glm::dvec2 xy) { return {xy.x / xy.y, 1.0, (1.0 - xy.x - xy.y) / xy.y}; }

/// As they stand in x, y and 1 - x - y, so that a primary of no luminance (Z of XYZ) is none the less one.
glm::dmat3 directions_of(const RgbPrimaries& primaries) {
    const auto direction = [](glm::dvec2 xy) { return glm::dvec3(xy.x, xy.y, 1.0 - xy.x - xy.y); };
    return {direction(primaries.red), direction(primaries.green), direction(primaries.blue)};
}

} // namespace

bool are_primaries(const RgbPrimaries& primaries) {
    const double area = std::abs(glm::determinant(directions_of(primaries)));
    if (!(area > 1e-6) || !(primaries.white.y > 0.0))
        return false;
    const glm::dvec3 amounts = glm::inverse(directions_of(primaries)) * xyz_of_chromaticity(primaries.white);
    return amounts.x > 0.0 && amounts.y > 0.0 && amounts.z > 0.0;
}

glm::dmat3 xyz_from_rgb(const RgbPrimaries& primaries) {
    const glm::dmat3 directions = directions_of(primaries);
    const glm::dvec3 amounts = glm::inverse(directions) * xyz_of_chromaticity(primaries.white);
    return {directions[0] * amounts.x, directions[1] * amounts.y, directions[2] * amounts.z};
}

glm::dmat3 rec709_from(const RgbPrimaries& primaries) {
    // By columns.
    const glm::dmat3 bradford(0.8951, -0.7502, 0.0389, 0.2664, 1.7135, -0.0685, -0.1614, 0.0367, 1.0296);
    const glm::dvec3 own = bradford * xyz_of_chromaticity(primaries.white),
                     wanted = bradford * xyz_of_chromaticity(rec709_primaries.white);
    glm::dmat3 adapted(0.0);
    for (int cone = 0; cone < 3; ++cone)
        adapted[cone][cone] = wanted[cone] / own[cone];
    return glm::inverse(xyz_from_rgb(rec709_primaries)) * glm::inverse(bradford) * adapted * bradford *
           xyz_from_rgb(primaries);
}

} // namespace overt
