#include "experiment/protocol/stereo.h"

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>
#include <fmt/ranges.h>

#include "experiment/checks/design_report.h"
#include "experiment/protocol/all_stimuli.h"
#include "experiment/stimulus/disparity.h"
#include "tests/experiment/protocol/protocol_fixtures.h"

using namespace overt;
using namespace overt::test;

namespace {

const std::string plain_screen = "[display]\noutput = \"native-8bit\"\ngamma = 2.2\n[view]\nwidth_px = 512\n"
                                 "height_px = 512\n";

Protocol through_mirrors(const std::string& keys = {}, const std::string& screen = plain_screen) {
    ReadText read(std::string(minimal_protocol) + screen, "[stereo]\nkind = \"mirrors\"\n" + keys);
    INFO(fmt::format("{}", fmt::join(read.lines(), "\n")));
    REQUIRE(read.protocol);
    return *read.protocol;
}

std::vector<std::string> findings(const std::string& stereo, const std::string& screen = plain_screen,
                                  const std::string& more = {}) {
    const ReadText read(std::string(minimal_protocol) + screen + more, "[stereo]\n" + stereo);
    std::vector<std::string> messages;
    for (const Finding& finding : read.diagnostics.findings())
        messages.push_back(finding.message);
    return messages;
}

} // namespace

TEST_CASE("through mirrors an eye's field is half of the screen, and places count in it", "[unit]") {
    const Protocol protocol = through_mirrors();
    CHECK(field_of(protocol, Eye::left) == ImageBox{{0, 0}, {960, 1080}});
    CHECK(field_of(protocol, Eye::right) == ImageBox{{960, 0}, {960, 1080}});
    const ScreenGeometry field = screen_geometry_of(protocol), whole = whole_screen_of(protocol);
    CHECK(field.screen_px == glm::ivec2(960, 1080));
    CHECK(field.screen_mm.x == Approx(0.5 * protocol.display.width_mm));
    CHECK(field.screen_mm.y == protocol.display.height_mm);
    CHECK(whole.screen_px == glm::ivec2(1920, 1080));
    CHECK(whole.screen_mm.x == protocol.display.width_mm);
    // A pixel is as large as ever, and the image in the middle of the field.
    CHECK(field.px_per_deg_at_centre() == Approx(whole.px_per_deg_at_centre()));
    CHECK(field.image_origin_px == glm::ivec2(224, 284));
    const DisplaySettings display = display_of_field(protocol);
    CHECK(display.width_px == 960);
    CHECK(display.height_px == 1080);
    CHECK(display.width_mm == Approx(0.5 * protocol.display.width_mm));

    const Protocol swapped = through_mirrors("swapped = true\n");
    CHECK(field_of(swapped, Eye::left).origin_px.x == 960);
    CHECK(field_of(swapped, Eye::right).origin_px.x == 0);

    Protocol shutters = through_mirrors();
    shutters.stereo.kind = StereoKind::frame_sequential;
    for (const Eye eye : {Eye::left, Eye::right})
        CHECK(field_of(shutters, eye) == ImageBox{{0, 0}, {1920, 1080}});
    shutters.stereo.kind = StereoKind::none;
    CHECK(screen_geometry_of(shutters).screen_px == glm::ivec2(1920, 1080));
}

TEST_CASE("a place of the pointer counts from the middle of the field that it is in", "[unit]") {
    // Halves of 960: their middles are 480 px beside the screen's.
    const Protocol plain = through_mirrors();
    CHECK(in_field(plain, {-480.0, 0.0}) == glm::dvec2(0.0, 0.0));
    CHECK(in_field(plain, {480.0, 20.0}) == glm::dvec2(0.0, 20.0));
    CHECK(in_field(plain, {-0.5, -7.0}) == glm::dvec2(479.5, -7.0));
    CHECK(in_field(plain, {0.0, -7.0}) == glm::dvec2(-480.0, -7.0));
    const Protocol moved = through_mirrors("left_eye_right_px = 10\nleft_eye_down_px = 4\n"
                                           "right_eye_right_px = -6\nright_eye_down_px = -2\n");
    CHECK(in_field(moved, {-480.0, 0.0}) == glm::dvec2(-10.0, -4.0));
    CHECK(in_field(moved, {480.0, 0.0}) == glm::dvec2(6.0, 2.0));
    const Protocol swapped = through_mirrors("swapped = true\nleft_eye_right_px = 10\n");
    CHECK(in_field(swapped, {480.0, 0.0}) == glm::dvec2(-10.0, 0.0));
    const Protocol mirrored = through_mirrors("mirrored = true\nleft_eye_right_px = 10\n");
    CHECK(in_field(mirrored, {-480.0, 1.0}) == glm::dvec2(10.0, 1.0));
    Protocol one = plain;
    one.stereo.kind = StereoKind::frame_sequential;
    CHECK(in_field(one, {-480.0, 3.0}) == glm::dvec2(-480.0, 3.0));
}

