#include <catch2/catch.hpp>

#include "experiment/protocol/protocol.h"
#include "experiment/stimulus/object.h"
#include "tests/experiment/protocol/protocol_fixtures.h"

using namespace overt;
using Catch::Contains;
using test::ReadText;
using Lines = std::vector<std::string>;

namespace {

/// A screen of half a millimetre to the pixel; what a test adds begins in line 22.
constexpr std::string_view with_picture = R"([protocol]
name = "flat"
[display]
width_px = 800
height_px = 600
width_mm = 400
height_mm = 300
viewing_distance_mm = 500
[view]
width_px = 200
height_px = 100
[animation]
kind = "movie"
frame_count = 4
frame_rate_hz = 10
[[task]]
id = "free"
question = "Look."
[[object]]
picture = "film_##.png"
areas = { face = { rectangles = [[20, 10, 60, 50]], discs = [[150, 70, 20]] } }
)";

} // namespace

TEST_CASE("a picture is as large as on the screen, with its areas, and fills the image of its camera",
          "[unit]") {
    const ReadText read(with_picture);
    CHECK(read.lines().empty());
    REQUIRE(read.protocol);
    const Protocol& protocol = *read.protocol;
    const ObjectSettings& settings = protocol.objects[0];
    CHECK(settings.id == "film___");
    CHECK(settings.picture_mm == glm::dvec2(100.0, 50.0));
    // Millimetres upwards from the lower left corner.
    REQUIRE(settings.areas[0].boxes.size() == 1);
    CHECK(settings.areas[0].boxes[0][0].x == Approx(10.0));
    CHECK(settings.areas[0].boxes[0][0].z == Approx(25.0));
    CHECK(settings.areas[0].boxes[0][1].x == Approx(30.0));
    CHECK(settings.areas[0].boxes[0][1].z == Approx(45.0));
    REQUIRE(settings.areas[0].spheres.size() == 1);
    CHECK(settings.areas[0].spheres[0] == std::array{75.0, 0.0, 15.0, 10.0});

    const Object object = load_object(settings, protocol, "none");
    REQUIRE(object.has_mesh());
    CHECK(object.mesh->area() == Approx(5000.0));
    // The corners of the picture are those of the image, and the picture is seen from the observer's
    // distance.
    const View& view = object.scene().view;
    const glm::dvec2 low = view.project({0.0, 0.0, 0.0}), high = view.project({100.0, 0.0, 50.0});
    CHECK(low.x == Approx(0.0).margin(1e-9));
    CHECK(low.y == Approx(100.0));
    CHECK(high.x == Approx(200.0));
    CHECK(high.y == Approx(0.0).margin(1e-9));
    CHECK(view.depth_of({50.0, 0.0, 25.0}) == Approx(500.0));
    // Pixel (20, 10) is a corner of the area.
    const glm::dvec2 corner = view.project({10.0, 0.0, 45.0});
    CHECK(corner.x == Approx(20.0));
    CHECK(corner.y == Approx(10.0));
}

TEST_CASE("a picture's stimuli are its files, in each material, light and motion, and need no material",
          "[unit]") {
    const ReadText alone(with_picture, "picture_first_number = 3\n");
    REQUIRE(alone.protocol);
    REQUIRE(alone.protocol->materials.size() == 1);
    CHECK(alone.protocol->materials[0].id == "picture");
    const FrameSequenceSettings* const frames = find_frames(*alone.protocol, Stimulus{});
    REQUIRE(frames);
    CHECK(frame_file(*frames, {2}) == "film_05.png");
    CHECK(frames->encoding == FrameEncoding::srgb);
    CHECK(frames->colour_space == FrameColours::rec709);
    CHECK(place_of_frames(*alone.protocol, 0) == "object[0].picture");

    // Beside a shape it is one of the objects, in whatever material; a picture in linear light is taken as
    // that.
    const ReadText beside(with_picture,
                          "[[object]]\nid = \"still\"\npicture = \"one.exr\"\n[[material]]\nid = \"gold\"\n"
                          "kind = \"diffuse\"\n[[material]]\nid = \"clay\"\nkind = \"diffuse\"\n");
    CHECK(beside.lines().empty());
    REQUIRE(beside.protocol);
    CHECK(beside.protocol->frames.size() == 4);
    Stimulus stimulus;
    stimulus.object = 1;
    stimulus.material = 1;
    const FrameSequenceSettings* const still = find_frames(*beside.protocol, stimulus);
    REQUIRE(still);
    CHECK(still->encoding == FrameEncoding::linear);
    CHECK(frame_file(*still, {3}) == "one.exr");
}

TEST_CASE("a movie shows each picture in turn, from one pose, and turns no light", "[unit]") {
    const ReadText read(with_picture, "");
    REQUIRE(read.protocol);
    Animation movie = read.protocol->motions[0];
    CHECK(movie.pictures().size() == 4);
    CHECK(distinct_poses(movie).angles.size() == 1);
    CHECK_FALSE(movie.turns_light());
    CHECK(movie.only_turns());
    CHECK(movie.largest_turn().value == 0.0);
    movie.playback = Playback::cycle;
    CHECK(movie.steps_per_period() == 4);
    for (int step = 0; step < 8; ++step)
        CHECK(movie.frame_at_step(step).value == step % 4);
    movie.playback = Playback::ping_pong;
    CHECK(movie.steps_per_period() == 6);
    CHECK(movie.frame_at_step(4).value == 2);
}

TEST_CASE("what contradicts a picture is found at its place", "[unit]") {
    CHECK(ReadText(with_picture, "mesh = \"a.ply\"\n").lines() ==
          Lines{"20:11: an object is either a \"picture\" or a \"mesh\", not both"});
    CHECK(ReadText(with_picture, "up = \"y\"\n").lines() ==
          Lines{"22:6: \"up\" has no effect without \"mesh\""});
    const auto with = [](std::string_view from, std::string_view to) {
        std::string text(with_picture);
        text.replace(text.find(from), from.size(), to);
        const Lines lines = ReadText(text).lines();
        return lines.empty() ? std::string() : lines.front();
    };
    CHECK_THAT(with("kind = \"movie\"", "kind = \"turn\""), Contains("a flat picture does not move"));
    CHECK_THAT(with("rectangles = [[20, 10, 60, 50]]", "rectangles = [[60, 10, 20, 50]]"),
               Contains("has nothing of the picture, which is 200 x 100 px"));
    CHECK_THAT(with("rectangles = [[20, 10, 60, 50]]", "rectangles = [[200, 10, 240, 50]]"),
               Contains("has nothing of the picture"));
    CHECK_THAT(with("rectangles = [[20, 10, 60, 50]]", "spheres = [[20, 10, 60, 50]]"),
               Contains("\"spheres\" describes places of a shape"));
    CHECK_THAT(with("film_##.png", "film_##_#.png"), Contains("one group of #"));
    CHECK_THAT(ReadText(test::minimal_protocol,
                        "[[object]]\nid = \"b\"\nmesh = \"b.ply\"\nareas = { x = { discs = [[1, 2, 3]] } }\n")
                   .lines()
                   .at(0),
               Contains("lie on a flat picture, and this is a shape"));
}
