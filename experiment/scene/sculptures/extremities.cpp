#include "experiment/scene/sculptures/extremities.h"

#include "experiment/scene/sculptures/loft.h"

namespace overt {

namespace {

double radians_of(double degrees) { return glm::radians(degrees); }

/// Three bars, each bent further towards the palm.
void add_finger(Clay& hand, const glm::dvec3& knuckle, double spread_deg, double curl_deg, double length,
                double thickness) {
    glm::dvec3 joint = knuckle;
    double radius = thickness;
    double bend = 0.6 * radians_of(curl_deg);
    const glm::dvec3 out(std::sin(radians_of(spread_deg)), 0.0, std::cos(radians_of(spread_deg)));
    for (const double share : {0.45, 0.31, 0.24}) {
        const glm::dvec3 direction = std::cos(bend) * out - std::sin(bend) * glm::dvec3(0, 1, 0);
        const glm::dvec3 next = joint + share * length * direction;
        hand.add(bar(joint, next, radius, radius * 0.88), 0.022);
        joint = next;
        radius *= 0.88;
        bend += radians_of(curl_deg);
    }
}

} // namespace

Clay sculpt_hand(const HandShape& shape) {
    Clay hand;
    const auto palm = LoftAxis::straight({0, 0, -0.08}, {0, 0, 0.50}, {0, -1, 0}, {1, 0, 0});
    hand.add(loft(palm,
                  {{0.0, 0.125, 0.095, 0, 0},
                   {0.2, 0.135, 0.088, 0, 0},
                   {0.55, 0.185, 0.085, 0, 0},
                   {0.85, 0.205, 0.075, 0, 0},
                   {1.0, 0.19, 0.062, 0, 0}},
                  0.8),
             0.03);
    // Balls of the thumb and of the little finger.
    hand.add(ellipsoid({0.10, -0.065, 0.19}, {0.085, 0.065, 0.15}), 0.06);
    hand.add(ellipsoid({-0.11, -0.050, 0.20}, {0.065, 0.055, 0.17}), 0.06);
    constexpr std::array<double, 4> places{0.148, 0.050, -0.050, -0.143};
    constexpr std::array<double, 4> heights{0.50, 0.525, 0.505, 0.46};
    constexpr std::array<double, 4> lengths{0.42, 0.475, 0.43, 0.34};
    constexpr std::array<double, 4> spreads{4, 0, -4, -9};
    for (std::size_t i = 0; i < 4; ++i)
        add_finger(hand, {places[i], 0.008, heights[i] - 0.02}, spreads[i], shape.curl_deg[i], lengths[i],
                   i == 3 ? 0.046 : 0.054);
    const double spread = radians_of(shape.thumb_spread_deg);
    const glm::dvec3 root(0.125, -0.045, 0.12);
    const glm::dvec3 out(std::sin(spread), -0.35, std::cos(spread));
    const glm::dvec3 middle = root + 0.24 * glm::normalize(out);
    const glm::dvec3 end = middle + 0.17 * glm::normalize(out + glm::dvec3(-0.25, -0.1, 0.35));
    hand.add(bar(root, middle, 0.072, 0.056), 0.05);
    hand.add(bar(middle, end, 0.056, 0.044), 0.025);
    return hand;
}

Clay sculpt_foot() {
    Clay foot;
    // Heel to ball along the sole, with the instep falling from the ankle.
    const auto sole = LoftAxis::straight({0, 0.22, 0.10}, {0.01, -0.52, 0.05}, {0, 0, 1}, {1, 0, 0});
    foot.add(loft(sole,
                  {{0.0, 0.105, 0.100, 0, 0.00},
                   {0.25, 0.125, 0.135, 0, 0.04},
                   {0.5, 0.135, 0.135, 0.01, 0.05},
                   {0.75, 0.165, 0.095, 0.0, 0.03},
                   {1.0, 0.170, 0.060, -0.01, 0.01}},
                  0.9),
             0.05);
    foot.add(bar({0, 0.02, 0.30}, {0.02, -0.30, 0.13}, 0.12, 0.085), 0.12);
    foot.add(sphere({0.10, 0.02, 0.255}, 0.045), 0.06);
    foot.add(sphere({-0.10, 0.045, 0.235}, 0.042), 0.06);
    // The arch of the inner side.
    foot.carve(ellipsoid({0.20, -0.16, -0.01}, {0.10, 0.20, 0.06}), 0.05);
    constexpr std::array<double, 5> places{0.115, 0.022, -0.042, -0.098, -0.148};
    constexpr std::array<double, 5> tips{-0.755, -0.765, -0.735, -0.690, -0.640};
    constexpr std::array<double, 5> radii{0.062, 0.043, 0.041, 0.039, 0.037};
    for (std::size_t i = 0; i < 5; ++i) {
        const double r = radii[i];
        foot.add(bar({places[i], -0.50, 0.075}, {places[i] * 1.03, tips[i] + 0.09, r * 1.15}, r, r * 0.9),
                 0.03);
        foot.add(ellipsoid({places[i] * 1.03, tips[i] + r, r * 0.92}, {r * 0.98, r * 1.2, r * 0.92}), 0.02);
    }
    return foot;
}

} // namespace overt
