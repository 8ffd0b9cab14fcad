#include "devices/lsl/lsl_known_apps.h"

#include <limits>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "tests/support/kept_items.h"

using namespace overt;
using Catch::Matchers::Contains;

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
using Channels = std::vector<LslChannel>;

/// What becomes of a sample of a program's stream, of both eyes on a screen of 1920 x 1080 px.
std::vector<GazeSample> seen(const std::string& stream, const Channels& channels,
                             const std::vector<double>& values, bool both_eyes = true,
                             LslLayoutSettings settings = {}) {
    TrackerWish wish;
    wish.both_eyes = both_eyes;
    const LslLayoutSettings known = with_known_app(std::move(settings), stream, channels).settings;
    test::KeptItems items;
    LslGazeLayout(channels, known, wish, stream).take(values, tracker_time(5), items);
    return items.all<GazeSample>();
}

void check_eye(const GazeSample& sample, std::optional<ScreenPoint> gaze, float pupil) {
    CHECK(sample.gaze.has_value() == gaze.has_value());
    if (sample.gaze && gaze) {
        CHECK(sample.gaze->x_px == Approx(gaze->x_px));
        CHECK(sample.gaze->y_px == Approx(gaze->y_px));
    }
    CHECK(sample.pupil_area == pupil);
}

LslChannel eyelink(const char* label) { return {label, "", "eyetracking", "", ""}; }
LslChannel gazepoint(const char* label, const char* unit, const char* type = "gaze") {
    return {label, "", type, unit, ""};
}

// As the programs' published sources have them.
const Channels of_eyelink = {eyelink("leftEyeX"),          eyelink("leftEyeY"),
                             eyelink("rightEyeX"),         eyelink("rightEyeY"),
                             eyelink("leftPupilArea"),     eyelink("rightPupilArea"),
                             eyelink("pixelsPerDegreeX"),  eyelink("pixelsPerDegreeY"),
                             eyelink("eyelink_timestamp"), eyelink("LSL_timestamp")};
const Channels of_gazepoint = {
    gazepoint("FPOGX", "percent"),          gazepoint("FPOGY", "percent"),
    gazepoint("FPOGV", "boolean"),          gazepoint("LPOGX", "percent"),
    gazepoint("LPOGY", "percent"),          gazepoint("LPOGV", "boolean"),
    gazepoint("RPOGX", "percent"),          gazepoint("RPOGY", "percent"),
    gazepoint("RPOGV", "boolean"),          gazepoint("BPOGX", "percent"),
    gazepoint("BPOGY", "percent"),          gazepoint("BPOGV", "boolean"),
    gazepoint("LPCX", "percent"),           gazepoint("LPD", "float", "diameter"),
    gazepoint("LPMM", "float", "diameter"), gazepoint("RPMM", "float", "diameter")};
const Channels of_tobii_pro = {
    {"left_x", "left", "ScreenX", "screencoords", ""},   {"left_y", "left", "ScreenY", "screencoords", ""},
    {"left_pupil", "left", "pupilsize", "", ""},         {"right_x", "right", "ScreenX", "screencoords", ""},
    {"right_y", "right", "ScreenY", "screencoords", ""}, {"right_pupil", "right", "pupilsize", "", ""}};
const Channels of_eyetech = {{"LeftEye_Found", "left", "Confidence", "normalized", ""},
                             {"LeftEye_PupilDiameter", "left", "Diameter", "mm", ""},
                             {"LeftEye_GazePoint_X", "left", "DirectionX", "percent", ""},
                             {"LeftEye_GazePoint_Y", "left", "DirectionY", "percent", ""},
                             {"RightEye_Found", "right", "Confidence", "normalized", ""},
                             {"RightEye_PupilDiameter", "right", "Diameter", "mm", ""},
                             {"RightEye_GazePoint_X", "right", "DirectionX", "percent", ""},
                             {"RightEye_GazePoint_Y", "right", "DirectionY", "percent", ""}};
const Channels of_smi = {{"Screen_X_left", "left", "ScreenX", "pixels", ""},
                         {"Screen_Y_left", "left", "ScreenY", "pixels", ""},
                         {"Screen_X_right", "right", "ScreenX", "pixels", ""},
                         {"Screen_Y_right", "right", "ScreenY", "pixels", ""},
                         {"Diameter_left", "left", "Diameter", "millimeters", ""},
                         {"Diameter_right", "right", "Diameter", "millimeters", ""}};
const Channels of_eyelogic = {{"FrameNumber", "", "FrameNumber", "number", ""},
                              {"Screen_X_raw", "both", "ScreenX", "pixels", "image-space"},
                              {"Screen_Y_raw", "both", "ScreenY", "pixels", "image-space"},
                              {"Screen_X_left", "left", "ScreenX", "pixels", "image-space"},
                              {"Screen_Y_left", "left", "ScreenY", "pixels", "image-space"},
                              {"Screen_X_right", "right", "ScreenX", "pixels", "image-space"},
                              {"Screen_Y_right", "right", "ScreenY", "pixels", "image-space"}};

} // namespace

