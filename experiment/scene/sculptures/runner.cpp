#include "experiment/scene/sculptures/drapery.h"
#include "experiment/scene/sculptures/figure_anatomy.h"
#include "experiment/scene/sculptures/figures.h"
#include "experiment/scene/sculptures/loft.h"
#include "experiment/scene/sculptures/pedestals.h"

namespace overt {

namespace {

constexpr double head_mm = 81.0;
constexpr double ground = plinth_height_mm;
constexpr double rock_top = ground + 128.0;

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

} // namespace

Figure model_runner() {
    const BodyPose pose = runner_pose();
    Figure figure;
    figure.head.add(pose.head.place(sculpt_head({Hair::curls, false, 1.0, 1.0}).shape()), 1.0);
    figure.head.add(sculpt_neck(pose), 5.0);
    Clay skin;
    skin.add(sculpt_torso(pose), 1.0);
    skin.add(sculpt_leg(pose, pose.left_leg), 14.0);
    skin.add(sculpt_leg(pose, pose.right_leg), 14.0);
    skin.add(sculpt_arm(pose, pose.left_arm), 8.0);
    skin.add(sculpt_arm(pose, pose.right_arm), 8.0);
    figure.body.add(skin, 1.0);
    figure.body.add(placed_hand(pose, pose.right_arm, false), 3.0);
    figure.body.add(placed_hand(pose, pose.left_arm, true), 3.0);
    figure.body.add(placed_foot(pose, pose.right_leg, false), 4.0);
    figure.body.add(placed_foot(pose, pose.left_leg, true), 4.0);
    figure.plinth = square_plinth({165, 88});
    figure.plinth.add(rock({-100, 8, ground}, {50, 46, 0.5 * (rock_top - ground) + 3.0}), 3.0);
    figure.mid_neck = glm::mix(pose.chest.to_world({0, 0, 0.95}), pose.head.to_world({0, 0.1, -0.45}), 0.5);
    figure.neck_axis = pose.head.origin - pose.chest.to_world({0, 0, 0.9});
    figure.fovea = {{pose.head.origin, 58.0}, 0.55};
    figure.box_mm = {{-190, -120, 0}, {190, 120, 640}};
    return figure;
}

} // namespace overt
