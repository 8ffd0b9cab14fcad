/// What a validation found, on screens and with letters, targets and errors of all kinds: no text meets
/// another one, and all of them are seen.
#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "experiment/base/random.h"
#include "render/presenter/screen_text.h"
#include "render/presenter/validation_layout.h"
#include "tests/render/presenter/apart_texts.h"

using namespace overt;
using namespace overt::test;

namespace {

ScreenGeometry geometry_of(glm::ivec2 screen_px, double px_per_mm = 3.6) {
    ScreenGeometry geometry;
    geometry.screen_px = geometry.image_px = screen_px;
    geometry.screen_mm = glm::dvec2(screen_px) / px_per_mm;
    geometry.viewing_distance_mm = 600.0;
    return geometry;
}

enum class Places { grid, edges, heap };

/// Targets all over the screen, at its edges, or all at nearly one place, of one eye or both.
Screen result_of(const ScreenGeometry& geometry, int targets, bool both_eyes, double error_deg, Places places,
                 std::uint64_t seed) {
    RandomStream random(seed, "validation");
    Screen screen{.kind = Screen::Kind::validation,
                  .text = "Validation: go on with this calibration?\n0.42° (1.07°)",
                  .keys = {{"Y", "yes"}, {"N", "no"}},
                  .frame = "For the experimenter"};
    const glm::dvec2 size(geometry.screen_px);
    const int columns = static_cast<int>(std::ceil(std::sqrt(targets)));
    for (int i = 0; i < targets; ++i) {
        glm::dvec2 at = size * glm::dvec2((i % columns + 0.5) / columns, (i / columns + 0.5) / columns);
        if (places == Places::edges)
            at = size * glm::dvec2(i % 2, i / 2 % 2);
        if (places == Places::heap)
            at = size * 0.5 + glm::dvec2(random.uniform(), random.uniform());
        for (const Eye eye : {Eye::left, Eye::right}) {
            if (eye == Eye::left && !both_eyes)
                continue;
            ValidatedTarget target{eye, {at.x, at.y}, {}, Degrees{error_deg * random.uniform()}, {}, {}};
            const double off = target.error.value * geometry.px_per_deg_at_centre(),
                         turn = 6.28 * random.uniform();
            if (random.uniform() < 0.9)
                target.gaze = ScreenPoint{at.x + off * std::cos(turn), at.y + off * std::sin(turn)};
            screen.validated.push_back(target);
        }
    }
    return screen;
}

} // namespace

TEST_CASE(
    "no two texts of a validation's result meet, whatever its targets, eyes, errors, letters and screen",
    "[unit]") {
    std::uint64_t seed = 0;
    for (const glm::ivec2 screen_px :
         {glm::ivec2(640, 400), glm::ivec2(1080, 1920), glm::ivec2(1920, 1080), glm::ivec2(3840, 1080)}) {
        const ScreenGeometry geometry = geometry_of(screen_px);
        for (const double letters_deg : {0.2, 0.8, 2.5}) {
            for (const int targets : {1, 5, 13, 40}) {
                const double error_deg = ++seed % 3 == 0 ? 25.0 : seed % 3 == 1 ? 0.4 : 3.0;
                const auto places = static_cast<Places>(seed / 3 % 3);
                CAPTURE(screen_px.x, screen_px.y, letters_deg, targets, error_deg, static_cast<int>(places));
                ScreenSettings settings;
                settings.text_height_deg = letters_deg;
                const Screen screen = result_of(geometry, targets, seed % 2 == 0, error_deg, places, seed);
                const PlacedPicture drawn = draw_screen(screen, geometry, settings, 0.0);
                check_texts(drawn, screen_px);
                // The frame's title, both keys and what they do, the words, and errors.
                CHECK(drawn.texts.size() > 6);
            }
        }
    }
}

TEST_CASE("on an ordinary screen each error of thirteen targets and two eyes stands beside its target",
          "[unit]") {
    const ScreenGeometry geometry = geometry_of({1920, 1080});
    const Screen screen = result_of(geometry, 13, true, 1.0, Places::grid, 3);
    const PlacedPicture drawn = draw_screen(screen, geometry, ScreenSettings(), 0.0);
    CHECK(drawn.texts.size() == 26 + 6);
    const ValidationLayout layout = lay_out_validation(screen, geometry.screen_px, 100, 850, {});
    CHECK(layout.errors_left_out == 0);
    REQUIRE(layout.marks.size() == 26);
    // Where gaze was measured lies as the screen has it, in its proportions.
    const double scale = layout.screen.width / 1920.0;
    CHECK(layout.screen.height == Approx(1080.0 * scale));
    for (std::size_t i = 0; i < layout.marks.size(); ++i) {
        const ValidatedTarget& target = screen.validated[i];
        CHECK(layout.marks[i].target_px.x == Approx(layout.screen.x + scale * target.target.x_px));
        CHECK(layout.marks[i].gaze_px.has_value() == target.gaze.has_value());
        if (target.gaze)
            CHECK(layout.marks[i].gaze_px->y == Approx(layout.screen.y + scale * target.gaze->y_px));
    }
}

TEST_CASE("gaze that was measured beyond the screen, or nowhere, leaves the words alone", "[unit]") {
    const ScreenGeometry geometry = geometry_of({1280, 720});
    Screen screen = result_of(geometry, 4, false, 1.0, Places::grid, 5);
    screen.validated[0].gaze = ScreenPoint{5000.0, 9000.0};
    screen.validated[1].gaze = ScreenPoint{std::nan(""), 0.0};
    const ValidationLayout layout = lay_out_validation(screen, geometry.screen_px, 60, 560, {});
    REQUIRE(layout.marks[0].gaze_px);
    CHECK_FALSE(layout.marks[0].gaze_is_inside);
    CHECK(layout.marks[0].gaze_px->y <= layout.screen.y + layout.screen.height);
    CHECK_FALSE(layout.marks[1].gaze_px);
    CHECK(layout.screen.y + layout.screen.height < layout.words.origin_px.y);
}
