/// Lamps inside of objects, and lamps that cut through them.
#include <catch2/catch.hpp>

#include "app/check/lamp_check.h"
#include "tests/app/small_experiment.h"
#include "tests/support/figures.h"

using namespace overt;
using namespace overt::test;

namespace {

LightSource lamp_at(LightSource::Shape shape, glm::vec3 place, float size) {
    LightSource lamp;
    lamp.shape = shape;
    lamp.place = place;
    lamp.facing = {0.0f, -1.0f, 0.0f};
    lamp.across = {1.0f, 0.0f, 0.0f};
    lamp.half_width = lamp.half_height = lamp.radius = size;
    return lamp;
}

} // namespace

TEST_CASE("a lamp is outside of a ball, inside, or cuts through it", "[unit]") {
    const Mesh ball = test::ball({5.0, 0.0, 0.0}, 10.0, 48, 96);
    const Enclosure surface(ball);
    const auto place = [&](LightSource::Shape shape, float x, float size) {
        return place_of_lamp(lamp_at(shape, {5.0f + x, 0.1f, 0.2f}, size), surface);
    };
    for (const auto shape :
         {LightSource::Shape::sphere, LightSource::Shape::disc, LightSource::Shape::rectangle}) {
        CAPTURE(static_cast<int>(shape));
        CHECK(place(shape, 0.0f, 3.0f) == LampPlace::inside);
        CHECK(place(shape, 9.0f, 3.0f) == LampPlace::cutting);
        CHECK(place(shape, 11.0f, 3.0f) == LampPlace::cutting);
        CHECK(place(shape, -15.0f, 3.0f) == LampPlace::outside);
        CHECK(place(shape, 0.0f, 30.0f) == LampPlace::cutting);
    }
    // Beside it, a flat lamp reaches over the ball without touching it.
    CHECK(place_of_lamp(lamp_at(LightSource::Shape::disc, {5.0f, 11.0f, 0.0f}, 20.0f), surface) ==
          LampPlace::outside);
    // An open bowl has no inside.
    Mesh bowl = ball;
    bowl.triangles.resize(bowl.triangles.size() / 2);
    const Enclosure of_bowl(bowl);
    CHECK(place_of_lamp(lamp_at(LightSource::Shape::sphere, {5.0f, 0.0f, 0.0f}, 1.0f), of_bowl) ==
          LampPlace::outside);
}

TEST_CASE("a lamp that an object turns into is warned of at its place", "[unit]") {
    const std::string lit = R"(
[[light]]
id = "desk"
probe = "dark"
lamps = ["near", "far"]
[[lamp]]
id = "near"
shape = "sphere"
luminance_cd_m2 = 100
position = [0, 0, 0]
radius = 1
[[lamp]]
id = "far"
shape = "sphere"
luminance_cd_m2 = 100
position = [0, 9000, 0]
radius = 1
)";
    const SmallExperiment files(std::string(small_protocol) + lit);
    Diagnostics diagnostics;
    const auto experiment =
        read_experiment(files.protocol(), files.cache(), InputDepth::objects, diagnostics);
    INFO(diagnostics.print());
    REQUIRE(experiment);
    Diagnostics said;
    check_lamps(*experiment, said);
    const std::string text = said.print();
    CHECK_THAT(text, Catch::Contains("lamp \"near\" of light \"desk\" stands inside object \"bust\""));
    CHECK_THAT(text, !Catch::Contains("\"far\""));
    CHECK(said.error_count() == 0);
}
