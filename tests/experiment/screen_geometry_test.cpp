#include "experiment/screen_geometry.h"

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

using namespace overt;

TEST_CASE("a centred image begins at an even column, half a pixel from the middle at most", "[unit]") {
    for (const int screen : {1920, 1919, 1366}) {
        for (const int image : {1024, 1023, 1022, 1021, 2}) {
            CAPTURE(screen, image);
            const glm::ivec2 origin = centred_origin_px({screen, screen}, {image, image});
            // Pairs of pixels that carry one colour begin at even columns.
            CHECK(origin.x % 2 == 0);
            CHECK(std::abs(2 * origin.x + image - screen) <= 4);
            CHECK(std::abs(2 * origin.y + image - screen) <= 1);
        }
    }
}

TEST_CASE("angles on the screen are those of its trigonometry, in both directions", "[unit]") {
    ScreenGeometry screen;
    screen.screen_px = {1000, 500};
    screen.screen_mm = {400.0, 300.0}; // 0.4 mm wide and 0.6 mm high
    screen.viewing_distance_mm = 500.0;
    const ScreenPoint middle = screen.centre();
    const auto deg = [](double mm) { return std::atan(mm / 500.0) * 180.0 / std::numbers::pi; };
    CHECK(screen.angle_between(middle, {middle.x_px + 100.0, middle.y_px}).value == Approx(deg(40.0)));
    CHECK(screen.angle_between(middle, {middle.x_px, middle.y_px + 100.0}).value == Approx(deg(60.0)));
    CHECK(screen.angle_between({0.0, middle.y_px}, {1000.0, middle.y_px}).value == Approx(2.0 * deg(200.0)));
    // A degree at the middle, across.
    CHECK(screen.angle_between(middle, {middle.x_px + screen.px_per_deg_at_centre(), middle.y_px}).value ==
          Approx(1.0));
}
