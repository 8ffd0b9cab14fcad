#include <cmath>

#include "experiment/scene/sculptures/drapery.h"
#include "experiment/scene/sculptures/figure_anatomy.h"
#include "experiment/scene/sculptures/figures.h"
#include "experiment/scene/sculptures/loft.h"
#include "experiment/scene/sculptures/pedestals.h"

namespace overt {

namespace {

constexpr double head_mm = 81.0;
constexpr double ground = plinth_height_mm;
constexpr double rock_top = ground + 138.0;

/// He stands on his left leg, seen from his left, and bows over the right foot, which is set on a rock; the
/// left forearm lies on the raised knee, the right hand is at the sandal; the face is turned to the viewer.
BodyPose runner_pose() {
    BodyPose pose;
    pose.pelvis = {{66, 22, ground + 3.84 * head_mm}, posture(-64, 32, 3), head_mm};
    pose.chest = {{-9, -8, ground + 5.0 * head_mm}, posture(-58, 54, 4), head_mm};
    pose.head = {{-100, -48, ground + 6.08 * head_mm}, posture(-24, 12, -6), head_mm};
    pose.left_leg = {pose.pelvis.to_world({0.36, 0, 0.02}),
                     {84, -22, ground + 2.08 * head_mm},
                     {93, -18, ground + 0.29 * head_mm},
                     {-0.75, -0.75, 0}};
    pose.right_leg = {pose.pelvis.to_world({-0.36, 0, 0}),
                      {-74, 14, ground + 3.58 * head_mm},
                      {-88, 14, rock_top + 0.29 * head_mm},
                      {-0.95, -0.38, 0}};
    pose.left_arm = {pose.chest.to_world({0.76, 0.02, 0.56}),
                     {-26, -66, ground + 4.0 * head_mm},
                     {-100, -22, ground + 3.72 * head_mm},
                     {-0.75, 0.05, -0.6},
                     {-0.2, 0.75, -0.55},
                     {{18, 22, 28, 34}, 22}};
    pose.right_arm = {pose.chest.to_world({-0.76, 0.02, 0.56}),
                      {-124, 14, ground + 4.05 * head_mm},
                      {-122, -8, ground + 2.92 * head_mm},
                      {0.25, 0.05, -1},
                      {0.9, 0.35, 0.1},
                      {{28, 30, 32, 34}, 20}};
    return pose;
}

/// The short cloak: wound about the hips and the raised thigh, from where an end falls towards the viewer.
Clay sculpt_cloak(const BodyPose& pose, const Clay& loins) {
    const LegPose& leg = pose.right_leg;
    const auto on_thigh = [&](double share) { return glm::mix(leg.hip, leg.knee, share); };
    const glm::dvec3 waist =
        glm::normalize(pose.pelvis.axes[2] + 0.25 * pose.pelvis.axes[1] - 0.15 * pose.pelvis.axes[0]);
    Clay cloak;
    cloak.add(common(common(common(grown(loins.shape(), 5.0),
                                   half_space(pose.pelvis.to_world({0, 0, 0.40}), waist), 4.0),
                            half_space({70, -10, 316}, {0.50, 0.05, -1.0}), 4.0),
                     half_space(on_thigh(0.80), leg.knee - leg.hip), 4.0),
              1.0);
    const glm::dvec3 top = on_thigh(0.52) + glm::dvec3(0, -20, 6);
    const LoftAxis fall{
        top,      top + glm::dvec3(0, -12, -70), top + glm::dvec3(10, -8, -150), {0, -1, 0}, {0, -1, 0},
        {1, 0, 0}};
    cloak.add(loft(fall, {{0, 44, 18}, {0.25, 39, 15}, {0.6, 34, 12}, {1, 40, 14}}, 0.2), 24.0);

    std::vector<Fold> folds;
    struct Pipe {
        double thigh, x_end, drop, width, height;
    };
    for (const Pipe& p : {Pipe{0.22, 50, 150, 9.5, 9.0},
                          {0.36, 30, 147, 8.5, 7.5},
                          {0.44, 19, 118, 5.5, 5.5},
                          {0.50, 9, 142, 9.5, 10.0},
                          {0.60, -9, 130, 8.0, 7.5},
                          {0.66, -18, 96, 5.5, 5.5},
                          {0.74, -32, 108, 9.0, 9.0}}) {
        const glm::dvec3 start = on_thigh(p.thigh) + glm::dvec3(3, 6, 30);
        const double x_middle = glm::mix(on_thigh(p.thigh).x, top.x + p.x_end, 0.45);
        folds.push_back({hanging_path({start,
                                       {on_thigh(p.thigh).x, top.y - 12, top.z + 14},
                                       {x_middle, top.y - 24, top.z - 42},
                                       {top.x + 8 + p.x_end, top.y - 24, top.z - p.drop - 14}}),
                         0.6 * p.width, p.width, p.height, 0.3, 0.0});
    }
    // Swags from the left hip to the raised thigh.
    struct Swag {
        glm::dvec3 from, through;
        double thigh, width, height;
    };
    for (const Swag& w : {Swag{{100, -40, 396}, {66, -60, 372}, 0.10, 6, 5},
                          {{104, -38, 384}, {70, -60, 358}, 0.16, 6, 5.5},
                          {{107, -36, 371}, {74, -60, 345}, 0.20, 6, 5.5},
                          {{108, -34, 357}, {78, -58, 332}, 0.22, 6, 5},
                          {{108, -32, 343}, {84, -54, 324}, 0.0, 5.5, 4.5}})
        folds.push_back({hanging_path({w.from, w.through, on_thigh(w.thigh) + glm::dvec3(-2, -24, 12)}),
                         0.7 * w.width, w.width, w.height, 0.3, 0.35});
    for (int i = 0; i < 3; ++i)
        folds.push_back({hanging_path({on_thigh(0.40 + 0.12 * i) + glm::dvec3(4, 14, 26),
                                       on_thigh(0.58 + 0.08 * i) + glm::dvec3(0, -6, 30),
                                       on_thigh(0.72 + 0.03 * i) + glm::dvec3(0, -26, 4)}),
                         4.5, 5.5, 4.0, 0.3, 0.4});
    cloak.emboss(fold_relief(cloak, folds));
    // The hem rises in steps, as the edges of a cloth do that hangs by its middle.
    cloak.carve(half_space(top + glm::dvec3(16, 0, -132), {0.30, 0.0, 1.0}), 3.0);
    cloak.carve(half_space(top + glm::dvec3(-14, 0, -112), {-0.75, 0.0, 1.0}), 3.0);
    return cloak;
}

/// A sandal: a sole, and two straps around the foot.
Clay sculpt_sandal(const BodyPose& pose, const LegPose& leg, bool is_left) {
    const glm::dvec3 toes = glm::normalize(leg.toes);
    const glm::dvec3 side = glm::cross(toes, leg.up);
    const double foot = 1.06 * head_mm;
    const glm::dvec3 below_ankle = leg.ankle - 0.29 * head_mm * leg.up + 2.0 * leg.up;
    Clay sandal;
    const auto sole =
        LoftAxis::straight(below_ankle - 0.22 * foot * toes, below_ankle + 0.68 * foot * toes, leg.up, side);
    sandal.add(loft(sole,
                    {{0, 0.11 * foot, 4.5},
                     {0.2, 0.14 * foot, 4.5},
                     {0.45, 0.15 * foot, 4.5},
                     {0.8, 0.20 * foot, 4.5},
                     {1, 0.17 * foot, 4.5}},
                    2.0),
               1.0);
    const Shape over_foot = grown(placed_foot(pose, leg, is_left), 2.2);
    const glm::dvec3 slant = glm::normalize(toes - 0.45 * leg.up);
    for (const double share : {0.08, 0.40}) {
        const glm::dvec3 middle = below_ankle + share * foot * toes + 0.16 * foot * leg.up;
        sandal.add(common(common(over_foot, half_space(middle + 4.0 * slant, slant), 2.5),
                          half_space(middle - 4.0 * slant, -slant), 2.5),
                   2.0);
    }
    return sandal;
}

/// The trunk of a tree that takes the standing leg's load.
Clay sculpt_tree() {
    Clay tree;
    const LoftAxis axis{{118, 34, ground - 4},
                        {122, 36, ground + 80},
                        {104, 26, ground + 200},
                        {0, -1, 0},
                        {0, -1, 0},
                        {1, 0, 0}};
    tree.add(loft(axis, {{0, 31, 29}, {0.12, 24, 22}, {0.5, 19, 18}, {0.85, 18, 17}, {1, 16, 15}}, 0.4), 1.0);
    tree.add(bar({116, 30, ground + 120}, {140, 20, ground + 150}, 9, 7), 8.0);
    std::vector<Fold> bark;
    for (int i = 0; i < 11; ++i) {
        const double angle = -165.0 + 30.0 * i;
        bark.push_back({falling_path(tree, {118, 35}, angle, ground + 150 + 12 * std::sin(2.1 * i),
                                     angle + 22 * std::sin(1.3 * i), ground + 2),
                        4.0, 7.0, 2.6, 0.3, 0.0});
    }
    tree.emboss(fold_relief(tree, bark));
    return tree;
}

} // namespace

Figure model_runner() {
    const BodyPose pose = runner_pose();
    Figure figure;
    figure.head.add(pose.head.place(sculpt_head({Hair::curls, false, 0.97, 1.0}).shape()), 1.0);
    figure.head.add(sculpt_neck(pose), 5.0);
    // The cloak follows the large forms, the skin has the grooves too.
    Clay loins = sculpt_trunk(pose);
    Clay skin = sculpt_torso(pose);
    for (Clay* clay : {&loins, &skin}) {
        clay->add(sculpt_leg(pose, pose.left_leg), 26.0);
        clay->add(sculpt_leg(pose, pose.right_leg), 26.0);
    }
    skin.add(sculpt_arm(pose, pose.left_arm), 14.0);
    skin.add(sculpt_arm(pose, pose.right_arm), 14.0);
    figure.body.add(skin, 1.0);
    figure.body.add(sculpt_cloak(pose, loins), 7.0);
    figure.body.add(placed_hand(pose, pose.right_arm, false), 5.0);
    figure.body.add(placed_hand(pose, pose.left_arm, true), 5.0);
    figure.body.add(placed_foot(pose, pose.right_leg, false), 6.0);
    figure.body.add(placed_foot(pose, pose.left_leg, true), 6.0);
    figure.body.add(sculpt_sandal(pose, pose.right_leg, false), 2.5);
    figure.body.add(sculpt_sandal(pose, pose.left_leg, true), 2.5);
    figure.plinth = square_plinth({162, 86});
    figure.plinth.add(rock({-100, 8, ground}, {52, 48, 0.5 * (rock_top - ground) + 3.0}), 3.0);
    figure.plinth.add(sculpt_tree(), 4.0);
    figure.neck_blend_mm = 28.0;
    figure.plinth_blend_mm = 4.0;
    figure.mid_neck = glm::mix(pose.chest.to_world({0, 0, 0.95}), pose.head.to_world({0, 0.1, -0.45}), 0.5);
    figure.neck_axis = pose.head.origin - pose.chest.to_world({0, 0, 0.9});
    figure.fovea = {{pose.head.origin, 56.0}, 0.55};
    figure.box_mm = {{-190, -120, 0}, {190, 120, 640}};
    return figure;
}

} // namespace overt
