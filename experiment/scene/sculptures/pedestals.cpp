#include "experiment/scene/sculptures/pedestals.h"

#include <cmath>

namespace overt {

namespace {

/// Upright disc with a rounded rim.
Shape disc(double z, double half_height, double radius, double rounding) {
    return {[=](const glm::dvec3& p) {
                const double across = std::hypot(p.x, p.y) - radius + rounding;
                const double up = std::abs(p.z - z) - half_height + rounding;
                return std::hypot(std::max(across, 0.0), std::max(up, 0.0)) +
                       std::min(0.0, std::max(across, up)) - rounding;
            },
            {{0, 0, z}, std::hypot(radius, half_height)}};
}

} // namespace

Clay round_plinth(double radius_mm) {
    Clay plinth;
    plinth.add(disc(9, 9, radius_mm, 8.8), 1.0);
    plinth.add(disc(30, 30, radius_mm - 10, 4.5), 12.0);
    plinth.add(disc(51, 9, radius_mm - 3, 8.8), 12.0);
    return plinth;
}

Clay square_plinth(const glm::dvec2& half_size_mm) {
    Clay plinth;
    plinth.add(block({0, 0, 9}, {half_size_mm, 9}, 8.8), 1.0);
    plinth.add(block({0, 0, 30}, {half_size_mm - 10.0, 30}, 4.5), 12.0);
    plinth.add(block({0, 0, 51}, {half_size_mm - 3.0, 9}, 8.8), 12.0);
    return plinth;
}

Clay rock(const glm::dvec3& base_centre, const glm::dvec3& half_size_mm) {
    const glm::dvec3 centre = base_centre + glm::dvec3(0, 0, half_size_mm.z - 4.0);
    Clay stone;
    stone.add(block(centre, half_size_mm, 12.0), 1.0);
    // Broken faces: planes that cut off the corners and edges, at even angles about the block.
    for (int i = 0; i < 17; ++i) {
        const double turn = 2.39996323 * i;
        const double rise = 0.75 * std::sin(1.9 * i + 0.4) + 0.1;
        const glm::dvec3 outwards = glm::normalize(glm::dvec3(std::cos(turn), std::sin(turn), rise));
        const double reach = glm::dot(glm::abs(outwards), half_size_mm);
        const glm::dvec3 point = centre + outwards * reach * (0.80 + 0.05 * std::sin(5.3 * i));
        stone.carve({[=](const glm::dvec3& p) { return glm::dot(point - p, outwards); },
                     {centre + outwards * (reach + 60.0), reach + 150.0}},
                    4.0);
    }
    // The top is dressed, for the foot.
    stone.add(block(base_centre + glm::dvec3(0, 0, 2.0 * half_size_mm.z - 12.0),
                    {0.86 * half_size_mm.x, 0.80 * half_size_mm.y, 8.0}, 5.0),
              6.0);
    return stone;
}

glm::dmat3 posture(double turn_deg, double bow_deg, double tilt_deg) {
    const double t = glm::radians(turn_deg);
    const double b = glm::radians(bow_deg);
    const double s = glm::radians(tilt_deg);
    const glm::dmat3 turn{{std::cos(t), std::sin(t), 0}, {-std::sin(t), std::cos(t), 0}, {0, 0, 1}};
    const glm::dmat3 bow{{1, 0, 0}, {0, std::cos(b), std::sin(b)}, {0, -std::sin(b), std::cos(b)}};
    const glm::dmat3 tilt{{std::cos(s), 0, -std::sin(s)}, {0, 1, 0}, {std::sin(s), 0, std::cos(s)}};
    return turn * bow * tilt;
}

} // namespace overt
