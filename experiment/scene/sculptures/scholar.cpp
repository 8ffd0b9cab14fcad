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

/// A height above the ground, in heads.
double height(double heads) { return ground + heads * head_mm; }

/// The cloak about hips and legs, without folds.
Clay bare_skirt(const BodyPose& pose) {
    Clay skirt;
    const auto axis = LoftAxis::straight({0, 4, ground + 10}, {0, 2, height(4.72)}, {0, -1, 0}, {1, 0, 0});
    skirt.add(loft(axis,
                   {{0.0, 62, 46, 0, 3},
                    {0.2, 59, 43, 0, 3},
                    {0.45, 57, 41, 0, 2},
                    {0.7, 54, 38, 1, 0},
                    {0.9, 50, 36, 0, 0},
                    {1.0, 48, 34, 0, 0}},
                   0.15),
              1.0);
    skirt.add(grown(sculpt_leg(pose, pose.right_leg).shape(), 5.0), 32.0);
    skirt.add(grown(sculpt_leg(pose, pose.left_leg).shape(), 5.0), 32.0);
    return skirt;
}

/// The layer over it: from the roll about the waist to a hem that slants from the left knee to the right
/// shin.
Clay bare_layer(const Clay& skirt) {
    Clay layer;
    layer.add(common(grown(skirt.shape(), 6.5), half_space({0, -30, height(4.42)}, {-0.25, 0.1, 1.0}), 4.0),
              1.0);
    return layer;
}

/// The cloak over the left shoulder and about the bent left arm.
Clay bare_mantle(const BodyPose& pose) {
    Clay mantle;
    Clay arm;
    arm.add(grown(sculpt_arm(pose, pose.left_arm).shape(), 7.0), 1.0);
    arm.add(bar(pose.left_arm.wrist, pose.left_arm.wrist + 26.0 * glm::normalize(pose.left_arm.fingers), 17.0,
                19.0),
            12.0);
    mantle.add(arm, 1.0);
    // What hangs between arm and side, and lies over chest and shoulder.
    mantle.add(bar(pose.left_arm.shoulder + glm::dvec3(-10, 2, -30), {60, 0, height(4.55)}, 24.0, 26.0),
               26.0);
    Clay chest;
    chest.add(common(grown(sculpt_trunk(pose).shape(), 6.0),
                     half_space(pose.chest.to_world({0.36, -0.3, 0.5}), {-0.86, -0.15, 0.42}), 5.0),
              1.0);
    mantle.add(chest, 22.0);
    mantle.add(ellipsoid(pose.left_arm.shoulder + glm::dvec3(-10, 2, 2), {29, 26, 17}), 24.0);
    // The end that falls from the elbow.
    const auto fall =
        LoftAxis::straight(pose.left_arm.elbow + glm::dvec3(-8, 0, 10),
                           pose.left_arm.elbow + glm::dvec3(-14, 0, -205), {0, -1, 0}, {1, 0, 0});
    mantle.add(loft(fall, {{0, 20, 22}, {0.3, 17, 25}, {0.7, 17, 27}, {1, 20, 30}}, 0.15), 18.0);
    return mantle;
}

std::vector<Fold> mantle_folds(const Clay& mantle, const BodyPose& pose) {
    const ArmPose& arm = pose.left_arm;
    std::vector<Fold> folds;
    // From the shoulder down the chest's edge, and over the upper arm.
    for (int i = 0; i < 5; ++i) {
        const double s = i / 4.0;
        folds.push_back({hanging_path({arm.shoulder + glm::dvec3(-36 + 34 * s, 24, 26 - 4 * s),
                                       arm.shoulder + glm::dvec3(-32 + 28 * s, -14 - 10 * s, 14 - 6 * s),
                                       pose.chest.to_world({0.42 + 0.22 * s, -0.62, 0.12}),
                                       pose.chest.to_world({0.46 + 0.26 * s, -0.66, -0.50}),
                                       {44 + 16 * s, -40, height(4.50)}}),
                         5.0, 6.0, 5.0, 0.3, 0.35});
    }
    // About the arm, drawn together at the elbow.
    for (int i = 0; i < 4; ++i) {
        const double s = i / 3.0;
        const glm::dvec3 a = glm::mix(arm.shoulder, arm.elbow, 0.25 + 0.45 * s);
        folds.push_back({hanging_path({a + glm::dvec3(26, 0, 12), a + glm::dvec3(8, -28, -4),
                                       a + glm::dvec3(-18, -24, -30 + 10 * s)}),
                         5.0, 6.0, 4.5, 0.3, 0.3});
        const glm::dvec3 b = glm::mix(arm.elbow, arm.wrist, 0.15 + 0.22 * i);
        folds.push_back({hanging_path({b + glm::dvec3(6, -6, 24), b + glm::dvec3(10, -24, 4),
                                       b + glm::dvec3(0, -16, -24)}),
                         4.0, 5.0, 4.0, 0.3, 0.3});
    }
    for (const auto& [angle, w] : {std::pair{-96.0, 6.5},
                                   {-60.0, 6.0},
                                   {-28.0, 6.5},
                                   {2.0, 6.0},
                                   {32.0, 6.5},
                                   {62.0, 7.5},
                                   {94.0, 7.5},
                                   {126.0, 8.0}})
        folds.push_back({falling_path(mantle, {arm.elbow.x - 11, arm.elbow.y}, 0.9 * angle, arm.elbow.z - 12,
                                      angle, arm.elbow.z - 202),
                         0.6 * w, w, 5.5, 0.3, 0.0});
    return folds;
}