TEST_CASE("App-EyeLink sends -32768 for a lost eye and 0 for one that is not measured", "[unit]") {
    const std::vector<double> both{100, 200, 300, 400, 900, 950, 30, 31, 5, 6};
    auto samples = seen("EyeLink", of_eyelink, both);
    REQUIRE(samples.size() == 2);
    check_eye(samples[0], ScreenPoint{100, 200}, 900.0f);
    check_eye(samples[1], ScreenPoint{300, 400}, 950.0f);
    samples = seen("as somebody calls it", of_eyelink, {0, 0, -32768, -32768, 0, 0, 30, 31, 5, 6});
    check_eye(samples[0], {}, 0.0f);
    check_eye(samples[1], {}, 0.0f);
    // One coordinate alone at the edge of the screen is gaze; one that is off it by a code is none.
    samples = seen("EyeLink", of_eyelink, {0, 200, -32768, 400, 900, -32768, 30, 31, 5, 6});
    check_eye(samples[0], ScreenPoint{0, 200}, 900.0f);
    check_eye(samples[1], {}, 0.0f);
}

TEST_CASE("LSLGazepoint calls shares of one percent, and tells by a flag whether there is gaze", "[unit]") {
    const auto samples = seen("Gazepoint", of_gazepoint,
                              {0.9, 0.9, 1, 0.25, 0.5, 1, 0.0, 0.0, 0, 0.4, 0.4, 1, 0.3, 20, 3.5, 4.5});
    REQUIRE(samples.size() == 2);
    check_eye(samples[0], ScreenPoint{480, 540}, 3.5f);
    check_eye(samples[1], {}, 4.5f);
    // A last value that stays with its flag down is no gaze, wherever it is.
    CHECK_FALSE(seen("g", of_gazepoint, {0.9, 0.9, 1, 0.25, 0.5, 0, 0.5, 0.5, nothing, 0, 0, 0, 0, 0, 0, 0})
                    .front()
                    .gaze);
    CHECK_FALSE(seen("g", of_gazepoint, {0.9, 0.9, 1, 0.25, 0.5, 0, 0.5, 0.5, nothing, 0, 0, 0, 0, 0, 0, 0})
                    .back()
                    .gaze);
}

TEST_CASE("App-TobiiPro and App-TobiiStreamEngine send shares of the screen", "[unit]") {
    auto samples = seen("Tobii", of_tobii_pro, {0.25, 0.75, 3.0, nothing, nothing, nothing});
    REQUIRE(samples.size() == 2);
    check_eye(samples[0], ScreenPoint{480, 810}, 3.0f);
    check_eye(samples[1], {}, 0.0f);
    samples = seen("TobiiStreamEngine", Channels(2), {0.5, 0.25}, false);
    REQUIRE(samples.size() == 1);
    check_eye(samples[0], ScreenPoint{960, 270}, 0.0f);
    CHECK_THROWS_WITH(seen("another", Channels(2), {0.5, 0.25}, false),
                      Contains("does not tell where on the screen"));
}

TEST_CASE("App-EyeTechDS tells per cent of the screen as a direction", "[unit]") {
    const auto samples = seen("EyeTechDS Data", of_eyetech, {1, 3.0, 25, 50, 0, 0, 60, 70});
    REQUIRE(samples.size() == 2);
    check_eye(samples[0], ScreenPoint{480, 540}, 3.0f);
    check_eye(samples[1], {}, 0.0f);
}

TEST_CASE("SMI's iViewX sends 0, 0 for a lost eye, and EyeLogic nothing", "[unit]") {
    auto samples = seen("iViewX", of_smi, {0, 0, 300, 400, 0, 4.0});
    REQUIRE(samples.size() == 2);
    check_eye(samples[0], {}, 0.0f);
    check_eye(samples[1], ScreenPoint{300, 400}, 4.0f);
    // The same channels of another program say nothing of zeros.
    CHECK(seen("other", of_smi, {0, 0, 300, 400, 0, 4.0}).front().gaze == ScreenPoint{0, 0});
    samples = seen("EyeLogic", of_eyelogic, {7, 10, 20, nothing, nothing, 30, 40});
    check_eye(samples[0], {}, 0.0f);
    check_eye(samples[1], ScreenPoint{30, 40}, 0.0f);
}

TEST_CASE("what the protocol says counts before what is known of a program", "[unit]") {
    LslLayoutSettings settings;
    settings.missing = {-1.0};
    settings.unit = StreamUnit::percent;
    settings.assignments = {parse_lsl_assignment("right x leftEyeX"),
                            parse_lsl_assignment("right y leftEyeY"), parse_lsl_assignment("right valid 9")};
    const auto look = [&](double x, double y, double valid) {
        return seen("EyeLink", of_eyelink, {x, y, 1, 1, 1, 1, 1, 1, valid, 1}, false, settings).front().gaze;
    };
    CHECK(look(50, 25, 1) == ScreenPoint{960, 270});
    CHECK(look(0, 0, 1) == ScreenPoint{0, 0});
    CHECK_FALSE(look(-1, 25, 1));
    CHECK_FALSE(look(50, 25, 0));
    CHECK(with_known_app({}, "EyeLink", of_eyelink).app == "App-EyeLink");
    CHECK(with_known_app({}, "EyeLink", of_smi).app.empty());
}

TEST_CASE("channels whose type is the whole stream's are told by their labels", "[unit]") {
    const Channels channels = {{"x", "", "screen", "percent", ""}, {"y", "", "screen", "percent", ""}};
    CHECK(seen("s", channels, {50, 100}, false).front().gaze == ScreenPoint{960, 1080});
    const Channels gaze = {{"gaze_x", "", "EyeTracking", "pixels", ""},
                           {"gaze_y", "", "EyeTracking", "pixels", ""}};
    CHECK(seen("s", gaze, {5, 6}, false).front().gaze == ScreenPoint{5, 6});
}
