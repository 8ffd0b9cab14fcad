#include "devices/lsl/lsl_gaze_layout.h"

#include <limits>

#include <catch2/catch.hpp>
#include <fmt/format.h>

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

TEST_CASE("places are in px by the unit that a stream tells or a protocol names, and eyes in mm", "[unit]") {
    const auto place = [](const char* unit, StreamUnit named, double x, double y) {
        LslLayoutSettings settings;
        settings.unit = named;
        const LslGazeLayout layout({{"x", "", "ScreenX", unit, ""}, {"y", "", "ScreenY", unit, ""}}, settings,
                                   {}, "s");
        return samples_of(layout, {x, y}).front().gaze.value();
    };
    for (const char* pixels : {"pixels", "px", "Pixel"})
        CHECK(place(pixels, StreamUnit::as_told, 10.0, 20.0) == ScreenPoint{10.0, 20.0});
    for (const char* shares : {"normalized", "normalised", "ScreenCoords"})
        CHECK(place(shares, StreamUnit::as_told, 0.5, 0.25) == ScreenPoint{960.0, 270.0});
    for (const char* percent : {"percent", "%"})
        CHECK(place(percent, StreamUnit::as_told, 50.0, 25.0) == ScreenPoint{960.0, 270.0});
    // What the protocol names holds whatever is told.
    CHECK(place("normalized", StreamUnit::px, 10.0, 20.0) == ScreenPoint{10.0, 20.0});
    CHECK(place("px", StreamUnit::normalized, 0.5, 0.5) == ScreenPoint{960.0, 540.0});
    CHECK(place("", StreamUnit::percent, 100.0, 100.0) == ScreenPoint{1920.0, 1080.0});
    CHECK_THROWS_AS(place("", StreamUnit::as_told, 0.5, 0.5), DeviceError);
    CHECK_THROWS_WITH(
        place("degrees", StreamUnit::as_told, 0.5, 0.5),
        "The stream s tells gaze in \"degrees\", which is neither pixels nor normalized nor percent; "
        "name the unit.");
    const auto eye_mm = [](const char* unit) {
        const LslGazeLayout layout({{"x", "", "ScreenX", "px", ""},
                                    {"y", "", "ScreenY", "px", ""},
                                    {"eye_x", "", "PositionX", unit, ""},
                                    {"eye_y", "", "PositionY", unit, ""},
                                    {"eye_z", "", "PositionZ", unit, ""}},
                                   {}, {}, "s");
        test::KeptItems items;
        layout.take(std::vector<double>{1.0, 2.0, 3.0, 4.0, 5.0}, tracker_time(5), items);
        return items.all<SampleDetail>().front().eye_mm.value();
    };
    CHECK(eye_mm("m") == glm::vec3(3000.0f, 4000.0f, 5000.0f));
    CHECK(eye_mm("meters") == glm::vec3(3000.0f, 4000.0f, 5000.0f));
    CHECK(eye_mm("cm") == glm::vec3(30.0f, 40.0f, 50.0f));
    CHECK(eye_mm("centimeters") == glm::vec3(30.0f, 40.0f, 50.0f));
    CHECK(eye_mm("mm") == glm::vec3(3.0f, 4.0f, 5.0f));
    CHECK(eye_mm("") == glm::vec3(3.0f, 4.0f, 5.0f));
}

TEST_CASE("numbers that stand for what is missing are missing, all together or off the screen", "[unit]") {
    LslLayoutSettings settings;
    settings.missing = {-1.0};
    const LslGazeLayout layout({{"x", "", "ScreenX", "px", ""},
                                {"y", "", "ScreenY", "px", ""},
                                {"p", "", "Diameter", "mm", ""},
                                {"eye_x", "", "PositionX", "mm", ""},
                                {"eye_y", "", "PositionY", "mm", ""},
                                {"eye_z", "", "PositionZ", "mm", ""}},
                               settings, {}, "s");
    struct Told {
        bool gaze, pupil, place;
        auto operator<=>(const Told&) const = default;
    };
    const auto told = [&](const std::vector<double>& values) {
        test::KeptItems items;
        layout.take(values, tracker_time(5), items);
        const GazeSample sample = items.all<GazeSample>().front();
        const auto details = items.all<SampleDetail>();
        return Told{sample.gaze.has_value(), sample.pupil_area != 0.0f,
                    !details.empty() && details[0].eye_mm.has_value()};
    };
    CHECK(told({10, 20, 3, 1, 2, 3}) == Told{true, true, true});
    CHECK(told({-1, -1, -1, -1, -1, -1}) == Told{false, false, false});
    CHECK(told({-1, 20, 3, -1, 2, 3}) ==
          Told{false, true, true}); // beside the screen, and a place for an eye
    CHECK(told({10, -1, 3, 1, -1, -1}) == Told{false, true, true});
    CHECK(told({-5, 20, 3, 1, 2, 3}) == Told{true, true, true}); // beside the screen, and told as that
    CHECK(told({10, 20, 3, missing, 2, 3}) == Told{true, true, false});
    CHECK(told({10, 20, missing, 1, 2, 3}) == Told{true, false, true});
    // 0 as a number that is missing may be the edge of the screen, where the other one is told.
    settings.missing = {0.0};
    const LslGazeLayout at_edge({{"x", "", "ScreenX", "px", ""}, {"y", "", "ScreenY", "px", ""}}, settings,
                                {}, "s");
    CHECK(samples_of(at_edge, {0.0, 20.0}).front().gaze == ScreenPoint{0.0, 20.0});
    CHECK_FALSE(samples_of(at_edge, {0.0, 0.0}).front().gaze);
    settings.missing = {1920.0, 1080.0};
    const LslGazeLayout at_far_edge({{"x", "", "ScreenX", "px", ""}, {"y", "", "ScreenY", "px", ""}},
                                    settings, {}, "s");
    CHECK(samples_of(at_far_edge, {1920.0, 20.0}).front().gaze == ScreenPoint{1920.0, 20.0});
    CHECK(samples_of(at_far_edge, {10.0, 1080.0}).front().gaze == ScreenPoint{10.0, 1080.0});
    CHECK_FALSE(samples_of(at_far_edge, {10.0, 1920.0}).front().gaze);
    CHECK_FALSE(samples_of(at_far_edge, {1920.0, 1080.0}).front().gaze);
}

