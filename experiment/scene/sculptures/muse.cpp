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
    pose.head = {{-4, -7, ground + 6.94 * head_mm}, posture(-20, 9, -5), head_mm};
    pose.right_leg = {pose.pelvis.to_world({-0.36, 0, 0}),
                      {-30, -36, ground + 2.02 * head_mm},
                      {-43, -9, ground + 0.30 * head_mm},
                      {-0.35, -1, 0}};
    pose.left_leg = {pose.pelvis.to_world({0.36, 0, 0}),
                     {28, -5, ground + 2.05 * head_mm},
                     {25, -7, ground + 0.29 * head_mm},
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

/// Points on her, from a height above the ground in heads.
double height(double heads) { return ground + heads * head_mm; }

/// The long robe, from the breast to the ground, without folds.
Clay bare_robe(const BodyPose& pose) {
    Clay robe;
    const auto axis = LoftAxis::straight({0, 2, ground + 1}, {2, 2, height(5.0)}, {0, -1, 0}, {1, 0, 0});
    robe.add(loft(axis,
                  {{0.0, 70, 54, 0, 4},
                   {0.05, 67, 52, 0, 4},
                   {0.2, 60, 46, 0, 4},
                   {0.4, 53, 39, 0, 2},
                   {0.62, 48, 33, 1, 0},
                   {0.76, 45, 31, 1, 0},
                   {0.9, 38, 28, 0, 0},
                   {1.0, 38, 28, 0, 0}},
                  0.1),
             1.0);
    robe.add(grown(sculpt_leg(pose, pose.right_leg).shape(), 4.0), 34.0);
    robe.add(grown(sculpt_leg(pose, pose.left_leg).shape(), 3.0), 30.0);
    Clay bodice;
    bodice.add(grown(sculpt_trunk(pose).shape(), 3.0), 1.0);
    Clay below_neckline;
    below_neckline.add(common(bodice.shape(), half_space({0, -36, height(5.56)}, {-0.05, -0.88, 0.47}), 3.0),
                       1.0);
    robe.add(below_neckline, 12.0);
    return robe;
}

/// From each shoulder over the breast to the belt, and the hollow between.
void add_bodice_folds(std::vector<Fold>& folds, const BodyPose& pose) {
    const auto chest = [&](double x, double y, double z) { return pose.chest.to_world({x, y, z}); };
    struct Line {
        double x_top, z_top, x_mid, z_mid, x_belt, width, height;
    };
    for (const double s : {-1.0, 1.0})
        for (const Line& l :
             {Line{0.56, 0.66, 0.50, 0.10, 0.40, 7.0, 3.8}, Line{0.47, 0.65, 0.33, 0.04, 0.27, 6.5, 3.4},
              Line{0.38, 0.60, 0.17, 0.00, 0.15, 6.5, 4.0}, Line{0.24, 0.32, 0.05, -0.05, 0.04, 5.0, 3.4}})
            folds.push_back(
                {hanging_path({chest(s * l.x_top, -0.28, l.z_top),
                               chest(s * 0.5 * (l.x_top + l.x_mid), -0.42, 0.5 * (l.z_top + l.z_mid) + 0.04),
                               chest(s * l.x_mid, -0.5, l.z_mid), chest(s * l.x_belt, -0.42, -0.42)}),
                 0.7 * l.width, l.width, l.height, 0.15, 0.1});
    // Swags between the breasts, under the neckline.
    for (const double z : {0.22, 0.10})
        folds.push_back({hanging_path({chest(-0.30, -0.42, z + 0.22), chest(-0.12, -0.46, z + 0.03),
                                       chest(0.0, -0.45, z - 0.03), chest(0.12, -0.46, z + 0.03),
                                       chest(0.30, -0.42, z + 0.22)}),
                         3.5, 3.5, 2.2, 0.2, 0.2});
    // The blouse over the belt.
    for (int i = -3; i <= 3; ++i)
        folds.push_back({hanging_path({chest(0.165 * i, -0.5, -0.47), chest(0.17 * i, -0.5, -0.70),
                                       chest(0.175 * i, -0.5, -0.92),
                                       chest(0.18 * i + 0.03 * (i % 2), -0.5, -1.12 - 0.06 * (i % 3))}),
                         4.2, 7.0, 3.8, 0.15, 0.55});
}

/// Pipes that fall to the ground.
void add_skirt_folds(std::vector<Fold>& folds, const Clay& robe) {
    struct Pipe {
        double top, z_top, bottom, width, height;
    };
    for (const Pipe& p : {Pipe{-112, 330, -118, 15, 8},
                          {-88, 330, -93, 14, 8.5},
                          {-68, 300, -72, 13, 8},
                          {-53, 190, -53, 11, 7},
                          {-38, 140, -36, 9, 6.5},
                          {-23, 160, -20, 10, 8},
                          {-8, 300, -5, 11.5, 9.5},
                          {8, 340, 12, 11.5, 10},
                          {24, 340, 30, 11, 9},
                          {40, 330, 48, 12, 10},
                          {57, 320, 66, 12, 9},
                          {75, 320, 85, 13, 9},
                          {95, 330, 106, 14, 8.5},
                          {115, 330, 126, 15, 8}})
        folds.push_back({falling_path(robe, {1, 2}, p.top, p.z_top, p.bottom, ground + 2), 0.75 * p.width,
                         p.width, p.height, 0.4, 0.0});
}

/// The cloak about the hips: a second layer over the robe from a roll downwards; its hem is cut when its
/// folds are drawn.
Clay bare_cloak(const Clay& robe) {
    Clay layer;
    layer.add(common(grown(robe.shape(), 6.0), half_space({0, -30, height(4.02)}, {-0.40, 0.16, 1.0}), 4.0),
              1.0);
    return layer;
}

/// A fan of pulls from the left hip over the right thigh, knee and shin.
std::vector<Fold> cloak_folds() {
    std::vector<Fold> folds;
    struct Pull {
        glm::dvec3 from, through, to;
        double width, height;
    };
    for (const Pull& p : {Pull{{50, -30, 392}, {5, -55, 338}, {-58, -14, 322}, 7, 5},
                          {{52, -28, 380}, {8, -55, 315}, {-60, -16, 296}, 7, 5},
                          {{54, -26, 368}, {10, -55, 290}, {-60, -18, 266}, 7.5, 5.5},
                          {{55, -26, 352}, {14, -55, 262}, {-58, -22, 232}, 8, 6},
                          {{55, -26, 335}, {18, -55, 236}, {-56, -26, 192}, 8, 6},
                          {{55, -26, 315}, {20, -55, 215}, {-44, -48, 152}, 8, 6.5},
                          {{57, -24, 300}, {28, -50, 205}, {-16, -54, 142}, 8, 6.5},
                          {{59, -22, 285}, {38, -46, 205}, {16, -54, 146}, 8, 6},
                          {{61, -20, 280}, {50, -36, 220}, {43, -42, 156}, 8, 6}})
        folds.push_back(
            {hanging_path({p.from, p.through, p.to}), 0.55 * p.width, p.width, p.height, 0.3, 0.2});
    return folds;
}

/// The end of the cloak that falls from the left forearm.
Clay falling_end() {
    Clay end;
    const auto axis =
        LoftAxis::straight({72, -30, height(4.55)}, {76, -26, height(1.6)}, {0, -1, 0}, {1, 0, 0});
    end.add(loft(axis, {{0, 14, 24}, {0.1, 13, 25}, {0.5, 13, 24}, {1, 17, 28}}, 0.2), 1.0);
    std::vector<Fold> folds;
    for (const auto& [angle, w] : {std::pair{-80.0, 6.0},
                                   {-42.0, 6.0},
                                   {-8.0, 6.5},
                                   {24.0, 6.0},
                                   {58.0, 7.0},
                                   {90.0, 8.0},
                                   {122.0, 8.0}})
        folds.push_back({falling_path(end, {74, -28}, angle, height(4.35), angle * 1.05, height(1.62)),
                         0.7 * w, w, 5.5, 0.2, 0.0});
    end.emboss(fold_relief(end, folds));
    end.carve(half_space({76, -26, height(1.78)}, {0.1, -0.55, 1.0}), 3.0);
    return end;
}

Clay sculpt_garments(const BodyPose& pose) {
    Clay robe = bare_robe(pose);
    Clay cloak = bare_cloak(robe);
    std::vector<Fold> folds;
    add_bodice_folds(folds, pose);
    add_skirt_folds(folds, robe);
    robe.emboss(fold_relief(robe, folds));
    cloak.emboss(fold_relief(cloak, cloak_folds()));
    cloak.carve(half_space({0, -40, height(1.55)}, {0.42, 0.12, 1.0}), 4.0);
    robe.add(cloak, 4.0);
    // The belt, and the roll that the cloak's upper edge makes.
    for (const double side : {-1.0, 1.0})
        robe.add(cord(pose.chest.to_world({0, -0.46, -0.44}),
                      pose.chest.to_world({side * 0.50, -0.46, -0.44}),
                      pose.chest.to_world({side * 0.56, 0.05, -0.43}), glm::dvec3(2.6)),
                 2.0);
    robe.add(twisted_roll(hanging_path({{-40, 40, 318},
                                        {-60, 6, 320},
                                        {-48, -32, 328},
                                        {-14, -46, 346},
                                        {24, -45, 372},
                                        {52, -38, 392},
                                        {70, -22, 396}}),
                          11.0, 3, 1.6),
             4.0);
    robe.add(falling_end(), 5.0);
    robe.add(bar(pose.left_arm.elbow, glm::mix(pose.left_arm.elbow, pose.left_arm.wrist, 0.72), 17.0, 16.0),
             7.0);
    return robe;
}

} // namespace

