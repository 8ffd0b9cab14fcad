#include "experiment/scene/sculptures/head.h"

#include "experiment/scene/sculptures/loft.h"

namespace overt {

namespace {

void add_skull_and_jaw(Clay& head, double jaw) {
    head.add(ellipsoid({0, 0.05, 0.12}, {0.295, 0.40, 0.335}), 0.05);
    head.add(ellipsoid({0, -0.10, 0.13}, {0.262, 0.262, 0.235}), 0.12);
    const auto face = LoftAxis::straight({0, -0.14, 0.06}, {0, -0.14, -0.465}, {0, -1, 0}, {1, 0, 0});
    head.add(loft(face,
                  {{0.0, 0.270, 0.222, 0, 0},
                   {0.25, 0.262, 0.222, 0, 0},
                   {0.5, 0.238 * jaw, 0.212, 0, 0.003},
                   {0.75, 0.200 * jaw, 0.190, 0, 0.025},
                   {0.9, 0.155 * jaw, 0.150, 0, 0.065},
                   {1.0, 0.100 * jaw, 0.105, 0, 0.100}},
                  0.5),
             0.10);
    head.add(ellipsoid({0, -0.322, -0.43}, {0.07 * jaw, 0.062, 0.055}), 0.09);
    for (const double s : {-1.0, 1.0}) {
        head.add(ellipsoid({s * 0.185, -0.255, -0.075}, {0.075, 0.08, 0.05}), 0.11);
        head.add(ellipsoid({s * 0.12, -0.285, -0.20}, {0.09, 0.07, 0.11}), 0.10);
        head.add(bar({s * 0.205 * jaw, -0.035, -0.235}, {s * 0.075 * jaw, -0.285, -0.415}, 0.055, 0.055),
                 0.12);
        head.add(ellipsoid({s * 0.165 * jaw, -0.20, -0.26}, {0.07, 0.10, 0.10}), 0.12);
    }
}

void add_nose(Clay& head) {
    head.add(bar({0, -0.352, 0.07}, {0, -0.438, -0.15}, 0.030, 0.033), 0.055);
    head.add(ellipsoid({0, -0.450, -0.168}, {0.036, 0.036, 0.032}), 0.035);
    for (const double s : {-1.0, 1.0}) {
        head.add(ellipsoid({s * 0.042, -0.398, -0.178}, {0.024, 0.036, 0.026}), 0.03);
        head.carve(ellipsoid({s * 0.020, -0.418, -0.207}, {0.010, 0.018, 0.012}), 0.015);
    }
}

void add_eyes(Clay& head, double brow) {
    for (const double s : {-1.0, 1.0}) {
        head.carve(ellipsoid({s * 0.130, -0.408, 0.004}, {0.084, 0.072, 0.056}), 0.075);
        head.carve(ellipsoid({s * 0.066, -0.395, 0.005}, {0.026, 0.045, 0.036}), 0.05);
        head.add(cord({s * 0.045, -0.372, 0.060}, {s * 0.13, -0.390 - 0.012 * brow, 0.112},
                      {s * 0.228, -0.280, 0.045}, glm::dvec3(0.014, 0.018, 0.010) * brow),
                 0.045);
        head.add(sphere({s * 0.128, -0.272, 0.0}, 0.072), 0.010);
        // Lids: the upper one thicker, and over the lower one at the outer corner.
        head.add(cord({s * 0.062, -0.330, -0.016}, {s * 0.120, -0.386, 0.088}, {s * 0.202, -0.290, -0.012},
                      {0.008, 0.015, 0.008}),
                 0.016);
        head.add(cord({s * 0.064, -0.330, -0.020}, {s * 0.130, -0.366, -0.080}, {s * 0.196, -0.294, -0.020},
                      {0.006, 0.011, 0.006}),
                 0.022);
    }
}

void add_mouth(Clay& head) {
    head.add(ellipsoid({0, -0.305, -0.275}, {0.125, 0.072, 0.085}), 0.09);
    for (const double s : {-1.0, 1.0}) {
        head.add(cord({s * 0.098, -0.345, -0.288}, {s * 0.050, -0.398, -0.252}, {0.0, -0.388, -0.270},
                      {0.006, 0.018, 0.016}),
                 0.025);
        head.carve(sphere({s * 0.108, -0.368, -0.290}, 0.016), 0.045);
    }
    head.add(
        cord({-0.082, -0.350, -0.298}, {0, -0.418, -0.332}, {0.082, -0.350, -0.298}, {0.007, 0.030, 0.007}),
        0.025);
    head.carve(
        cord({-0.100, -0.356, -0.289}, {0, -0.446, -0.289}, {0.100, -0.356, -0.289}, {0.003, 0.007, 0.003}),
        0.018);
    head.carve(cord({0, -0.418, -0.215}, {0, -0.412, -0.235}, {0, -0.418, -0.258}, {0.010, 0.013, 0.010}),
               0.03);
}

void add_ears(Clay& head) {
    for (const double s : {-1.0, 1.0}) {
        const glm::dmat3 axes = frame_of({s * 0.12, 0.18, 1.0}, {s * 0.45, 1.0, -0.15});
        head.add(ellipsoid({s * 0.292, 0.035, -0.055}, {0.030, 0.070, 0.108}, axes), 0.025);
        head.carve(ellipsoid({s * 0.328, 0.022, -0.045}, {0.022, 0.036, 0.060}, axes), 0.025);
        head.add(cord({s * 0.300, -0.020, -0.035}, {s * 0.338, 0.045, 0.105}, {s * 0.330, 0.105, -0.035},
                      {0.010, 0.015, 0.014}),
                 0.018);
        head.add(ellipsoid({s * 0.296, 0.005, -0.135}, {0.016, 0.026, 0.032}), 0.025);
    }
}

} // namespace

Clay sculpt_head(const HeadDescription& description) {
    Clay head;
    add_skull_and_jaw(head, description.jaw);
    add_nose(head);
    add_eyes(head, description.brow);
    add_mouth(head);
    add_ears(head);
    if (description.beard)
        add_beard(head);
    add_hair(head, description.hair);
    return head;
}

} // namespace overt