TEST_CASE("each eye has its own channels, and what belongs to neither is both's", "[unit]") {
    const LslGazeLayout layout({{"lx", "left", "ScreenX", "px", ""},
                                {"ly", "left", "ScreenY", "px", ""},
                                {"x", "", "ScreenX", "px", ""},
                                {"y", "", "ScreenY", "px", ""},
                                {"lp", "left", "Diameter", "mm", ""},
                                {"p", "", "Diameter", "mm", ""},
                                {"lx2", "left", "ScreenX", "px", ""}},
                               {}, {.eye = Eye::left}, "s");
    CHECK_FALSE(layout.measures_both_eyes());
    auto samples = samples_of(layout, {1, 2, 3, 4, 5, 6, 7});
    REQUIRE(samples.size() == 1);
    CHECK(samples[0].eye == Eye::left);
    CHECK(samples[0].gaze == ScreenPoint{1.0, 2.0}); // of several the first
    CHECK(samples[0].pupil_area == 5.0f);
    samples = samples_of(layout, {1, 2, 3, 4, missing, 6, 7});
    CHECK(samples[0].pupil_area == 6.0f);
    const LslGazeLayout right({{"lx", "left", "ScreenX", "px", ""},
                               {"ly", "left", "ScreenY", "px", ""},
                               {"x", "", "ScreenX", "px", ""},
                               {"y", "", "ScreenY", "px", ""}},
                              {}, {.eye = Eye::right}, "s");
    samples = samples_of(right, {1, 2, 3, 4});
    REQUIRE(samples.size() == 1);
    CHECK(samples[0].eye == Eye::right);
    CHECK(samples[0].gaze == ScreenPoint{3.0, 4.0});
}

TEST_CASE("gaze is taken from the wished eye's channels before those of no eye, with their unit", "[unit]") {
    const std::vector<LslChannel> channels{{"x", "both", "ScreenX", "pixels", "screen"},
                                           {"y", "both", "ScreenY", "pixels", "screen"},
                                           {"lx", "left", "ScreenX", "percent", "screen"},
                                           {"ly", "left", "ScreenY", "normalized", "screen"}};
    TrackerWish wish;
    wish.eye = Eye::left;
    const std::vector<double> values{100.0, 200.0, 50.0, 0.25};
    CHECK(samples_of(LslGazeLayout(channels, {}, wish, "s"), values).at(0).gaze == ScreenPoint{960.0, 270.0});
    wish.eye = Eye::right;
    CHECK(samples_of(LslGazeLayout(channels, {}, wish, "s"), values).at(0).gaze == ScreenPoint{100.0, 200.0});
    // Without one of its coordinates an eye has no gaze of its own.
    wish.eye = Eye::left;
    auto without_y = channels;
    without_y[3].type = "Other";
    CHECK(samples_of(LslGazeLayout(without_y, {}, wish, "s"), values).at(0).gaze ==
          ScreenPoint{100.0, 200.0});
    auto of_world = channels;
    of_world[2].coordinate_system = "World camera";
    CHECK_THROWS_WITH(LslGazeLayout(of_world, {}, wish, "s"),
                      Contains("moves with the head (\"World camera\")"));
    wish.eye = Eye::right;
    CHECK_NOTHROW(LslGazeLayout(of_world, {}, wish, "s"));
    for (const std::size_t channel : {0u, 1u}) {
        auto unknown = channels;
        unknown[channel].unit = "furlongs";
        CHECK_THROWS_WITH(LslGazeLayout(unknown, {}, wish, "s"), Contains("neither pixels nor"));
    }
}

TEST_CASE("a channel is named by its label or its number from 1, and else refused with those that there are",
          "[unit]") {
    const std::vector<LslChannel> channels{{"a", "", "", "px", ""}, {"b", "", "T", "px", ""}};
    const auto x_of = [&](const std::string& name) {
        LslLayoutSettings settings;
        settings.assignments = {parse_lsl_assignment("x " + name), parse_lsl_assignment("y b")};
        return samples_of(LslGazeLayout(channels, settings, {}, "s"), {7.0, 8.0}).at(0).gaze->x_px;
    };
    CHECK(x_of("a") == 7.0);
    CHECK(x_of("1") == 7.0);
    CHECK(x_of("2") == 8.0);
    for (const char* const none : {"0", "3", "-1", "c", "1.0"})
        CHECK_THROWS_WITH(x_of(none),
                          Contains(fmt::format("The stream s has no channel \"{}\"; it has 1 \"a\" "
                                               "(no type), 2 \"b\" (T).",
                                               none)));
}
