/// How an object stands while it is shown.
#pragma once

#include <cmath>

#include <glm/ext/quaternion_double.hpp>
#include <glm/glm.hpp>

#include "experiment/units.h"

namespace overt {

/// How an object stands: turned about the vertical through the centre of its box, then tilted about the same
/// centre, and then moved. The world's axes are those of scene/viewing.h; up is +z, the front looks to -y.
/// A turn alone is all that most motions are made of, and is carried out as if there were nothing else.
struct ObjectPose {
    Degrees angle;                       ///< about the vertical, counter-clockwise seen from above
    glm::dquat tilt{1.0, 0.0, 0.0, 0.0}; ///< of unit length, with w >= 0
    glm::dvec3 shift{0.0};               ///< in the unit of the mesh

    /// Whether it is turned about the vertical and nothing else.
    bool is_turn() const { return tilt == glm::dquat(1.0, 0.0, 0.0, 0.0) && shift == glm::dvec3(0.0); }

    friend bool operator==(const ObjectPose&, const ObjectPose&) = default;
};

/// Whether two turns are one: motions come to the same angle by different sums, and 25 sin(30 deg) is
/// not 12.5 to the last bit.
constexpr bool is_same_turn(Degrees a, Degrees b) {
    constexpr double rounding_deg = 1e-9;
    return a.value - b.value <= rounding_deg && b.value - a.value <= rounding_deg;
}

/// Whether two ways to stand are one, likewise.
inline bool is_same_object_pose(const ObjectPose& a, const ObjectPose& b) {
    constexpr double rounding = 1e-9;
    const auto is_near = [](double one, double other) { return std::abs(one - other) <= rounding; };
    return is_same_turn(a.angle, b.angle) && is_near(a.tilt.w, b.tilt.w) && is_near(a.tilt.x, b.tilt.x) &&
           is_near(a.tilt.y, b.tilt.y) && is_near(a.tilt.z, b.tilt.z) && is_near(a.shift.x, b.shift.x) &&
           is_near(a.shift.y, b.shift.y) && is_near(a.shift.z, b.shift.z);
}

/// Turned by `angle` about `axis` (not of length 0) through `pivot`, a place from the centre of the box in
/// the unit of the mesh, after it was turned about the vertical by `before`. About the vertical through the
/// centre it is a turn alone.
ObjectPose turned_about(glm::dvec3 axis, glm::dvec3 pivot, Degrees angle, Degrees before = {});

/// On the shortest way from one to another: at 0 the one, at 1 the other.
ObjectPose between(const ObjectPose& from, const ObjectPose& to, double share);

/// Turned by a rotation (not of length 0) about the centre of the box from its front view, and then moved. A
/// rotation about the vertical without a move is a turn alone, from -180 (not included) to 180 degrees.
ObjectPose object_pose_of(glm::dquat rotation, glm::dvec3 shift);

} // namespace overt
