#include "experiment/scene/sculptures/pedestals.h"

#include <cmath>

namespace overt {

namespace {

/// Profile of both plinths: how far the outline lies inside the foot's outline at a height, mm.
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
    plinth.add(disc(9, 9, radius_mm, 2.5), 1.0);
    plinth.add(disc(30, 30, radius_mm - 9, 2.5), 6.0);
    plinth.add(disc(51, 9, radius_mm - 3, 3.5), 6.0);
    return plinth;
}

Clay square_plinth(const glm::dvec2& half_size_mm) {
    Clay plinth;
    plinth.add(block({0, 0, 9}, {half_size_mm, 9}, 2.5), 1.0);
    plinth.add(block({0, 0, 30}, {half_size_mm - 9.0, 30}, 2.5), 6.0);
    plinth.add(block({0, 0, 51}, {half_size_mm - 3.0, 9}, 3.5), 6.0);
    return plinth;
}

Clay rock(const glm::dvec3& base_centre, const glm::dvec3& half_size_mm) {
    Clay stone;
    const glm::dvec3 centre = base_centre + glm::dvec3(0, 0, half_size_mm.z - 4.0);
    stone.add(block(centre, half_size_mm, 10.0), 1.0);
    // Chisel facets: shallow bowls struck at even angles.
    for (int i = 0; i < 46; ++i) {
        const double z = 0.85 - 1.75 * (i + 0.5) / 46;
        const double turn = 2.39996323 * i;
        const glm::dvec3 direction(std::sqrt(1 - z * z) * std::cos(turn),
                                   std::sqrt(1 - z * z) * std::sin(turn), z);
        const glm::dvec3 scaled = glm::abs(direction) / half_size_mm;
        const glm::dvec3 on_face = centre + direction / std::max({scaled.x, scaled.y, scaled.z});
        const double radius = 11.0 + 5.0 * std::sin(3.7 * i);
        if (on_face.z < centre.z + half_size_mm.z - 3.0)
            stone.carve(sphere(on_face + direction * radius * 0.78, radius), 5.0);
    }
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
