/// Marks in pictures of trials.
#include "app/record/picture_marks.h"

#include <catch2/catch.hpp>

using namespace overt;

TEST_CASE("a mark is drawn as it is shown: its pixels its light, its rim dark, the rest as it was",
          "[unit]") {
    LinearImage picture(glm::ivec2(40, 30));
    std::ranges::fill(picture.pixels, glm::vec4(0.5f));
    StimulusMark mark;
    mark.light = {1.0, 0.1, 0.2};
    mark.rim_px = 2.0;
    mark.count = 1;
    mark.lines[0].count = 1;
    mark.lines[0].width_px = 6.0;
    mark.lines[0].points[0] = {20.0, 10.0};
    draw_mark(picture, mark);
    int lit = 0, dark = 0;
    for (int y = 0; y < 30; ++y)
        for (int x = 0; x < 40; ++x) {
            const double away = std::hypot(x + 0.5 - 20.0, y + 0.5 - 10.0);
            const glm::vec4 expected = away <= 3.0   ? glm::vec4(1.0f, 0.1f, 0.2f, 1.0f)
                                       : away <= 5.0 ? glm::vec4(0.0f, 0.0f, 0.0f, 1.0f)
                                                     : glm::vec4(0.5f);
            REQUIRE(picture.at(x, y) == expected);
            lit += away <= 3.0;
            dark += away > 3.0 && away <= 5.0;
        }
    CHECK(lit > 20);
    CHECK(dark > 40);
    // What lies beyond the picture is cut off, of a line with two ends as of a disc.
    mark.lines[0].count = 2;
    mark.lines[0].points[0] = {-50.0, 25.0};
    mark.lines[0].points[1] = {90.0, 25.0};
    draw_mark(picture, mark);
    CHECK(picture.at(0, 25).x == 1.0f);
    CHECK(picture.at(39, 25).x == 1.0f);
    CHECK(picture.at(20, 20).x == 0.0f);
}
