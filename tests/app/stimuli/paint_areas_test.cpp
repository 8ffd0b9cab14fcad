/// Areas painted on a mesh: without a hand, by one in a window, and what a protocol makes of the file.
#include <cstdio>
#include <memory>

#include <catch2/catch.hpp>

#include "tests/app/small_experiment.h"
#include "tests/support/running_program.h"
#include "tests/support/virtual_screen.h"

// Last: it defines words.
#include "tests/support/keyboard.h"

using namespace overt;
using namespace overt::test;
using Catch::Matchers::Contains;

namespace {

/// Sides of the tall bust's head, a ball of radius 48 about (0, -15, 310).
const std::vector<std::string> left_side{"--area", "ear", "--dab", "ear", "-48", "-15", "310", "20"};

std::size_t count_of_label(const std::string& text, int label) {
    std::size_t count = 0;
    const std::string line = "\n" + std::to_string(label) + "\n";
    for (std::size_t at = text.find(line); at != std::string::npos;
         at = text.find(line, at + line.size() - 1))
        ++count;
    return count;
}

} // namespace

TEST_CASE("areas that are painted are those of the protocol that names the file", "[session]") {
    const SmallExperiment experiment;
    const std::filesystem::path meshes = experiment.folder().path() / "meshes";
    const auto paint = [&](std::vector<std::string> more) {
        std::vector<std::string> arguments{"paint-areas", (meshes / "tall.ply").string(), "--context",
                                           "osmesa"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return experiment.overt(arguments);
    };
    const std::filesystem::path picture = experiment.folder().path() / "ear.png";
    std::vector<std::string> first = left_side;
    first.insert(first.end(), {"--picture", picture.string(), "--turn", "90"});
    const ProgramRun one = paint(first);
    INFO(one.err << one.out);
    REQUIRE(one.exit_code == 0);
    CHECK(std::filesystem::file_size(picture) > 1000);
    CHECK_THAT(one.out, Contains("labels = \"" + (meshes / "tall_areas.txt").string() + "\""));
    // Those that the file has are there, too, and the new one was taken from the head.
    const std::string text = text_of(meshes / "tall_areas.txt");
    CHECK_THAT(text, Contains("# part 0 body\n# part 1 head\n# part 2 plinth\n# part 3 ear\n"));
    const std::size_t one_side = count_of_label(text, 3);
    CHECK(one_side > 3);
    // It is not replaced unasked; the other side is painted alike.
    CHECK(paint(left_side).exit_code == 2);
    CHECK(text_of(meshes / "tall_areas.txt") == text);
    const ProgramRun both = paint({"--labels", (meshes / "tall_areas.txt").string(), "--mirror", "ear"});
    INFO(both.err << both.out);
    REQUIRE(both.exit_code == 0);
    const std::size_t both_sides = count_of_label(text_of(meshes / "tall_areas.txt"), 3);
    CHECK(both_sides >= 2 * one_side - 2);
    CHECK(both_sides <= 2 * one_side + 2);

    experiment.folder().file("painted.toml",
                             with(small_protocol, "mesh = \"meshes/tall.ply\"\n",
                                  "mesh = \"meshes/tall.ply\"\nlabels = \"meshes/tall_areas.txt\"\n"));
    const ProgramRun check =
        experiment.overt({"check", (experiment.folder().path() / "painted.toml").string()});
    INFO(check.out << check.err);
    CHECK(check.exit_code == 0);
    CHECK_THAT(check.out, Contains("ear"));
}

TEST_CASE("areas that cannot be painted are refused before anything is written", "[session]") {
    const SmallExperiment experiment;
    const std::filesystem::path meshes = experiment.folder().path() / "meshes";
    const auto refused = [&](std::vector<std::string> more) {
        std::vector<std::string> arguments{"paint-areas", (meshes / "tall.ply").string(), "--context",
                                           "osmesa"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const ProgramRun run = experiment.overt(arguments);
        CHECK(run.exit_code == 2);
        CHECK_FALSE(std::filesystem::exists(meshes / "tall_areas.txt"));
        return run.err;
    };
    CHECK_THAT(refused({"--dab", "eye", "0", "0", "0", "5"}),
               Contains("there is no area \"eye\": there are head, plinth"));
    CHECK_THAT(refused({"--area", "eye/left", "--dab", "eye/left", "0", "0", "0", "5"}),
               Contains("--area \"eye/left\""));
    CHECK_THAT(refused({"--area", "body", "--dab", "body", "0", "0", "0", "5"}),
               Contains("what no area takes"));
    CHECK_THAT(refused({"--area", "eye", "--dab", "eye", "0", "0", "0", "0"}),
               Contains("the radius must be above 0"));
    CHECK_THAT(refused({"--area", "eye", "--out", (meshes / "x.label").string(), "--dab", "eye", "0", "0",
                        "0", "1"}),
               Contains("FreeSurfer"));
}

TEST_CASE("a hand paints with the left button, takes back, and saves with enter", "[session]") {
    const auto screen = VirtualScreen::start(1000, 1000, 24);
    const SmallExperiment experiment;
    const std::filesystem::path said = experiment.folder().path() / "said";
    std::vector<std::string> surroundings = x_server_alone;
    surroundings.push_back("OVERT_CACHE=" + experiment.cache().string());
    Display* const display = XOpenDisplay(nullptr);
    REQUIRE(display);
    int exit_code = -1;
    {
        RunningProgram program(
            {"paint-areas", (experiment.folder().path() / "meshes/tall.ply").string(), "--area", "face,neck"},
            surroundings, said);
        const Window window = await_window(display);
        REQUIRE(window != 0);
        XWindowAttributes look{};
        XGetWindowAttributes(display, window, &look);
        Keyboard hand(display, window);
        // The middle of the head, as area 3 (face), then as area 4 what is taken back.
        hand.type(XK_3);
        hand.click(look.width / 2, static_cast<int>(0.18 * look.height));
        hand.type(XK_Tab);
        hand.click(look.width / 2, static_cast<int>(0.45 * look.height));
        hand.type(XK_BackSpace);
        for (int i = 0; i < 100 && program.is_running(); ++i) {
            hand.type(XK_Return);
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
        }
        exit_code = program.wait();
    }
    XCloseDisplay(display);
    INFO(text_of(said));
    CHECK(exit_code == 0);
    const std::string text = text_of(experiment.folder().path() / "meshes/tall_areas.txt");
    CHECK_THAT(text, Contains("# part 3 face\n# part 4 neck\n"));
    CHECK(count_of_label(text, 3) > 3);
    CHECK(count_of_label(text, 4) == 0);
}
