/// How a piece of surface is turned from the line of sight on which it is seen: slant and tilt.
#pragma once

#include <algorithm>
#include <cmath>

#include <glm/glm.hpp>

#include "experiment/units.h"

namespace overt {

/// Slant is the angle between the surface's normal and the line from the place to the eye, 0 ... 90 degrees
/// of what is seen. Tilt is the direction on the screen in which the normal leans, from the right
/// counter-clockwise, 0 ... 360 degrees; it says nothing where the slant is 0. Koenderink, van Doorn and
/// Kappers, "Surface perception in pictures", Perception & Psychophysics 52(5), 1992.
struct Attitude {
    Degrees slant, tilt;
    friend constexpr bool operator==(const Attitude&, const Attitude&) = default;
};

/// The unit normal, in a frame whose z points to the eye, x to the right and y up.
inline glm::dvec3 normal_of(const Attitude& attitude) {
    const double slant = to_radians(attitude.slant).value, tilt = to_radians(attitude.tilt).value;
    return {std::sin(slant) * std::cos(tilt), std::sin(slant) * std::sin(tilt), std::cos(slant)};
}

/// Of a normal in that frame, of any length but 0.
inline Attitude attitude_of(const glm::dvec3& normal) {
    const double tilt = to_degrees(Radians{std::atan2(normal.y, normal.x)}).value;
    return {to_degrees(Radians{std::atan2(std::hypot(normal.x, normal.y), normal.z)}),
            Degrees{tilt < 0.0 ? tilt + 360.0 : tilt}};
}

/// Between the two normals, 0 ... 180 degrees.
inline Degrees angle_between(const Attitude& a, const Attitude& b) {
    const glm::dvec3 one = normal_of(a), other = normal_of(b);
    return to_degrees(Radians{std::atan2(glm::length(glm::cross(one, other)), glm::dot(one, other))});
}

/// The frame of a line of sight, in coordinates whose origin is the eye, x to the right, y up and z towards
/// the viewer: columns are its x, y and z. In the middle of the picture it is these axes; elsewhere they are
/// turned with the line, x staying level.
inline glm::dmat3 frame_of_sight(const glm::dvec3& place) {
    const glm::dvec3 to_eye = -glm::normalize(place);
    const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0.0, 1.0, 0.0), to_eye));
    return {right, glm::cross(to_eye, right), to_eye};
}

} // namespace overt
