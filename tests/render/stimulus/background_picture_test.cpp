#include "render/stimulus/background_picture.h"

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "tests/support/temporary_folder.h"

using namespace overt;
using namespace overt::test;

namespace {

glm::vec3 at(const LinearImage& image, int x, int y) { return glm::vec3(image.at(x, y)); }

bool is_near(const glm::vec3& a, const glm::vec3& b) { return glm::distance(a, b) < 1e-4f; }

} // namespace

TEST_CASE("what is behind an object fills what it does not cover", "[unit]") {
    DisplaySettings display;
    display.background = 0.1;
    BackgroundSettings own, grey, red;
    grey.grey = 0.4;
    red.colour = glm::dvec3(0.5, 0.0, 0.0);
    CHECK(is_displays_own(own));
    CHECK_FALSE(is_displays_own(grey));
    CHECK(is_near(at(draw_background(own, {2, 2}, display), 1, 1), glm::vec3(0.1f)));
    CHECK(is_near(at(draw_background(grey, {2, 2}, display), 0, 1), glm::vec3(0.4f)));
    // Colours of a picture are multiplied by alpha: an edge that is half covered lets half of it through.
    LinearImage picture({3, 1});
    picture.at(0, 0) = {0.2f, 0.2f, 0.2f, 1.0f};
    picture.at(1, 0) = {0.1f, 0.1f, 0.1f, 0.5f};
    put_before(picture, draw_background(red, {3, 1}, display));
    CHECK(is_near(at(picture, 0, 0), {0.2f, 0.2f, 0.2f}));
    CHECK(is_near(at(picture, 1, 0), {0.35f, 0.1f, 0.1f}));
    CHECK(is_near(at(picture, 2, 0), {0.5f, 0.0f, 0.0f}));
    CHECK(picture.at(1, 0).w == 1.0f);
    CHECK(hash_of_background(grey) != hash_of_background(red));
}

TEST_CASE("a picture covers the image, about its middle, in the mean of its light", "[unit]") {
    const TemporaryFolder folder;
    BackgroundSettings background;
    background.picture = (folder.path() / "wall.exr").string();
    // Twice as wide as high: of eight columns the middle four are seen in a square.
    LinearImage wall({8, 4});
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 8; ++x)
            wall.at(x, y) = glm::vec4(glm::vec3(static_cast<float>(x) / 8.0f), 1.0f);
    write_linear_exr(background.picture, wall, {});
    const DisplaySettings display;
    const LinearImage half = draw_background(background, {2, 2}, display);
    CHECK(is_near(at(half, 0, 0), glm::vec3(2.5f / 8.0f))); // columns 2 and 3
    CHECK(is_near(at(half, 1, 1), glm::vec3(4.5f / 8.0f))); // columns 4 and 5
    const LinearImage same = draw_background(background, {8, 4}, display);
    CHECK(is_near(at(same, 3, 2), glm::vec3(3.0f / 8.0f)));
    const LinearImage large = draw_background(background, {16, 8}, display);
    CHECK(is_near(at(large, 7, 3), glm::vec3(3.25f / 8.0f))); // a quarter of the way from column 3 to 4
    background.picture = (folder.path() / "missing.exr").string();
    CHECK_THROWS_AS(draw_background(background, {2, 2}, display), InputError);
}
