#include "devices/lsl/lsl_gaze_layout.h"

#include <limits>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "tests/support/kept_items.h"

using namespace overt;
using Catch::Matchers::Contains;

namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

std::vector<GazeSample> samples_of(const LslGazeLayout& layout, const std::vector<double>& values) {
    test::KeptItems items;
    layout.take(values, tracker_time(5), items);
    return items.all<GazeSample>();
}

TrackerWish both() {
    TrackerWish wish;
    wish.both_eyes = true;
    return wish;
}

} // namespace

TEST_CASE("channels of gaze are told by their type, or by the words of their label", "[unit]") {
    const auto meaning = [](const char* label, const char* type = "") {
        return lsl_meaning({label, "", type, "", ""});
    };
    CHECK(meaning("whatever", "ScreenX") == LslMeaning::screen_x);
    CHECK(meaning("whatever", "Confidence") == LslMeaning::confidence);
    CHECK(meaning("LeftGazePointX") == LslMeaning::screen_x);
    CHECK(meaning("right_gaze_y") == LslMeaning::screen_y);
    CHECK(meaning("norm_pos_x") == LslMeaning::screen_x);
    CHECK(meaning("diameter0_3d") == LslMeaning::pupil);
    CHECK(meaning("PupilSizeLeft") == LslMeaning::pupil);
    CHECK(meaning("eye_center0_3d_x", "PositionX") == LslMeaning::position_x);
    CHECK_FALSE(meaning("gaze_point_3d_x", "PositionX"));
    CHECK_FALSE(meaning("gaze_normal0_x", "DirectionX"));
    CHECK_FALSE(meaning("gaze_point_3d_x"));
    CHECK_FALSE(meaning("gaze_origin_x"));
    CHECK_FALSE(meaning("PupilX"));
    CHECK_FALSE(meaning("head yaw"));
    CHECK(lsl_eye({"x", "left", "", "", ""}) == Eye::left);
    CHECK(lsl_eye({"LeftGazePointX", "", "", "", ""}) == Eye::left);
    CHECK(lsl_eye({"gaze_x_r", "", "", "", ""}) == Eye::right);
    CHECK(lsl_eye({"diameter0_3d", "", "", "", ""}) == Eye::right);
    CHECK_FALSE(lsl_eye({"left_x", "both", "", "", ""}));
    CHECK_FALSE(lsl_eye({"gaze_x", "", "", "", ""}));
}

TEST_CASE("shares of the screen and pixels both become px, and NaN is missing", "[unit]") {
    const LslGazeLayout layout({{"lx", "left", "ScreenX", "normalized", "screen"},
                                {"ly", "left", "ScreenY", "normalized", "screen"},
                                {"rx", "right", "ScreenX", "normalized", "screen"},
                                {"ry", "right", "ScreenY", "normalized", "screen"},
                                {"lp", "left", "Diameter", "mm", ""},
                                {"rp", "right", "Diameter", "mm", ""}},
                               {}, both(), "s");
    CHECK(layout.measures_both_eyes());
    const auto samples = samples_of(layout, {0.25, 0.75, 0.5, missing, 3.5, missing});
    REQUIRE(samples.size() == 2);
    CHECK(samples[0].eye == Eye::left);
    CHECK(samples[0].sampled_at == tracker_time(5));
    REQUIRE(samples[0].gaze);
    CHECK(samples[0].gaze->x_px == Approx(480.0));
    CHECK(samples[0].gaze->y_px == Approx(810.0));
    CHECK(samples[0].pupil_area == 3.5f);
    CHECK_FALSE(samples[1].gaze);
    CHECK(samples[1].pupil_area == 0.0f);
    const LslGazeLayout pixels(
        {{"x", "both", "ScreenX", "pixels", ""}, {"y", "both", "ScreenY", "pixels", ""}}, {}, both(), "s");
    CHECK_FALSE(pixels.measures_both_eyes());
    CHECK(samples_of(pixels, {100.0, 200.0}).front().gaze == ScreenPoint{100.0, 200.0});
    CHECK(samples_of(pixels, {100.0}).front().gaze == std::nullopt);
}