TEST_CASE("the right eye's views come behind the left's, at all sizes of slots", "[unit]") {
    const std::string slots = "[[slot]]\nid = \"large\"\nright_deg = 0\n"
                              "[[slot]]\nid = \"small\"\nup_deg = 4\nsize_deg = 2\n";
    Protocol protocol =
        through_mirrors("interocular_mm = 60\n", "slots = \"large\"\n" + plain_screen + slots);
    REQUIRE(protocol.views.size() == 1);
    REQUIRE(protocol.views_at_all_sizes() == 4);
    for (int view = 0; view < 4; ++view)
        CHECK(protocol.view_at(view).aside_mm == (view < 2 ? -30.0 : 30.0));
    CHECK(protocol.view_at(1).width_px == protocol.view_at(3).width_px);
    CHECK(protocol.view_at(0).width_px != protocol.view_at(1).width_px);
    const PlacedStimulus small{{}, 1};
    CHECK(protocol.in_slot(small, Eye::left).view == 1);
    CHECK(protocol.in_slot(small, Eye::right).view == 3);
    protocol.tracker.eye = "left";
    CHECK(protocol.in_slot(small).view == 1);
    protocol.tracker.eye = "right";
    CHECK(protocol.in_slot(small).view == 3);
    protocol.tracker.eye = "both"; // of which the right one is analysed
    CHECK(protocol.in_slot({}).view == 2);
    std::vector<std::string> names;
    for (const Stimulus& stimulus : stimuli_in_slots(protocol))
        names.push_back(stimulus_name(protocol, stimulus, '/'));
    CHECK(names ==
          std::vector<std::string>{"a/gold/left", "a/gold/small/left", "a/gold/right", "a/gold/small/right"});
    CHECK(viewed_name(protocol, {0, 3}, '_') == "a_small_right");
    CHECK(stimulus_in_words(protocol, {}) == "a, gold");
}

TEST_CASE("of several views some are for two eyes, and the others show both the same", "[unit]") {
    const Protocol protocol = through_mirrors(
        "interocular_mm = 50\n",
        "[display]\noutput = \"native-8bit\"\ngamma = 2.2\n[[view]]\nid = \"deep\"\nwidth_px = 512\n"
        "height_px = 512\n[[view]]\nid = \"flat\"\ntwo_eyes = false\nwidth_px = 512\nheight_px = 512\n");
    REQUIRE(protocol.views_at_all_sizes() == 4);
    std::vector<double> aside_mm;
    for (int view = 0; view < 4; ++view)
        aside_mm.push_back(protocol.view_at(view).aside_mm);
    CHECK(aside_mm == std::vector<double>{-25.0, 0.0, 25.0, 0.0});
}

