#include "experiment/fits/attitude_regression.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace overt {

glm::dvec2 depth_rise(const Attitude& attitude) {
    const double slant = to_radians(attitude.slant).value, tilt = to_radians(attitude.tilt).value;
    return std::tan(slant) * glm::dvec2(std::cos(tilt), std::sin(tilt));
}

std::optional<AttitudeRegression> regress_attitudes(std::span<const AttitudePair> pairs) {
    struct Rises {
        glm::dvec2 set, truth;
    };
    std::vector<Rises> rises;
    Rises sum{glm::dvec2(0.0), glm::dvec2(0.0)};
    for (const AttitudePair& pair : pairs) {
        if (pair.truth.slant.value > steepest_regressed_deg)
            continue;
        Attitude set = pair.set;
        set.slant.value = std::min(set.slant.value, steepest_set_deg);
        rises.push_back({depth_rise(set), depth_rise(pair.truth)});
        sum.set += rises.back().set;
        sum.truth += rises.back().truth;
    }
    if (rises.size() < 3)
        return std::nullopt;
    const auto count = static_cast<double>(rises.size());
    const Rises mean{sum.set / count, sum.truth / count};
    double products = 0.0, squares = 0.0, set_squares = 0.0;
    for (const Rises& rise : rises) {
        const glm::dvec2 set = rise.set - mean.set, truth = rise.truth - mean.truth;
        products += glm::dot(set, truth);
        squares += glm::dot(truth, truth);
        set_squares += glm::dot(set, set);
    }
    if (squares < 1e-12 * count)
        return std::nullopt;
    AttitudeRegression found;
    found.gain = products / squares;
    found.shear = mean.set - found.gain * mean.truth;
    found.r = set_squares > 0.0 ? products / std::sqrt(squares * set_squares) : 0.0;
    found.count = static_cast<int>(rises.size());
    return found;
}

} // namespace overt
