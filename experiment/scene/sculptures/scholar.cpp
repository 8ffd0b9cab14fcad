#include "experiment/scene/sculptures/drapery.h"
#include "experiment/scene/sculptures/figure_anatomy.h"
#include "experiment/scene/sculptures/figures.h"
#include "experiment/scene/sculptures/loft.h"
#include "experiment/scene/sculptures/pedestals.h"

namespace overt {

namespace {

constexpr double head_mm = 72.0;
constexpr double ground = plinth_height_mm;

/// Weight on the right leg, the left knee forward; a scroll in the right hand, the left hand on the hip under
/// the cloak.
BodyPose scholar_pose() {
    BodyPose pose;
    pose.pelvis = {{-5, 2, ground + 3.86 * head_mm}, posture(5, 0, 6), head_mm};
    pose.chest = {{0, 2, ground + 5.40 * head_mm}, posture(-4, 0, -5), head_mm};
    pose.head = {{5, -10, ground + 6.98 * head_mm}, posture(20, 10, 4), head_mm};
    pose.right_leg = {pose.pelvis.to_world({-0.37, 0, 0}),
                      {-32, -4, ground + 2.07 * head_mm},
                      {-30, 4, ground + 0.29 * head_mm},
                      {-0.35, -1, 0}};
    pose.left_leg = {pose.pelvis.to_world({0.37, 0, 0}),
                     {28, -32, ground + 2.04 * head_mm},
                     {40, 4, ground + 0.30 * head_mm},
                     {0.45, -1, 0}};
    pose.right_arm = {pose.chest.to_world({-0.80, 0.04, 0.56}),
                      {-88, 12, ground + 4.68 * head_mm},
                      {-58, -62, ground + 4.75 * head_mm},
                      {0.35, -0.85, 0.25},
                      {0.9, 0.3, 0.1},
                      {{62, 64, 66, 68}, 25}};
    pose.left_arm = {pose.chest.to_world({0.80, 0.04, 0.56}),
                     {92, 16, ground + 4.70 * head_mm},
                     {48, -36, ground + 4.42 * head_mm},
                     {-0.8, -0.45, -0.1},
                     {0.1, 1, 0},
                     {{30, 34, 38, 42}, 30}};
    return pose;
}

Clay bare_cloak(const BodyPose& pose) {
    Clay cloak;
    const auto axis =
        LoftAxis::straight({0, 4, ground + 30}, {0, 2, ground + 4.75 * head_mm}, {0, -1, 0}, {1, 0, 0});
    cloak.add(loft(axis,
                   {{0.0, 60, 44, 0, 3},
                    {0.2, 58, 43, 0, 3},
                    {0.45, 56, 41, 0, 2},
                    {0.7, 54, 38, 1, 0},
                    {0.9, 51, 36, 0, 0},
                    {1.0, 50, 34, 0, 0}},
                   0.15),
              1.0);
    cloak.add(grown(sculpt_leg(pose, pose.right_leg).shape(), 5.0), 32.0);
    cloak.add(grown(sculpt_leg(pose, pose.left_leg).shape(), 6.0), 32.0);
    return cloak;
}

} // namespace

Figure model_scholar() {
    const BodyPose pose = scholar_pose();
    Figure figure;
    figure.head.add(pose.head.place(sculpt_head({Hair::waves, true, 1.0, 1.1}).shape()), 1.0);
    figure.head.add(sculpt_neck(pose), 5.0);
    Clay skin;
    skin.add(sculpt_torso(pose), 1.0);
    skin.add(sculpt_leg(pose, pose.left_leg), 14.0);
    skin.add(sculpt_leg(pose, pose.right_leg), 14.0);
    skin.add(sculpt_arm(pose, pose.left_arm), 8.0);
    skin.add(sculpt_arm(pose, pose.right_arm), 8.0);
    figure.body.add(skin, 1.0);
    figure.body.add(bare_cloak(pose), 2.0);
    figure.body.add(placed_hand(pose, pose.right_arm, false), 3.0);
    figure.body.add(placed_hand(pose, pose.left_arm, true), 3.0);
    figure.body.add(placed_foot(pose, pose.right_leg, false), 4.0);
    figure.body.add(placed_foot(pose, pose.left_leg, true), 4.0);
    figure.plinth = square_plinth({104, 90});
    figure.mid_neck = glm::mix(pose.chest.to_world({0, 0, 0.95}), pose.head.to_world({0, 0.1, -0.45}), 0.5);
    figure.fovea = {{pose.head.origin, 52.0}, 0.55};
    figure.box_mm = {{-130, -130, 0}, {130, 130, 640}};
    return figure;
}

} // namespace overt
