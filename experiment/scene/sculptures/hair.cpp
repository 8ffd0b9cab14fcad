#include <cmath>
#include <numbers>

#include "experiment/scene/sculptures/head.h"

namespace overt {

namespace {

constexpr double pi = std::numbers::pi;

/// The surface that locks lie on.
struct Scalp {
    glm::dvec3 centre{0, 0.055, 0.12};
    glm::dvec3 half_axes{0.315, 0.42, 0.36};

    glm::dvec3 at(const glm::dvec3& direction, double height = 0.0) const {
        const glm::dvec3 d = glm::normalize(direction);
        return centre + d * ((1.0 + height) / glm::length(d / half_axes));
    }
};

/// The opening of the hair for the face.
void carve_face(Clay& hair, double hairline) {
    hair.carve(ellipsoid({0, -0.44, hairline - 0.40}, {0.275, 0.30, 0.40}), 0.04);
    hair.carve(ellipsoid({0, -0.20, -0.50}, {0.50, 0.36, 0.42}), 0.04);
}

/// Ridge with a round crest and a narrow valley, 0 to 1, once per unit of `phase`.
double strand(double phase) {
    const double s = std::sin(pi * phase);
    return std::sqrt(s * s + 0.02) - 0.14;
}

/// Hair that runs in waves from a parting over the forehead to a knot behind, as great circles run from pole
/// to pole.
void add_parted_hair(Clay& head) {
    Clay hair;
    const Scalp scalp;
    hair.add(ellipsoid(scalp.centre, scalp.half_axes), 0.05);
    hair.add(ellipsoid({0, -0.04, 0.16}, {0.328, 0.335, 0.295}), 0.08);
    carve_face(hair, 0.27);
    const glm::dvec3 front(0, -0.30, 0.50);
    const glm::dvec3 knot(0, 0.50, -0.02);
    const glm::dvec3 axis = glm::normalize(knot - front);
    const glm::dmat3 axes = frame_of(axis, {0, 0, 1});
    const double length = glm::distance(front, knot);
    hair.emboss({[=](const glm::dvec3& point, double) {
                     const glm::dvec3 local = (point - front) * axes;
                     const double share = local.z / length;
                     const double angle = std::atan2(local.x, local.y) / pi;
                     const double wave = 0.35 * std::sin(2.0 * pi * 3.2 * share) * (angle < 0 ? -1.0 : 1.0);
                     const double parting = 1.0 - std::exp(-angle * angle / 0.0012);
                     const double ends =
                         smooth_step((share - 0.01) / 0.15) * smooth_step((1.02 - share) / 0.2);
                     return 0.022 * ends * parting * strand(angle * 12.0 + wave * parting);
                 },
                 {scalp.centre, 0.6}});
    Clay bun;
    bun.add(ellipsoid(knot, {0.15, 0.13, 0.14}, axes), 0.02);
    bun.emboss({[=](const glm::dvec3& point, double) {
                    const glm::dvec3 local = (point - knot) * axes;
                    const double radius = std::hypot(local.x, local.y);
                    const double turn = std::atan2(local.x, local.y) / (2.0 * pi);
                    return 0.018 * smooth_step(radius / 0.06) * strand(turn * 5.0 + radius * 9.0);
                },
                {knot, 0.25}});
    hair.add(bun, 0.04);
    head.add(hair, 0.02);
}

/// Comma-shaped locks in a spiral from the crown to the hairline.
void add_locks(Clay& hair, int count, double length, double thickness, double drop) {
    const Scalp scalp;
    for (int i = 0; i < count; ++i) {
        const double z = 1.0 - 1.75 * (i + 0.5) / count;
        const double turn = 2.39996323 * i;
        const double ring = std::sqrt(1.0 - z * z);
        // The pole of the spiral is the crown, a little behind the top.
        const glm::dvec3 crown =
            frame_of({0, 0.35, 1.0}, {0, 1, 0}) * glm::dvec3(ring * std::cos(turn), ring * std::sin(turn), z);
        const glm::dvec3 root = scalp.at(crown, 0.02);
        const glm::dvec3 from_face = root - glm::dvec3(0, -0.36, -0.10);
        if (glm::length(from_face / glm::dvec3(0.27, 0.30, 0.37)) < 1.0 || root.z < -0.26 ||
            (root.z < -0.02 && root.y < 0.10))
            continue;
        const glm::dvec3 down =
            glm::normalize(glm::dvec3(0, -0.25, -1.0) - crown * glm::dot(glm::dvec3(0, -0.25, -1.0), crown));
        const double side = (i % 2 == 0 ? 1.0 : -1.0) * (root.x < 0 ? -1.0 : 1.0);
        const glm::dvec3 across = glm::cross(crown, down) * side;
        const glm::dvec3 bend = root + length * (0.55 * down + 0.45 * across) + 0.045 * crown;
        const glm::dvec3 tip = scalp.at(root + length * (drop * down - 0.25 * across) - scalp.centre, 0.01);
        hair.add(cord(root, bend, tip, {0.6 * thickness, 1.25 * thickness, 0.35 * thickness}), 0.02);
        hair.add(cord(root + 0.4 * thickness * across, bend + 0.9 * thickness * across + 0.01 * crown,
                      tip + 0.9 * thickness * across, {0.4 * thickness, 0.8 * thickness, 0.25 * thickness}),
                 0.010);
    }
}

} // namespace

void add_hair(Clay& head, Hair hair) {
    if (hair == Hair::parted) {
        add_parted_hair(head);
        return;
    }
    Clay mass;
    mass.add(ellipsoid(Scalp{}.centre, Scalp{}.half_axes * 1.01), 0.05);
    carve_face(mass, hair == Hair::curls ? 0.25 : 0.28);
    if (hair == Hair::curls)
        add_locks(mass, 190, 0.12, 0.036, 0.6);
    else
        add_locks(mass, 150, 0.20, 0.033, 0.95);
    head.add(mass, 0.02);
}

void add_beard(Clay& head) {
    Clay beard;
    beard.add(ellipsoid({0, -0.235, -0.43}, {0.19, 0.15, 0.17}), 0.05);
    for (const double s : {-1.0, 1.0}) {
        beard.add(bar({s * 0.255, -0.06, -0.14}, {s * 0.185, -0.19, -0.36}, 0.035, 0.085), 0.10);
        beard.add(cord({s * 0.008, -0.402, -0.236}, {s * 0.085, -0.432, -0.245}, {s * 0.160, -0.335, -0.375},
                       {0.018, 0.030, 0.010}),
                  0.012);
        beard.add(cord({s * 0.012, -0.398, -0.222}, {s * 0.085, -0.418, -0.222}, {s * 0.185, -0.310, -0.330},
                       {0.012, 0.026, 0.008}),
                  0.012);
    }
    // Locks in rows from the cheeks and the chin downwards, each curling outwards at its tip.
    for (int row = 0; row < 5; ++row) {
        const int locks = 13 - 2 * row;
        for (int i = 0; i < locks; ++i) {
            const double u = 2.0 * i / (locks - 1) - 1.0;
            const double angle = u * (1.45 - 0.12 * row);
            const double out_x = 0.25 - 0.022 * row;
            const double out_y = 0.235 - 0.012 * row;
            const glm::dvec3 root(out_x * std::sin(angle), -0.145 - out_y * std::cos(angle),
                                  -0.335 - 0.070 * row + (0.20 - 0.03 * row) * u * u);
            const double side = u < -0.01 ? -1.0 : u > 0.01 ? 1.0 : (row % 2 == 0 ? 1.0 : -1.0);
            const glm::dvec3 out(std::sin(angle), -std::cos(angle), 0);
            const glm::dvec3 across(side * std::cos(angle), side * std::sin(angle), 0);
            const double length = 0.115 + 0.02 * std::sin(2.3 * i + row);
            const glm::dvec3 bend = root + 0.030 * out + glm::dvec3(0, 0, -0.9 * length) - 0.045 * across;
            const glm::dvec3 tip = root + 0.004 * out + glm::dvec3(0, 0, -length) + 0.050 * across;
            beard.add(cord(root, bend, tip, {0.024, 0.036, 0.010}), 0.012);
        }
    }
    head.add(beard, 0.02);
}

} // namespace overt