/// A fan of pulls from the right hip to the left knee and shin.
std::vector<Fold> layer_folds() {
    std::vector<Fold> folds;
    struct Pull {
        glm::dvec3 from, through, to;
        double width, height;
    };
    for (const Pull& p : {Pull{{-54, -22, 352}, {-5, -58, 322}, {52, -30, 332}, 7, 5},
                          {{-55, -22, 338}, {-4, -58, 298}, {54, -30, 300}, 7.5, 5.5},
                          {{-56, -22, 322}, {-6, -58, 272}, {52, -34, 262}, 7.5, 6},
                          {{-57, -22, 306}, {-10, -58, 248}, {40, -48, 222}, 8, 6},
                          {{-58, -20, 290}, {-16, -56, 226}, {16, -58, 184}, 8, 6.5},
                          {{-58, -20, 272}, {-24, -54, 206}, {-4, -58, 158}, 8, 6.5},
                          {{-60, -18, 252}, {-36, -48, 190}, {-24, -52, 138}, 8, 6.5},
                          {{-62, -14, 230}, {-48, -40, 175}, {-42, -44, 124}, 8, 6},
                          {{-66, 0, 240}, {-62, -22, 170}, {-60, -26, 114}, 8, 5.5}})
        folds.push_back(
            {hanging_path({p.from, p.through, p.to}), 0.55 * p.width, p.width, p.height, 0.3, 0.2});
    return folds;
}

std::vector<Fold> skirt_folds(const Clay& skirt) {
    std::vector<Fold> folds;
    struct Pipe {
        double top, z_top, bottom, width, height;
    };
    for (const Pipe& p : {Pipe{-102, 260, -106, 14, 7},
                          {-78, 220, -80, 13, 7.5},
                          {-56, 210, -58, 12, 7.5},
                          {-36, 200, -38, 11, 8},
                          {-17, 210, -18, 11, 8},
                          {2, 210, 3, 11, 7.5},
                          {20, 170, 23, 10, 6},
                          {40, 170, 45, 11, 6},
                          {62, 210, 68, 13, 7},
                          {88, 250, 94, 14, 7.5}})
        folds.push_back({falling_path(skirt, {0, 3}, p.top, p.z_top, p.bottom, ground + 16), 0.75 * p.width,
                         p.width, p.height, 0.4, 0.0});
    return folds;
}

Clay sculpt_cloak(const BodyPose& pose) {
    Clay cloak = bare_skirt(pose);
    Clay layer = bare_layer(cloak);
    Clay mantle = bare_mantle(pose);
    layer.emboss(fold_relief(layer, layer_folds()));
    layer.carve(half_space({0, -40, height(1.62)}, {-0.55, 0.1, 1.0}), 4.0);
    cloak.emboss(fold_relief(cloak, skirt_folds(cloak)));
    cloak.carve(half_space({0, -40, ground + 34}, {0.10, 0.0, 1.0}), 4.0);
    mantle.emboss(fold_relief(mantle, mantle_folds(mantle, pose)));
    mantle.carve(half_space(pose.left_arm.elbow + glm::dvec3(-10, 0, -186), {-0.5, -0.35, 1.0}), 3.0);
    cloak.add(layer, 4.0);
    cloak.add(mantle, 8.0);
    cloak.add(twisted_roll(hanging_path({{-46, 36, 366},
                                         {-60, 4, 362},
                                         {-46, -30, 362},
                                         {-14, -44, 370},
                                         {20, -46, 384},
                                         {46, -40, 404},
                                         {62, -18, 430}}),
                           12.0, 3, 1.4),
              5.0);
    return cloak;
}

/// The scroll in the right hand.
Shape sculpt_scroll(const ArmPose& arm) {
    const glm::dvec3 fist =
        arm.wrist + 0.36 * head_mm * glm::normalize(arm.fingers) + 7.0 * glm::normalize(arm.palm);
    const glm::dvec3 across = glm::normalize(glm::cross(arm.fingers, arm.palm));
    return bar(fist - 34.0 * across, fist + 34.0 * across, 6.5, 6.5);
}

} // namespace

Figure model_scholar() {
    const BodyPose pose = scholar_pose();
    Figure figure;
    figure.head.add(pose.head.place(sculpt_head({Hair::waves, true, 1.0, 1.1}).shape()), 1.0);
    figure.head.add(sculpt_neck(pose), 5.0);
    figure.body.add(sculpt_torso(pose), 1.0);
    figure.body.add(sculpt_leg(pose, pose.left_leg), 20.0);
    figure.body.add(sculpt_leg(pose, pose.right_leg), 20.0);
    figure.body.add(sculpt_arm(pose, pose.right_arm), 14.0);
    figure.body.add(sculpt_cloak(pose), 7.0);
    figure.body.add(placed_hand(pose, pose.right_arm, false), 5.0);
    figure.body.add(sculpt_scroll(pose.right_arm), 1.5);
    figure.body.add(placed_foot(pose, pose.right_leg, false), 5.0);
    figure.body.add(placed_foot(pose, pose.left_leg, true), 5.0);
    figure.plinth = square_plinth({104, 88});
    figure.plinth_blend_mm = 4.0;
    figure.mid_neck = glm::mix(pose.chest.to_world({0, 0, 0.95}), pose.head.to_world({0, 0.1, -0.45}), 0.5);
    figure.cell_factor = 0.90;
    figure.fovea = {{pose.head.origin, 52.0}, 0.55};
    figure.box_mm = {{-130, -130, 0}, {130, 130, 640}};
    return figure;
}

} // namespace overt
