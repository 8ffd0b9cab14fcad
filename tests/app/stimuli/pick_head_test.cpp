/// Outlining the head of a mesh: what clicks make of it, and the command in a window and without one.
#include <array>
#include <cstdio>
#include <memory>

#include <catch2/catch.hpp>

#include "app/stimuli/head_outline.h"
#include "experiment/scene/files/mesh_reader.h"
#include "tests/app/small_experiment.h"
#include "tests/experiment/protocol/protocol_fixtures.h"
#include "tests/support/running_program.h"
#include "tests/support/virtual_screen.h"

// Last: it defines words.
#include "tests/support/keyboard.h"

using namespace overt;
using namespace overt::test;
using Catch::Matchers::Contains;

namespace {

/// Of a protocol that has an object with this key besides.
ObjectSettings object_with_key(const std::string& key) {
    const ReadText read(minimal_protocol, "[[object]]\nid = \"b\"\nmesh = \"b.ply\"\n" + key + "\n");
    REQUIRE(read.lines().empty());
    return read.protocol->objects.back();
}

bool is_close(const glm::dvec3& a, const glm::dvec3& b) { return glm::distance(a, b) < 1e-9; }

} // namespace

TEST_CASE("two sides of a head are the ends of its sphere, and the neck cuts it across", "[unit]") {
    HeadOutline outline(7.0);
    CHECK_FALSE(outline.region());
    outline.pick({10.0, 0.0, 100.0});
    CHECK(outline.region()->spheres == std::vector{glm::dvec4(10.0, 0.0, 100.0, 7.0)});
    outline.pick({30.0, 0.0, 100.0});
    CHECK(outline.region()->spheres == std::vector{glm::dvec4(20.0, 0.0, 100.0, 10.0)});
    CHECK(outline.region()->half_spaces.empty());
    outline.pick({20.0, 0.0, 92.0});
    REQUIRE(outline.region()->half_spaces.size() == 1);
    CHECK(is_close(outline.region()->half_spaces[0].normal, {0.0, 0.0, 1.0}));
    CHECK(outline.region()->contains({20.0, 0.0, 93.0}));
    CHECK_FALSE(outline.region()->contains({20.0, 0.0, 91.0})); // within the sphere, below the neck
    // Another neck, larger, and all of it taken back.
    outline.pick({20.0, 0.0, 95.0});
    CHECK(is_close(outline.region()->half_spaces[0].point, {20.0, 0.0, 95.0}));
    outline.scale(1.5);
    CHECK(outline.region()->spheres[0].w == Approx(15.0));
    for (int i = 0; i < 3; ++i)
        outline.take_back();
    CHECK_FALSE(outline.region());
}

TEST_CASE("a head that is given stands until a point is picked, and again when it is taken back", "[unit]") {
    HeadOutline outline(7.0, PartRegion{"head", {glm::dvec4(1.0, 2.0, 3.0, 4.0)}, {}});
    outline.scale(2.0);
    CHECK(outline.region()->spheres == std::vector{glm::dvec4(1.0, 2.0, 3.0, 8.0)});
    outline.pick({0.0, 0.0, 0.0});
    CHECK(outline.region()->spheres == std::vector{glm::dvec4(0.0, 0.0, 0.0, 7.0)});
    outline.take_back();
    CHECK(outline.region()->spheres[0].x == 1.0);
    outline.take_back();
    CHECK_FALSE(outline.region());
}

TEST_CASE("a head turned and scaled with its mesh holds the same points", "[unit]") {
    const PartRegion head{"head", {glm::dvec4(1.0, 2.0, 3.0, 4.0)}, {{{0.0, 2.0, 0.0}, {0.3, 1.0, 0.2}}}};
    const glm::dmat3 turn = z_up_from_file(UpAxis::y);
    const PartRegion turned = transformed(head, turn, 25.4);
    int inside = 0;
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec3 point(i % 10 - 4, i / 10 % 10 - 3, i / 100 - 2);
        REQUIRE(turned.contains(25.4 * (turn * point)) == head.contains(point));
        inside += head.contains(point);
    }
    CHECK(inside > 50);
    const PartRegion back = transformed(turned, glm::transpose(turn), 1.0 / 25.4);
    CHECK(is_close(glm::dvec3(back.spheres[0]), {1.0, 2.0, 3.0}));
    CHECK(back.spheres[0].w == Approx(4.0));
}

