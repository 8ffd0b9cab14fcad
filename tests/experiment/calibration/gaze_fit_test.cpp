/// Fits of gaze to targets: planted functions come back, and one bad target does not bend them.
#include <catch2/catch.hpp>

#include <cmath>

#include "experiment/base/error.h"
#include "experiment/base/random.h"
#include "experiment/calibration/gaze_fit.h"
#include "experiment/calibration/own_calibration.h"

using namespace overt;

namespace {

const ScreenGeometry screen{};

/// What a camera might see of places on the screen; second order.
ScreenPoint bent(ScreenPoint place) {
    const double x = place.x_px / 960.0 - 1.0, y = place.y_px / 540.0 - 1.0;
    return {700.0 + 500.0 * x + 30.0 * y + 20.0 * x * y - 25.0 * x * x,
            400.0 - 20.0 * x + 300.0 * y + 15.0 * y * y};
}

/// The same plane seen from elsewhere.
ScreenPoint tilted(ScreenPoint place) {
    const double x = place.x_px / 960.0 - 1.0, y = place.y_px / 540.0 - 1.0, w = 1.0 + 0.2 * x - 0.1 * y;
    return {800.0 + 600.0 * (x + 0.1 * y) / w, 500.0 + 350.0 * (y - 0.05 * x) / w};
}

std::vector<CalibrationPair> pairs_of(int points, ScreenPoint (*measured)(ScreenPoint)) {
    std::vector<CalibrationPair> pairs;
    for (const ScreenPoint target : calibration_targets(points, 0.8, screen))
        pairs.push_back({measured(target), target});
    return pairs;
}

double largest_miss_deg(const GazeFit& fit, ScreenPoint (*measured)(ScreenPoint)) {
    double largest = 0.0;
    for (double x = 200.0; x <= 1720.0; x += 95.0)
        for (double y = 110.0; y <= 970.0; y += 86.0)
            largest = std::max(largest, screen.angle_between(fit(measured({x, y})), {x, y}).value);
    return largest;
}

ScreenPoint shifted(ScreenPoint place) {
    return {1.2 * place.x_px - 300.0, 0.9 * place.y_px + 0.05 * place.x_px};
}

} // namespace

TEST_CASE("a fit that was not made changes nothing", "[unit]") {
    CHECK(GazeFit()({12.5, -3.0}) == ScreenPoint{12.5, -3.0});
}

TEST_CASE("a planted function of the model's own kind comes back", "[unit]") {
    using enum CalibrationModel;
    CHECK(largest_miss_deg(GazeFit(pairs_of(3, shifted), polynomial, screen), shifted) < 1e-6);
    CHECK(largest_miss_deg(GazeFit(pairs_of(5, shifted), polynomial, screen), shifted) < 1e-6);
    CHECK(largest_miss_deg(GazeFit(pairs_of(9, shifted), polynomial, screen), shifted) < 1e-6);
    for (const int points : {5, 9, 13})
        CHECK(largest_miss_deg(GazeFit(pairs_of(points, tilted), homography, screen), tilted) < 1e-6);
    // The inverse of a function of second order is not one: near it, between the targets as at them.
    CHECK(largest_miss_deg(GazeFit(pairs_of(9, bent), polynomial, screen), bent) < 0.25);
    CHECK(largest_miss_deg(GazeFit(pairs_of(5, bent), polynomial, screen), bent) > 0.3);
}

TEST_CASE("one target that was not looked at hardly bends the fit, and is told apart", "[unit]") {
    RandomStream random(5, "calibration noise");
    for (const std::size_t bad : {std::size_t{0}, std::size_t{3}, std::size_t{7}}) {
        std::vector<CalibrationPair> pairs = pairs_of(13, shifted);
        for (CalibrationPair& pair : pairs) {
            pair.measured.x_px += 3.0 * random.normal();
            pair.measured.y_px += 3.0 * random.normal();
        }
        const double without =
            largest_miss_deg(GazeFit(pairs, CalibrationModel::polynomial, screen), shifted);
        pairs[bad].measured.x_px += 400.0; // some seven degrees
        const double with = largest_miss_deg(GazeFit(pairs, CalibrationModel::polynomial, screen), shifted);
        CHECK(with < without + 1.2);
        const std::vector<Degrees> misses = misses_left_out(pairs, CalibrationModel::polynomial, screen);
        REQUIRE(misses.size() == 13);
        for (std::size_t i = 0; i < misses.size(); ++i)
            if (i != bad)
                CHECK(misses[i].value < 0.7 * misses[bad].value);
    }
}

TEST_CASE("targets that gaze did not follow are refused", "[unit]") {
    std::vector<CalibrationPair> pairs = pairs_of(9, shifted);
    for (CalibrationPair& pair : pairs)
        pair.measured = {500.0, 500.0};
    CHECK_THROWS_AS(GazeFit(pairs, CalibrationModel::polynomial, screen), InputError);
    for (CalibrationPair& pair : pairs)
        pair.measured = {pair.target.x_px, pair.target.x_px};
    CHECK_THROWS_AS(GazeFit(pairs, CalibrationModel::homography, screen), InputError);
    CHECK_THROWS_AS(GazeFit(std::span(pairs).first(2), CalibrationModel::polynomial, screen), InputError);
}

TEST_CASE("of gaze that rests at one place or moves along a line no target is told apart", "[unit]") {
    for (const CalibrationModel model : {CalibrationModel::polynomial, CalibrationModel::homography}) {
        std::vector<CalibrationPair> pairs = pairs_of(9, shifted);
        for (CalibrationPair& pair : pairs)
            pair.measured = {500.0, 500.0};
        CHECK(misses_left_out(pairs, model, screen) == std::vector<Degrees>(9));
        for (CalibrationPair& pair : pairs)
            pair.measured = {pair.target.x_px, 2.0 * pair.target.x_px};
        CHECK(misses_left_out(pairs, model, screen) == std::vector<Degrees>(9));
    }
}

TEST_CASE("targets stand on even pixels, within the area, at different places", "[unit]") {
    for (const int points : {3, 5, 9, 13}) {
        const std::vector<ScreenPoint> targets = calibration_targets(points, 0.8, screen);
        REQUIRE(static_cast<int>(targets.size()) == points);
        for (std::size_t i = 0; i < targets.size(); ++i) {
            CHECK(std::fmod(targets[i].x_px, 2.0) == 0.0);
            CHECK(std::fmod(targets[i].y_px, 2.0) == 0.0);
            CHECK(std::abs(targets[i].x_px - 960.0) <= 0.4 * 1920.0);
            CHECK(std::abs(targets[i].y_px - 540.0) <= 0.4 * 1080.0);
            for (std::size_t j = 0; j < i; ++j)
                CHECK_FALSE(targets[i] == targets[j]);
        }
    }
}
