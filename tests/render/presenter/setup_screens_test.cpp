/// The screens of a tracker's set-up, by what is drawn of them.
#include "render/presenter/setup_screens.h"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "render/presenter/screen_text.h"

using namespace overt;

namespace {

constexpr glm::ivec2 whole_px{960, 540};

ScreenGeometry screen_of() {
    ScreenGeometry geometry;
    geometry.screen_px = geometry.image_px = whole_px;
    return geometry;
}

/// An eye as a camera sees it: a grey face, a dark pupil in the middle, crosshairs in red through it.
CameraImage eye() {
    CameraImage image{96, 80, {}, "Left, threshold 80"};
    for (int y = 0; y < image.height_px; ++y)
        for (int x = 0; x < image.width_px; ++x) {
            const bool is_hair = x == image.width_px / 2 || y == image.height_px / 2;
            const bool is_pupil = std::hypot(x - 48.0, y - 40.0) < 14.0;
            const int grey = is_pupil ? 20 : 150;
            for (const int value : {is_hair ? 255 : grey, is_hair ? 0 : grey, is_hair ? 0 : grey, 255})
                image.rgba.push_back(static_cast<std::byte>(value));
        }
    return image;
}

bool is_red(const glm::vec4& pixel) { return pixel.x > 4.0f * pixel.y && pixel.x > 0.05f; }

} // namespace

TEST_CASE("the camera's image stands in the middle of the screen with its proportions, its title below",
          "[unit]") {
    ScreenSettings settings;
    settings.text_height_deg = 0.5;
    const PlacedPicture placed = draw_screen(
        {.kind = Screen::Kind::camera, .text = eye().title, .camera = eye()}, screen_of(), settings, 0.0);
    REQUIRE(placed.picture.size_px == whole_px);
    CHECK(placed.origin_px == glm::ivec2(0));
    // Seven tenths of the height: 378 px for 80, so 453 px for 96.
    int left = whole_px.x, right = -1, top = whole_px.y, bottom = -1;
    for (int y = 0; y < whole_px.y; ++y)
        for (int x = 0; x < whole_px.x; ++x)
            if (is_red(placed.picture.at(x, y))) {
                left = std::min(left, x);
                right = std::max(right, x);
                top = std::min(top, y);
                bottom = std::max(bottom, y);
            }
    CHECK(right - left + 1 == Approx(453).margin(6));
    CHECK(bottom - top + 1 == Approx(378).margin(6));
    CHECK(0.5 * (left + right + 1) == Approx(0.5 * whole_px.x).margin(4));
    // Light is linear: a signal of 150 of 255 is about 0.3 of white, and white is the texts' grey.
    const float face = placed.picture.at(left + 20, top + 20).x;
    const float pupil = placed.picture.at(whole_px.x / 2 + 20, top + 189 + 20).x;
    CHECK(face == Approx(settings.text_grey * std::pow(150.0 / 255.0, 2.2)).epsilon(0.15));
    CHECK(pupil < 0.05f * face);
    int below = 0;
    for (int y = bottom + 4; y < whole_px.y; ++y)
        for (int x = 0; x < whole_px.x; ++x)
            below += placed.picture.at(x, y).x > 0.5f * static_cast<float>(settings.text_grey) ? 1 : 0;
    CHECK(below > 100);
}

TEST_CASE("a camera's image that is shorter than it says is not drawn", "[unit]") {
    CameraImage cut = eye();
    cut.rgba.resize(cut.rgba.size() / 2);
    const PlacedPicture placed = draw_screen({.kind = Screen::Kind::camera, .text = "", .camera = cut},
                                             screen_of(), ScreenSettings{}, 0.0);
    for (const glm::vec4& pixel : placed.picture.pixels)
        REQUIRE_FALSE(is_red(pixel));
}