TEST_CASE("the key that is printed is read as the same head", "[unit]") {
    const PartRegion head{"head",
                          {glm::dvec4(1.25, -2.5, 310.0, 48.0), glm::dvec4(0.0, 0.5, 1e-3, 2.0)},
                          {{{0.0, 0.0, 262.0}, {0.0, -0.6, 0.8}}}};
    const ObjectSettings read = object_with_key(head_key(head));
    REQUIRE(read.areas.size() == 1);
    CHECK(read.areas[0].name == "head");
    CHECK(read.areas[0].spheres ==
          std::vector<std::array<double, 4>>{{1.25, -2.5, 310.0, 48.0}, {0.0, 0.5, 1e-3, 2.0}});
    CHECK(read.areas[0].planes == std::vector<std::array<double, 6>>{{0.0, 0.0, 262.0, 0.0, -0.6, 0.8}});
}

TEST_CASE("a head that is given is drawn and printed; one that holds no triangle is refused", "[session]") {
    const SmallExperiment experiment;
    const std::filesystem::path picture = experiment.folder().path() / "head.png";
    const auto pick = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments{
            "pick-head", (experiment.folder().path() / "meshes/tall.ply").string(),
            "--context", "osmesa",
            "--picture", picture.string()};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return experiment.overt(arguments);
    };
    const ProgramRun given =
        pick({"--sphere", "0", "-15", "310", "60", "--plane", "0", "0", "261", "0", "0", "1"});
    INFO(given.err);
    CHECK(given.exit_code == 0);
    CHECK(std::filesystem::file_size(picture) > 1000);
    CHECK_THAT(given.out, Contains("% of the surface"));
    CHECK_THAT(given.out,
               Contains("head = { spheres = [[0, -15, 310, 60]], planes = [[[0, 0, 261], [0, 0, 1]]] }"));
    CHECK(pick({}).out.empty());
    const ProgramRun elsewhere = pick({"--sphere", "0", "0", "9000", "5"});
    CHECK(elsewhere.exit_code == 2);
    CHECK_THAT(elsewhere.err, Contains("no triangle lies in this head"));
    CHECK(pick({"--sphere", "0", "0", "300", "-5"}).exit_code == 2);
}

TEST_CASE("clicks on both sides of a head and on its neck outline it", "[session]") {
    const auto screen = VirtualScreen::start(1000, 1000, 24);
    const SmallExperiment experiment;
    const std::filesystem::path said = experiment.folder().path() / "said";
    std::vector<std::string> surroundings = x_server_alone;
    surroundings.push_back("OVERT_CACHE=" + experiment.cache().string());
    Display* const display = XOpenDisplay(nullptr);
    REQUIRE(display);
    int exit_code = -1;
    {
        RunningProgram program({"pick-head", (experiment.folder().path() / "meshes/tall.ply").string()},
                               surroundings, said);
        const Window window = await_window(display);
        REQUIRE(window != 0);
        XWindowAttributes look{};
        XGetWindowAttributes(display, window, &look);
        Keyboard hand(display, window);
        // The figure is 358 mm high and fills the picture but for a margin: top of the head, chin, neck.
        for (const double height : {0.11, 0.25, 0.30})
            hand.click(look.width / 2, static_cast<int>(height * look.height));
        for (int i = 0; i < 100 && program.is_running(); ++i) {
            hand.type(XK_Return);
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
        }
        exit_code = program.wait();
    }
    XCloseDisplay(display);
    const std::string text = text_of(said);
    INFO(text);
    CHECK(exit_code == 0);
    const std::size_t key = text.find("head = {");
    REQUIRE(key != std::string::npos);
    const ObjectSettings head = object_with_key(text.substr(key));
    REQUIRE(head.areas.size() == 1);
    REQUIRE(head.areas[0].spheres.size() == 1);
    REQUIRE(head.areas[0].planes.size() == 1);
    // The head is a ball about (0, -15, 310) with a radius of 48.
    CHECK(head.areas[0].spheres[0][2] == Approx(310.0).margin(15.0));
    CHECK(head.areas[0].spheres[0][3] == Approx(40.0).margin(15.0));
    CHECK(head.areas[0].planes[0][2] == Approx(258.0).margin(12.0));
    CHECK(head.areas[0].planes[0][5] > 0.8);
}
