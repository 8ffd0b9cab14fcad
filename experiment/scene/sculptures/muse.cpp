#include "experiment/scene/sculptures/drapery.h"
#include "experiment/scene/sculptures/figure_anatomy.h"
#include "experiment/scene/sculptures/figures.h"
#include "experiment/scene/sculptures/loft.h"
#include "experiment/scene/sculptures/pedestals.h"

namespace overt {

namespace {

constexpr double head_mm = 71.0;
constexpr double ground = plinth_height_mm;

/// Weight on the left leg, the right knee forward; the right hand at the breast, the left forearm forward
/// with the cloak over it; the head turned and bowed to her right.
BodyPose muse_pose() {
    BodyPose pose;
    pose.is_woman = true;
    pose.pelvis = {{5, 0, ground + 3.85 * head_mm}, posture(-4, 0, -6), head_mm};
    pose.chest = {{0, 1, ground + 5.40 * head_mm}, posture(3, -2, 5), head_mm};
    pose.head = {{-4, -7, ground + 7.0 * head_mm}, posture(-20, 9, -5), head_mm};
    pose.right_leg = {pose.pelvis.to_world({-0.36, 0, 0}),
                      {-30, -36, ground + 2.02 * head_mm},
                      {-40, 8, ground + 0.30 * head_mm},
                      {-0.35, -1, 0}};
    pose.left_leg = {pose.pelvis.to_world({0.36, 0, 0}),
                     {28, -5, ground + 2.05 * head_mm},
                     {24, 2, ground + 0.29 * head_mm},
                     {0.3, -1, 0}};
    pose.right_arm = {pose.chest.to_world({-0.72, 0.05, 0.56}),
                      {-74, -18, ground + 4.75 * head_mm},
                      {-18, -58, ground + 5.25 * head_mm},
                      {0.62, 0.15, 0.55},
                      {0.25, 1, -0.3},
                      {{12, 18, 26, 32}, 25}};
    pose.left_arm = {pose.chest.to_world({0.72, 0.05, 0.56}),
                     {70, 10, ground + 4.68 * head_mm},
                     {66, -62, ground + 4.55 * head_mm},
                     {0.0, -1, 0.05},
                     {-0.75, 0.1, 0.45},
                     {{35, 42, 48, 52}, 35}};
    return pose;
}

/// The long robe, from the shoulders to the ground, without folds.
Clay bare_robe(const BodyPose& pose) {
    Clay robe;
    const auto axis =
        LoftAxis::straight({2, 4, ground + 1}, {2, 2, ground + 5.0 * head_mm}, {0, -1, 0}, {1, 0, 0});
    robe.add(loft(axis,
                  {{0.0, 63, 46, 0, 2},
                   {0.04, 62, 46, 0, 2},
                   {0.2, 57, 43, 0, 3},
                   {0.4, 52, 38, 0, 2},
                   {0.62, 48, 33, 1, 0},
                   {0.76, 45, 31, 1, 0},
                   {0.9, 37, 27, 0, 0},
                   {1.0, 35, 26, 0, 0}},
                  0.1),
             1.0);
    robe.add(grown(sculpt_torso(pose).shape(), 2.2), 16.0);
    robe.add(grown(sculpt_leg(pose, pose.right_leg).shape(), 4.0), 34.0);
    robe.add(grown(sculpt_leg(pose, pose.left_leg).shape(), 3.0), 30.0);
    return robe;
}

std::vector<Fold> skirt_folds(const Clay& robe) {
    std::vector<Fold> folds;
    const glm::dvec2 axis(2, 0);
    // Pipes that fall from the belt along the standing leg, and between the legs.
    struct Pipe {
        double top, bottom, z_top, width, height;
    };
    for (const Pipe& p : {Pipe{62, 80, 300, 9, 6},
                          {45, 60, 330, 9, 6.5},
                          {33, 42, 345, 8, 6},
                          {22, 26, 330, 9, 7},
                          {12, 12, 350, 8, 6},
                          {2, -1, 320, 9, 6.5},
                          {-6, -14, 260, 8, 5.5},
                          {-62, -58, 250, 9, 5},
                          {-78, -76, 300, 10, 6},
                          {-95, -97, 320, 10, 6},
                          {82, 98, 320, 10, 6},
                          {100, 116, 330, 10, 6},
                          {-36, -34, 150, 8, 5},
                          {-45, -46, 140, 8, 4.5},
                          {-26, -24, 150, 7, 5}})
        folds.push_back({falling_path(robe, axis, p.top, p.z_top, p.bottom, ground + 3), 0.7 * p.width,
                         p.width, p.height, 0.45, 0.0});
    return folds;
}

} // namespace

Figure model_muse() {
    const BodyPose pose = muse_pose();
    Figure figure;
    figure.head = sculpt_head({Hair::parted, false, 0.88, 0.6});
    Clay head;
    head.add(pose.head.place(figure.head.shape()), 1.0);
    head.add(sculpt_neck(pose), 5.0);
    figure.head = head;
    Clay robe = bare_robe(pose);
    robe.emboss(fold_relief(robe, skirt_folds(robe)));
    figure.body.add(robe, 1.0);
    figure.body.add(sculpt_arm(pose, pose.right_arm), 4.0);
    figure.body.add(sculpt_arm(pose, pose.left_arm), 4.0);
    figure.body.add(placed_hand(pose, pose.right_arm, false), 3.0);
    figure.body.add(placed_hand(pose, pose.left_arm, true), 3.0);
    figure.body.add(placed_foot(pose, pose.right_leg, false), 2.0);
    figure.body.add(placed_foot(pose, pose.left_leg, true), 2.0);
    figure.plinth = round_plinth(98);
    figure.mid_neck = glm::mix(pose.chest.to_world({0, 0, 0.95}), pose.head.to_world({0, 0.1, -0.45}), 0.5);
    figure.neck_axis = {0, 0, 1};
    figure.fovea = {{pose.head.origin, 52.0}, 0.55};
    figure.box_mm = {{-120, -120, 0}, {120, 120, 640}};
    return figure;
}

} // namespace overt
