/// `overt display stereo`: what a stereoscope is set up by.
#include <catch2/catch.hpp>

#include "render/image/linear_image.h"
#include "tests/app/two_eyed_experiment.h"
#include "tests/support/running_program.h"
#include "tests/support/virtual_screen.h"

// Last: it defines words.
#include "tests/support/keyboard.h"

using namespace overt;
using namespace overt::test;
using Catch::Matchers::Contains;

TEST_CASE("the fields of a stereoscope are drawn, each with what its eye alone sees", "[session]") {
    const SmallExperiment experiment(
        with(two_eyed("left"), "kind = \"mirrors\"\n", "kind = \"mirrors\"\nright_eye_right_px = 6\n"));
    const std::filesystem::path file = experiment.folder().path() / "fields.png";
    const ProgramRun drawn =
        experiment.overt({"display", "stereo", experiment.protocol().string(), "--picture", file.string()});
    INFO(drawn.err);
    REQUIRE(drawn.exit_code == 0);
    const LinearImage picture = read_linear_image(file, FrameEncoding::srgb);
    CHECK(picture.size_px == glm::ivec2(544, 192));
    const auto is_lit = [&](int x, int y) { return picture.at(x, y).x > 0.2f; };
    // Each field is 272 wide: the crosses are in the middles, that of the right eye 6 px farther to the
    // right.
    CHECK(is_lit(136, 96));
    CHECK(is_lit(272 + 136 + 6, 96));
    CHECK_FALSE(is_lit(272 + 136, 96 - 20));
    // Above the cross the left eye has its half of the upright line, below it the right eye.
    const int reach = 25;
    CHECK(is_lit(136, 96 - reach));
    CHECK_FALSE(is_lit(136, 96 + reach));
    CHECK(is_lit(272 + 136 + 6, 96 + reach));
    CHECK_FALSE(is_lit(272 + 136 + 6, 96 - reach));
    CHECK(is_lit(136 - reach, 96));
    CHECK_FALSE(is_lit(136 + reach, 96));
}

TEST_CASE("who has no [stereo] is told so, and no picture is written", "[session]") {
    const SmallExperiment experiment;
    const std::filesystem::path file = experiment.folder().path() / "fields.png";
    const ProgramRun refused =
        experiment.overt({"display", "stereo", experiment.protocol().string(), "--picture", file.string()});
    CHECK(refused.exit_code == 2);
    CHECK_THAT(refused.err, Contains("both eyes see the same") && Contains("[stereo]"));
    CHECK_FALSE(std::filesystem::exists(file));
}

TEST_CASE("arrows move the fields of a stereoscope, and the keys for the protocol are printed", "[session]") {
    const auto screen = VirtualScreen::start(1000, 600, 24);
    const SmallExperiment experiment(two_eyed("left"));
    std::vector<std::string> surroundings = x_server_alone;
    surroundings.push_back("OVERT_CACHE=" + experiment.cache().string());
    for (const bool keeps : {true, false}) {
        CAPTURE(keeps);
        const std::filesystem::path said = experiment.folder().path() / "said";
        Display* const display = XOpenDisplay(nullptr);
        REQUIRE(display);
        int exit_code = -1;
        {
            RunningProgram program({"display", "stereo", experiment.protocol().string(), "--windowed"},
                                   surroundings, said);
            const Window window = await_window(display);
            REQUIRE(window != 0);
            Keyboard hand(display, window);
            hand.type(XK_Right);
            hand.type(XK_Right);
            hand.type(XK_Down);
            for (int i = 0; i < 200 && program.is_running(); ++i) {
                std::this_thread::sleep_for(std::chrono::milliseconds(100));
                hand.type(keeps ? XK_Return : XK_Escape);
            }
            exit_code = program.wait();
        }
        XCloseDisplay(display);
        INFO(text_of(said));
        CHECK(exit_code == 0);
        CHECK_THAT(text_of(said),
                   Contains(keeps ? "[stereo]\nkind = \"mirrors\"\nleft_eye_right_px = -4\n"
                                    "left_eye_down_px = 2\nright_eye_right_px = 4\nright_eye_down_px = 0\n"
                                  : "left_eye_right_px = 0\nleft_eye_down_px = 0\nright_eye_right_px = 0\n"));
    }
}
