#include "experiment/colour/display_characterisation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace overt {

glm::dvec3 DisplayCharacterisation::white_xyz() const {
    return black_xyz + primaries_xyz[0] + primaries_xyz[1] + primaries_xyz[2];
}

double DisplayCharacterisation::luminance_of(double linear) const {
    return black_xyz.y + linear * (white_xyz().y - black_xyz.y);
}

double DisplayCharacterisation::linear_of(double luminance_cd_m2) const {
    return (luminance_cd_m2 - black_xyz.y) / (white_xyz().y - black_xyz.y);
}

double DisplayCharacterisation::contrast() const {
    return black_xyz.y > 0.0 ? white_xyz().y / black_xyz.y : std::numeric_limits<double>::infinity();
}

glm::dvec3 DisplayCharacterisation::luminance_shares() const {
    const glm::dvec3 luminances(primaries_xyz[0].y, primaries_xyz[1].y, primaries_xyz[2].y);
    return luminances / (luminances.x + luminances.y + luminances.z);
}

glm::dvec3 DisplayCharacterisation::linear_of_signal(const glm::dvec3& signal) const {
    return {curves[0].light_of(signal.x), curves[1].light_of(signal.y), curves[2].light_of(signal.z)};
}

glm::dvec3 DisplayCharacterisation::xyz_of_signal(const glm::dvec3& signal) const {
    return black_xyz + primary_matrix(primaries_xyz) * linear_of_signal(signal);
}

glm::dmat3 primary_matrix(const std::array<glm::dvec3, 3>& primaries) {
    return glm::dmat3(primaries[0], primaries[1], primaries[2]);
}

double independence_of(const std::array<glm::dvec3, 3>& primaries) {
    std::array<glm::dvec3, 3> directions = primaries;
    for (glm::dvec3& direction : directions) {
        const double length = glm::length(direction);
        if (!(length > 0.0) || !std::isfinite(length))
            return 0.0;
        direction /= length;
    }
    const glm::dmat3 inverse = glm::inverse(primary_matrix(directions));
    double norm = 0.0;
    for (int column = 0; column < 3; ++column)
        norm += glm::dot(inverse[column], inverse[column]);
    // The norm of the matrix itself is sqrt(3).
    return std::isfinite(norm) && norm > 0.0 ? 1.0 / std::sqrt(3.0 * norm) : 0.0;
}

} // namespace overt
