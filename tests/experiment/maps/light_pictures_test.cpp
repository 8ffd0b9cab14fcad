/// Small pictures of a stimulus's light: what is written is read, and what a place scores against the object.
#include "experiment/maps/light_pictures.h"

#include <filesystem>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "tests/support/temporary_folder.h"

using namespace overt;
using Catch::Matchers::Contains;
using test::TemporaryFolder;

namespace {

/// Three squares beside each other, of four pixels but the last, which the image's edge cuts; two poses.
LightPictures three_squares() {
    return {{10, 4}, 4, 2, {0.002f, 0.18f, 1.0f, 0.25f, 0.25f, 0.25f}, {1.0f, 0.5f, 1.0f, 1.0f, 1.0f, 0.0f}};
}

} // namespace

TEST_CASE("light that is written is read again, and only for the stimulus that it is of", "[unit]") {
    const TemporaryFolder folder;
    const auto file = folder.path() / "ball_gold_light.exr";
    const LightPictures light = three_squares();
    write_light_pictures(file, light);
    const LightPictures read = read_light_pictures(file, {10, 4}, 2);
    CHECK(read.square_px == 4);
    CHECK(read.size() == glm::ivec2(3, 1));
    REQUIRE(read.luminance.size() == 6);
    for (std::size_t i = 0; i < 6; ++i) {
        // Half floats have 11 bits.
        CHECK(read.luminance[i] == Approx(light.luminance[i]).epsilon(1.0 / 2048));
        CHECK(read.coverage[i] == light.coverage[i]);
    }
    CHECK_THROWS_WITH(read_light_pictures(file, {10, 4}, 3),
                      Contains("ball_gold_light.exr") && Contains("3 pictures of 10 x 4"));
    CHECK_THROWS_WITH(read_light_pictures(file, {10, 8}, 2), Contains("2 pictures of 10 x 8"));
    std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
    CHECK_THROWS_AS(read_light_pictures(file, {10, 4}, 2), InputError);
    CHECK_THROWS_AS(read_light_pictures(folder.path() / "none.exr", {10, 4}, 2), InputError);
}

TEST_CASE("an image's longer side has 128 squares at most", "[unit]") {
    CHECK(light_square_px({128, 96}) == 1);
    CHECK(light_square_px({129, 96}) == 2);
    CHECK(light_square_px({800, 800}) == 7);
    CHECK(light_square_px({96, 1280}) == 10);
}

TEST_CASE("a place scores its lightness in standard deviations from the object's mean", "[unit]") {
    const LightScores scores(three_squares());
    // By the formulas of ISO/CIE 11664-4 in Python: lightness 1.806593, 49.496108, 100; weights 1, 0.5, 1.
    CHECK(*scores.at({0}, {0.0, 0.0}) == Approx(-1.1115338).epsilon(1e-4));
    CHECK(*scores.at({0}, {3.9, 3.9}) == *scores.at({0}, {0.0, 0.0}));
    CHECK(*scores.at({0}, {4.0, 2.0}) == Approx(-0.0256336).epsilon(1e-2));
    CHECK(*scores.at({0}, {9.9, 0.0}) == Approx(1.1243506).epsilon(1e-4));
    for (const glm::dvec2 outside : {glm::dvec2(-0.1, 1.0), glm::dvec2(10.0, 1.0), glm::dvec2(1.0, 4.0)})
        CHECK_FALSE(scores.at({0}, outside));
    // One light throughout; and a pose that there is not.
    CHECK_FALSE(scores.at({1}, {0.0, 0.0}));
    CHECK_FALSE(scores.at({2}, {0.0, 0.0}));

    // Of squares that the object hardly touches nothing is said.
    LightPictures edge = three_squares();
    edge.coverage[1] = 0.49f;
    CHECK_FALSE(LightScores(edge).at({0}, {4.0, 2.0}));
    CHECK(LightScores(edge).at({0}, {0.0, 0.0}));
}

TEST_CASE("what is brighter than the display's white scores as white, as it was shown", "[unit]") {
    LightPictures white = three_squares(), beyond = three_squares();
    REQUIRE(white.luminance[2] == 1.0f);
    beyond.luminance[2] = 80.0f;
    for (const double x : {0.0, 4.0, 9.9})
        CHECK(*LightScores(beyond).at({0}, {x, 0.0}) == *LightScores(white).at({0}, {x, 0.0}));
}