TEST_CASE("y may point upward, and gaze of little confidence is lost", "[unit]") {
    LslLayoutSettings settings;
    settings.y_is_up = true;
    settings.least_confidence = 0.6;
    const LslGazeLayout layout({{"x", "", "ScreenX", "normalized", ""},
                                {"y", "", "ScreenY", "normalized", ""},
                                {"c", "", "Confidence", "", ""},
                                {"eye_center_x", "", "PositionX", "m", ""},
                                {"eye_center_y", "", "PositionY", "m", ""},
                                {"eye_center_z", "", "PositionZ", "m", ""}},
                               settings, {}, "s");
    CHECK(samples_of(layout, {0.5, 0.75, 0.6, 0.0, 0.0, 0.0}).front().gaze == ScreenPoint{960.0, 270.0});
    CHECK_FALSE(samples_of(layout, {0.5, 0.75, 0.59, 0.0, 0.0, 0.0}).front().gaze);
    test::KeptItems items;
    layout.take(std::vector<double>{0.5, 0.5, 0.7, 0.01, -0.02, 0.65}, tracker_time(5), items);
    const SampleDetail detail = items.all<SampleDetail>().front();
    CHECK(detail.confidence == 0.7f);
    CHECK(*detail.eye_mm == glm::vec3(10.0f, -20.0f, 650.0f));
}

TEST_CASE("channels that tell nothing of themselves are assigned by label or number", "[unit]") {
    const std::vector<LslChannel> channels{{"a", "", "", "", ""}, {"", "", "", "", ""}, {"", "", "", "", ""}};
    CHECK_THROWS_WITH(LslGazeLayout(channels, {}, {}, "\"Tobii\""),
                      Contains("\"Tobii\" does not tell where on the screen the right eye looks") &&
                          Contains("1 \"a\" (no type), 2 \"\""));
    LslLayoutSettings settings;
    settings.assignments = {parse_lsl_assignment("right x 2"), parse_lsl_assignment(" right  y  a")};
    CHECK_THROWS_WITH(LslGazeLayout(channels, settings, {}, "s"), Contains("neither pixels nor normalized"));
    settings.unit = StreamUnit::normalized;
    const LslGazeLayout layout(channels, settings, {}, "s");
    CHECK(samples_of(layout, {0.1, 0.2, 0.3}).front().gaze == ScreenPoint{0.2 * 1920, 0.1 * 1080});
    settings.assignments.push_back(parse_lsl_assignment("pupil 4"));
    CHECK_THROWS_WITH(LslGazeLayout(channels, settings, {}, "s"), Contains("no channel \"4\""));
}

TEST_CASE("gaze in the picture of a head camera is not taken for gaze on the screen", "[unit]") {
    CHECK_THROWS_WITH(LslGazeLayout({{"norm_pos_x", "both", "ScreenX", "normalized", "world"},
                                     {"norm_pos_y", "both", "ScreenY", "normalized", "world"}},
                                    {}, {}, "s"),
                      Contains("camera that moves with the head"));
}

TEST_CASE("what an experimenter writes of a channel is eye, meaning and channel", "[unit]") {
    const LslAssignment assignment = parse_lsl_assignment("left eye-z Eye position (Z)");
    CHECK(assignment.meaning == LslMeaning::position_z);
    CHECK(assignment.eye == Eye::left);
    CHECK(assignment.label == "Eye position (Z)");
    CHECK_FALSE(parse_lsl_assignment("confidence 9").eye);
    for (const char* wrong : {"", "left", "left x", "x", "both x 3", "left depth 3"})
        CHECK_THROWS_WITH(parse_lsl_assignment(wrong), Contains("meanings are x, y, confidence, pupil"));
}