TEST_CASE("what cannot be shown to two eyes is found before a session", "[unit]") {
    using Found = std::vector<std::string>;
    CHECK(findings("kind = \"mirrors\"\n").empty());
    CHECK(findings("kind = \"frame-sequential\"\n").empty());
    const std::string flat = plain_screen + "two_eyes = false\n";
    CHECK(findings("kind = \"mirrors\"\n", flat).empty());
    CHECK(findings("kind = \"none\"\n", flat) ==
          Found{"two_eyes has no meaning: without [stereo] both eyes see the same"});
    CHECK(findings("kind = \"frame-sequential\"\nswapped = true\n") ==
          Found{"swapped has no meaning: it is for kind = \"mirrors\""});
    CHECK(findings("interocular_mm = 63\n") ==
          Found{"interocular_mm has no meaning: both eyes see the same"});
    CHECK(findings("largest_disparity_arcmin = 30\n") ==
          Found{"largest_disparity_arcmin has no meaning: both eyes see the same"});
    CHECK(
        findings("kind = \"mirrors\"\n",
                 "[display]\noutput = \"native-8bit\"\ngamma = 2.2\nwidth_px = 1919\n[view]\nwidth_px = 512\n"
                 "height_px = 512\n") ==
        Found{"each eye has half of the screen: the width has to be a multiple of 2"});
    const std::string packed = "[view]\nwidth_px = 512\nheight_px = 512\n";
    CHECK(findings("kind = \"mirrors\"\n", packed).empty());
    CHECK(findings("kind = \"mirrors\"\nmirrored = true\n", packed) ==
          Found{"color++ joins pixels in pairs, which cannot be exchanged left for right"});
    CHECK(findings("kind = \"mirrors\"\nleft_eye_right_px = 3\n", packed) ==
          Found{"color++ joins pixels in pairs: write an even number"});
    CHECK(findings("kind = \"mirrors\"\nleft_eye_right_px = 3\n").empty());
    // The image leaves 224 px at each side of the half, 284 above and below.
    CHECK(findings("kind = \"mirrors\"\nright_eye_right_px = 224\nleft_eye_down_px = -284\n").empty());
    CHECK(
        findings("kind = \"mirrors\"\nright_eye_right_px = 225\n") ==
        Found{
            "so far moved, a part of the stimulus in slot \"centre\" lies beyond the half of the right eye, "
            "and is cut off"});
    CHECK(
        findings("kind = \"mirrors\"\nleft_eye_down_px = -285\n") ==
        Found{"so far moved, a part of the stimulus in slot \"centre\" lies beyond the half of the left eye, "
              "and is cut off"});
    CHECK(findings("kind = \"mirrors\"\nleft_eye_right_px = 960\n") ==
          Found{"an eye's half is 960 px wide: nothing of its picture would be left"});
    CHECK(findings("kind = \"mirrors\"\nleft_eye_right_px = -960\n").size() == 1);
    CHECK(findings("kind = \"mirrors\"\nright_eye_down_px = 1080\n") ==
          Found{"the screen is 1080 px high: nothing of the picture would be left"});
    // An image that the screen holds, and its half does not.
    CHECK(findings("kind = \"mirrors\"\n",
                   "[display]\noutput = \"native-8bit\"\ngamma = 2.2\n[view]\nwidth_px = 1024\n"
                   "height_px = 512\n")
              .at(0) == "the image is 1024 px wide, the screen only 960 px");
    CHECK(findings("kind = \"mirrors\"\n", plain_screen, "[tracker]\nkind = \"opengaze\"\n") ==
          Found{"an Open Gaze tracker shows targets of its own, across both eyes' fields"});
    CHECK(findings("kind = \"mirrors\"\n", plain_screen,
                   "[[frames]]\nobject = \"a\"\nmaterial = \"gold\"\nfiles = \"f_##.png\"\n") ==
          Found{"ready-made frames are drawn for one eye, and [stereo] needs those of two"});
}

TEST_CASE("the disparity of a plane and a point is what their depths say", "[unit]") {
    Protocol protocol = through_mirrors("interocular_mm = 60\n");
    protocol.display.viewing_distance_mm = 1000.0;
    protocol.motions.front().kind = MotionKind::still;
    protocol.motions.front().frame_count = 1;
    // Two triangles that face the eyes, 100 before and 50 behind what the cameras look at, 1000 away.
    Mesh mesh;
    for (const float depth : {-100.0f, 50.0f})
        for (const glm::vec2 corner : {glm::vec2(-30, -30), glm::vec2(30, -30), glm::vec2(0, 30)})
            mesh.positions.emplace_back(corner.x, depth, corner.y);
    mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
    mesh.triangle_parts = {0, 0};
    mesh.part_names = {"all"};
    Object object;
    object.mesh = std::move(mesh);
    for (const double aside : {-30.0, 30.0}) {
        SceneView scene;
        scene.view.camera = {{0.0, -1000.0, 0.0}, {0.0, 0.0, 0.0}, {15.0}, aside};
        scene.view.image_px = {512, 512};
        scene.bounds = object.mesh->bounds();
        // A pixel is as large as on the screen: one unit in the plane of the target is 1 mm there.
        const ScreenGeometry screen = screen_geometry_of(protocol);
        const double px_per_mm = screen.screen_px.y / screen.screen_mm.y;
        scene.view.camera.vertical_fov = to_degrees({2.0 * std::atan(0.5 * 512.0 / px_per_mm / 1000.0)});
        object.scenes.push_back(scene);
    }
    const std::optional<DisparityRange> range = disparity_of(object, protocol);
    REQUIRE(range);
    // 60 mm / 900 mm - 60 mm / 1000 mm in radians, to the approximation of small angles.
    const double arcmin = 60.0 * 180.0 / std::numbers::pi;
    CHECK(range->nearest_arcmin == Approx((60.0 / 900.0 - 0.06) * arcmin).epsilon(0.002));
    CHECK(range->farthest_arcmin == Approx((0.06 - 60.0 / 1050.0) * arcmin).epsilon(0.002));
    CHECK(range->most() == range->nearest_arcmin);
    protocol.stereo.kind = StereoKind::none;
    CHECK_FALSE(disparity_of(object, protocol));
}
