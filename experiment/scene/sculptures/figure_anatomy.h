/// A human body in a pose. The measures follow the canon of seven and a half heads: all are multiples of the
/// head's height. Coordinates in mm, +z up; a figure that faces the viewer faces -y, its left is +x.
#pragma once

#include <array>

#include "experiment/scene/sculptures/clay.h"
#include "experiment/scene/sculptures/extremities.h"
#include "experiment/scene/sculptures/head.h"

namespace overt {

struct ArmPose {
    glm::dvec3 shoulder, elbow, wrist;
    glm::dvec3 fingers; ///< direction that the hand points in
    glm::dvec3 palm;    ///< direction that the palm faces
    HandShape hand;
};

struct LegPose {
    glm::dvec3 hip, knee, ankle;
    glm::dvec3 toes;              ///< direction that the foot points in
    glm::dvec3 up{0.0, 0.0, 1.0}; ///< away from the ground under the foot
};

/// Placements have the head's height as scale and the figure's own axes: x to its left, y back, z up.
struct BodyPose {
    Placement head;   ///< origin between the ears
    Placement chest;  ///< origin in the middle of the rib cage
    Placement pelvis; ///< origin between the hip joints
    ArmPose right_arm, left_arm;
    LegPose right_leg, left_leg;
    bool is_woman = false;
};

/// Trunk from the crotch to the shoulders, with the muscles of a man or the breasts of a woman, in large
/// forms as a garment follows them.
Clay sculpt_trunk(const BodyPose& pose);

/// The same as bare skin, with the grooves between the muscles.
Clay sculpt_torso(const BodyPose& pose);

/// Neck from the chest into the head.
Clay sculpt_neck(const BodyPose& pose);

/// Arm with its shoulder muscle, without the hand.
Clay sculpt_arm(const BodyPose& pose, const ArmPose& arm);

/// The hand, where the arm ends. `is_left` mirrors it.
Shape placed_hand(const BodyPose& pose, const ArmPose& arm, bool is_left);

/// Leg from the hip to the ankle.
Clay sculpt_leg(const BodyPose& pose, const LegPose& leg);

/// The foot, where the leg ends. `is_left` mirrors it.
Shape placed_foot(const BodyPose& pose, const LegPose& leg, bool is_left);

} // namespace overt
