#include "experiment/scene/sculptures/figure_anatomy.h"

#include "experiment/scene/sculptures/loft.h"

namespace overt {

namespace {

/// Sections given in head heights.
std::vector<LoftSection> scaled(std::vector<LoftSection> sections, double head_mm, double breadth = 1.0) {
    for (LoftSection& s : sections) {
        s.half_side *= head_mm * breadth;
        s.half_front *= head_mm * breadth;
        s.side_shift *= head_mm;
        s.front_shift *= head_mm;
    }
    return sections;
}

std::vector<LoftSection> trunk_sections(bool is_woman) {
    if (is_woman)
        return {{0.0, 0.44, 0.33, 0, 0.0},     {0.13, 0.60, 0.40, 0, -0.01}, {0.24, 0.585, 0.385, 0, -0.01},
                {0.42, 0.43, 0.315, 0, 0.0},   {0.56, 0.485, 0.345, 0, 0},   {0.70, 0.53, 0.37, 0, 0.0},
                {0.82, 0.54, 0.345, 0, -0.02}, {0.92, 0.43, 0.27, 0, -0.03}, {0.97, 0.29, 0.205, 0, -0.03},
                {1.0, 0.10, 0.10, 0, -0.03}};
    return {{0.0, 0.42, 0.33, 0, 0.0},      {0.13, 0.55, 0.40, 0, -0.02}, {0.24, 0.565, 0.385, 0, -0.01},
            {0.40, 0.545, 0.36, 0, 0.0},    {0.55, 0.60, 0.395, 0, 0},    {0.68, 0.665, 0.44, 0, 0.0},
            {0.80, 0.665, 0.425, 0, -0.02}, {0.90, 0.55, 0.34, 0, -0.04}, {0.965, 0.35, 0.24, 0, -0.05},
            {1.0, 0.10, 0.10, 0, -0.05}};
}

/// Relief along a cord: a groove (negative) or a ridge.
Relief line_relief(const glm::dvec3& a, const glm::dvec3& control, const glm::dvec3& b, double half_width,
                   double height) {
    const Shape line = cord(a, control, b, glm::dvec3(half_width));
    return {[line, half_width, height](const glm::dvec3& point, double) {
                const double inside = std::clamp(-line.distance(point) / half_width, 0.0, 1.0);
                return height * smooth_step(inside);
            },
            line.ball};
}

void model_man(Clay& torso, const Placement& chest, const Placement& pelvis) {
    const double h = chest.scale;
    const auto on_chest = [&](double x, double y, double z) { return chest.to_world({x, y, z}); };
    const auto on_pelvis = [&](double x, double y, double z) { return pelvis.to_world({x, y, z}); };
    for (const double s : {-1.0, 1.0}) {
        const glm::dmat3 tilt = chest.axes * frame_of({s * 0.30, 0.22, 1.0}, {s * 0.40, 1.0, -0.2});
        torso.add(ellipsoid(on_chest(s * 0.32, -0.275, 0.23), h * glm::dvec3(0.36, 0.105, 0.27), tilt),
                  0.20 * h);
        torso.add(ellipsoid(on_chest(s * 0.30, -0.33, 0.10), h * glm::dvec3(0.27, 0.075, 0.12), tilt),
                  0.20 * h);
        // Shoulder blade, flank and the long muscle of the back.
        torso.add(ellipsoid(on_chest(s * 0.36, 0.31, 0.12), h * glm::dvec3(0.24, 0.09, 0.33), chest.axes),
                  0.26 * h);
        torso.add(bar(on_chest(s * 0.54, 0.12, 0.12), on_chest(s * 0.36, 0.16, -0.62), 0.16 * h, 0.13 * h),
                  0.22 * h);
        torso.add(bar(on_chest(s * 0.09, 0.28, 0.30), on_pelvis(s * 0.11, 0.28, 0.42), 0.10 * h, 0.11 * h),
                  0.22 * h);
        // The fold of the flank over the hip, which ancient sculptors stress, down to the groin.
        torso.add(ellipsoid(on_pelvis(s * 0.37, -0.05, 0.56), h * glm::dvec3(0.19, 0.30, 0.24), pelvis.axes),
                  0.26 * h);
        // The straight muscle of the belly.
        torso.add(
            bar(on_chest(s * 0.14, -0.27, -0.33), on_pelvis(s * 0.10, -0.255, 0.30), 0.17 * h, 0.14 * h),
            0.22 * h);
        torso.add(ellipsoid(on_pelvis(s * 0.25, 0.26, -0.04), h * glm::dvec3(0.28, 0.25, 0.33), pelvis.axes),
                  0.18 * h);
    }
}

/// Grooves between the muscles, and the navel.
void draw_muscles(Clay& torso, const Placement& chest, const Placement& pelvis) {
    const double h = chest.scale;
    const auto on_chest = [&](double x, double y, double z) { return chest.to_world({x, y, z}); };
    const auto on_pelvis = [&](double x, double y, double z) { return pelvis.to_world({x, y, z}); };
    for (const double s : {-1.0, 1.0}) {
        torso.emboss(line_relief(on_pelvis(s * 0.60, -0.10, 0.36), on_pelvis(s * 0.44, -0.46, 0.30),
                                 on_pelvis(s * 0.12, -0.38, -0.10), 0.11 * h, -0.035 * h));
        torso.emboss(line_relief(on_chest(s * 0.02, -0.46, -0.26), on_chest(s * 0.30, -0.46, -0.28),
                                 on_chest(s * 0.50, -0.32, -0.62), 0.10 * h, -0.028 * h));
        torso.emboss(line_relief(on_chest(s * 0.30, -0.42, -0.35), on_chest(s * 0.31, -0.42, -0.75),
                                 on_pelvis(s * 0.22, -0.40, 0.30), 0.10 * h, -0.022 * h));
        for (const double z : {-0.50, -0.72})
            torso.emboss(line_relief(on_chest(s * 0.03, -0.45, z), on_chest(s * 0.14, -0.45, z - 0.02),
                                     on_chest(s * 0.25, -0.42, z + 0.02), 0.06 * h, -0.015 * h));
        torso.add(sphere(on_chest(s * 0.37, -0.405, 0.06), 0.028 * h), 0.03 * h);
    }
    torso.emboss(line_relief(on_chest(0, -0.42, 0.40), on_chest(0, -0.44, -0.0), on_chest(0, -0.46, -0.30),
                             0.09 * h, -0.030 * h));
    torso.emboss(line_relief(on_chest(0, -0.46, -0.34), on_chest(0, -0.46, -0.75), on_pelvis(0, -0.42, 0.46),
                             0.07 * h, -0.020 * h));
    torso.emboss(line_relief(on_chest(0, 0.36, 0.35), on_chest(0, 0.46, -0.35), on_pelvis(0, 0.36, 0.35),
                             0.13 * h, -0.035 * h));
    torso.carve(sphere(on_pelvis(0, -0.42, 0.44), 0.030 * h), 0.04 * h);
}

void model_woman(Clay& torso, const Placement& chest, const Placement& pelvis) {
    const double h = chest.scale;
    for (const double s : {-1.0, 1.0}) {
        torso.add(ellipsoid(chest.to_world({s * 0.255, -0.315, 0.03}), h * glm::dvec3(0.205, 0.195, 0.205),
                            chest.axes),
                  0.12 * h);
        torso.add(bar(chest.to_world({s * 0.26, -0.30, 0.10}), chest.to_world({s * 0.45, -0.12, 0.45}),
                      0.12 * h, 0.10 * h),
                  0.16 * h);
        torso.add(ellipsoid(pelvis.to_world({s * 0.25, 0.25, -0.02}), h * glm::dvec3(0.29, 0.25, 0.32),
                            pelvis.axes),
                  0.14 * h);
    }
    torso.add(ellipsoid(pelvis.to_world({0, -0.20, 0.22}), h * glm::dvec3(0.30, 0.20, 0.30), pelvis.axes),
              0.20 * h);
}

} // namespace

Clay sculpt_trunk(const BodyPose& pose) {
    const double h = pose.head.scale;
    const LoftAxis spine{pose.pelvis.to_world({0, 0.02, -0.30}),
                         0.5 *
                             (pose.pelvis.to_world({0, 0.02, 0.75}) + pose.chest.to_world({0, 0.02, -0.75})),
                         pose.chest.to_world({0, 0.06, 0.92}),
                         -pose.pelvis.axes[1],
                         -pose.chest.axes[1],
                         pose.chest.axes[0]};
    Clay torso;
    torso.add(loft(spine, scaled(trunk_sections(pose.is_woman), h), 0.6), 1.0);
    for (const ArmPose* arm : {&pose.right_arm, &pose.left_arm}) {
        // From the neck to the shoulder, and the collar bone before it.
        const double breadth = pose.is_woman ? 0.8 : 1.0;
        const glm::dvec3 nape =
            glm::mix(pose.chest.to_world({0, 0.10, 0.82}), pose.head.to_world({0, 0.20, -0.42}), 0.35);
        torso.add(bar(nape, glm::mix(arm->shoulder, nape, 0.22), 0.10 * h * breadth, 0.14 * h * breadth),
                  0.26 * h);
        torso.add(bar(pose.chest.to_world({0.0, -0.19, 0.70}), arm->shoulder + 0.05 * h * pose.chest.axes[2],
                      0.045 * h, 0.05 * h),
                  0.10 * h);
        torso.add(bar(arm->shoulder, pose.chest.to_world({arm == &pose.left_arm ? 0.35 : -0.35, -0.12, 0.3}),
                      0.20 * h * breadth, 0.22 * h * breadth),
                  0.20 * h);
    }
    if (pose.is_woman)
        model_woman(torso, pose.chest, pose.pelvis);
    else
        model_man(torso, pose.chest, pose.pelvis);
    return torso;
}

Clay sculpt_torso(const BodyPose& pose) {
    Clay torso = sculpt_trunk(pose);
    if (!pose.is_woman)
        draw_muscles(torso, pose.chest, pose.pelvis);
    return torso;
}

Clay sculpt_neck(const BodyPose& pose) {
    const double h = pose.head.scale;
    const double breadth = pose.is_woman ? 0.84 : 1.0;
    const LoftAxis axis{pose.chest.to_world({0, 0.03, 0.62}),
                        0.5 * (pose.chest.to_world({0, 0.04, 1.05}) + pose.head.to_world({0, 0.12, -0.52})),
                        pose.head.to_world({0, 0.10, -0.18}),
                        -pose.chest.axes[1],
                        -pose.head.axes[1],
                        pose.chest.axes[0]};
    Clay neck;
    neck.add(loft(axis, scaled({{0, 0.22, 0.18}, {0.3, 0.24, 0.225}, {0.6, 0.225, 0.24}, {1, 0.225, 0.245}},
                               h, breadth)),
             1.0);
    for (const double s : {-1.0, 1.0}) // from behind the ear to the pit of the throat
        neck.add(bar(pose.head.to_world({s * 0.22, 0.10, -0.22}),
                     pose.chest.to_world({s * 0.06, -0.13, 0.70}), 0.06 * h * breadth, 0.025 * h * breadth),
                 0.12 * h);
    if (!pose.is_woman)
        neck.add(sphere(glm::mix(pose.head.to_world({0, -0.15, -0.42}), pose.chest.to_world({0, -0.17, 0.85}),
                                 0.4),
                        0.05 * h),
                 0.10 * h);
    return neck;
}

Clay sculpt_arm(const BodyPose& pose, const ArmPose& arm) {
    const double h = pose.head.scale;
    const double breadth = pose.is_woman ? 0.84 : 1.0;
    const glm::dvec3 upper = glm::normalize(arm.elbow - arm.shoulder);
    const glm::dvec3 lower = glm::normalize(arm.wrist - arm.elbow);
    // The biceps lies on the side that the elbow bends to.
    glm::dvec3 bend = lower - upper * glm::dot(lower, upper);
    if (glm::length(bend) < 0.05)
        bend = -pose.chest.axes[1] - upper * glm::dot(-pose.chest.axes[1], upper);
    const glm::dvec3 side = glm::cross(upper, bend);
    Clay clay;
    clay.add(
        loft(LoftAxis::straight(arm.shoulder, arm.elbow, bend, side), scaled({{0, 0.22, 0.235},
                                                                              {0.25, 0.215, 0.235, 0, 0.01},
                                                                              {0.5, 0.19, 0.225, 0, 0.02},
                                                                              {0.75, 0.165, 0.19, 0, 0.01},
                                                                              {0.9, 0.155, 0.165},
                                                                              {1, 0.13, 0.13}},
                                                                             h, breadth)),
        1.0);
    const glm::dvec3 outwards = glm::normalize(arm.shoulder - pose.chest.to_world({0, 0, 0.45}));
    if (!pose.is_woman)
        clay.add(ellipsoid(arm.shoulder + 0.30 * h * upper + 0.045 * h * outwards,
                           h * glm::dvec3(0.215, 0.235, 0.36), frame_of(-upper, pose.chest.axes[1])),
                 0.12 * h);
    else
        clay.add(ellipsoid(arm.shoulder + 0.20 * h * upper, h * glm::dvec3(0.19, 0.20, 0.30),
                           frame_of(-upper, pose.chest.axes[1])),
                 0.14 * h);
    // The forearm's broad side turns with the hand.
    const glm::dvec3 palm = glm::normalize(arm.palm - lower * glm::dot(arm.palm, lower));
    LoftAxis forearm = LoftAxis::straight(arm.elbow, arm.wrist, bend, side);
    forearm.front_at_start = glm::normalize(palm + 1.2 * glm::normalize(bend));
    forearm.front_at_end = palm;
    forearm.side = glm::cross(lower, palm);
    clay.add(loft(forearm, scaled({{0, 0.13, 0.13},
                                   {0.22, 0.19, 0.18},
                                   {0.5, 0.165, 0.15},
                                   {0.8, 0.118, 0.098},
                                   {1, 0.106, 0.080}},
                                  h, breadth)),
             0.10 * h);
    clay.add(sphere(arm.elbow - 0.05 * h * glm::normalize(lower - upper + 0.01 * bend), 0.13 * h * breadth),
             0.08 * h);
    return clay;
}

Shape placed_hand(const BodyPose& pose, const ArmPose& arm, bool is_left) {
    Placement place;
    place.origin = arm.wrist;
    place.scale = pose.head.scale * (pose.is_woman ? 0.70 : 0.78);
    place.axes = frame_of(arm.fingers, -arm.palm);
    if (is_left)
        place.axes[0] = -place.axes[0];
    return place.place(sculpt_hand(arm.hand).shape());
}

Clay sculpt_leg(const BodyPose& pose, const LegPose& leg) {
    const double h = pose.head.scale;
    const double breadth = pose.is_woman ? 0.94 : 1.0;
    const glm::dvec3 thigh = glm::normalize(leg.knee - leg.hip);
    const glm::dvec3 shank = glm::normalize(leg.ankle - leg.knee);
    // The knee's front: where the bend points, or for a straight leg where the toes point.
    const glm::dvec3 front = glm::normalize(thigh - shank + 0.35 * glm::normalize(leg.toes));
    const glm::dvec3 outer = glm::normalize(leg.hip - pose.pelvis.origin);
    Clay clay;
    clay.add(
        loft(LoftAxis::straight(leg.hip, leg.knee, front, outer), scaled({{0, 0.275, 0.34, -0.03, 0},
                                                                          {0.2, 0.335, 0.375, -0.02, 0.01},
                                                                          {0.45, 0.315, 0.345, 0.0, 0.025},
                                                                          {0.7, 0.255, 0.275, 0.01, 0.02},
                                                                          {0.9, 0.190, 0.205, 0, 0.005},
                                                                          {1, 0.150, 0.155}},
                                                                         h, breadth)),
        1.0);
    clay.add(loft(LoftAxis::straight(leg.knee, leg.ankle, front, outer),
                  scaled({{0, 0.150, 0.155, 0, 0},
                          {0.12, 0.178, 0.195, 0, -0.015},
                          {0.30, 0.218, 0.235, 0.01, -0.055},
                          {0.5, 0.19, 0.20, 0.005, -0.05},
                          {0.75, 0.125, 0.14, 0, -0.02},
                          {0.92, 0.105, 0.13, 0, -0.01},
                          {1, 0.11, 0.14, 0, -0.01}},
                         h, breadth)),
             0.10 * h);
    if (!pose.is_woman) {
        const glm::dvec3 side = glm::normalize(glm::cross(thigh, front));
        const glm::dvec3 above = leg.knee - 0.36 * h * thigh + 0.07 * h * front;
        for (const double s : {-1.0, 1.0})
            clay.add(ellipsoid(above + s * 0.13 * h * side, h * glm::dvec3(0.10, 0.11, 0.24),
                               frame_of(-thigh, -front)),
                     0.12 * h);
        const glm::dvec3 calf = leg.knee + 0.55 * h * shank - 0.14 * h * front;
        for (const double s : {-1.0, 1.0})
            clay.add(ellipsoid(calf + s * 0.085 * h * side, h * glm::dvec3(0.115, 0.12, 0.34),
                               frame_of(-shank, -front)),
                     0.10 * h);
    }
    clay.add(
        ellipsoid(leg.knee + 0.125 * h * front, h * glm::dvec3(0.095, 0.075, 0.12), frame_of(-shank, -front)),
        0.09 * h);
    return clay;
}

Shape placed_foot(const BodyPose& pose, const LegPose& leg, bool is_left) {
    Placement place;
    place.scale = pose.head.scale * (pose.is_woman ? 0.98 : 1.06);
    const glm::dvec3 up = glm::normalize(leg.up);
    // The sole is pressed a little into the ground, so that no crevice is left around it.
    place.origin = leg.ankle - 0.31 * place.scale * up;
    place.axes = frame_of(up, -leg.toes);
    if (is_left)
        place.axes[0] = -place.axes[0];
    return place.place(sculpt_foot().shape());
}

} // namespace overt