Figure model_muse() {
    const BodyPose pose = muse_pose();
    Figure figure;
    figure.head.add(pose.head.place(sculpt_head({Hair::parted, false, 0.85, 0.6}).shape()), 1.0);
    figure.head.add(sculpt_neck(pose), 5.0);
    figure.body.add(sculpt_torso(pose), 1.0);
    figure.body.add(sculpt_arm(pose, pose.right_arm), 6.0);
    figure.body.add(sculpt_arm(pose, pose.left_arm), 6.0);
    figure.body.add(sculpt_garments(pose), 5.0);
    figure.body.add(placed_hand(pose, pose.right_arm, false), 3.0);
    figure.body.add(placed_hand(pose, pose.left_arm, true), 3.0);
    figure.body.add(placed_foot(pose, pose.right_leg, false), 2.0);
    figure.body.add(placed_foot(pose, pose.left_leg, true), 2.0);
    figure.plinth = round_plinth(98);
    figure.mid_neck = glm::mix(pose.chest.to_world({0, 0, 0.95}), pose.head.to_world({0, 0.1, -0.45}), 0.5);
    figure.cell_factor = 0.85;
    figure.fovea = {{pose.head.origin, 52.0}, 0.55};
    figure.box_mm = {{-120, -120, 0}, {120, 120, 640}};
    return figure;
}

} // namespace overt
