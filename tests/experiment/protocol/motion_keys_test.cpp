#include <catch2/catch.hpp>

#include "tests/experiment/protocol/protocol_fixtures.h"
#include "tests/support/temporary_folder.h"

using namespace overt;
using namespace overt::test;
using Catch::Contains;

namespace {

/// A protocol with a motion and the table beside it.
struct WithTable {
    WithTable(std::string_view keys, std::string_view table) {
        std::ofstream(folder.path() / "p.toml") << minimal_protocol << "[animation]\nkind = \"keyframes\"\n"
                                                << "keyframes = \"way.csv\"\n"
                                                << keys;
        std::ofstream(folder.path() / "way.csv") << table;
        protocol = read_protocol(folder.path() / "p.toml", shipped_names, diagnostics);
    }
    const Animation& motion() const { return protocol->motions.front(); }

    TemporaryFolder folder;
    Diagnostics diagnostics;
    std::optional<Protocol> protocol;
};

std::vector<std::string> motion_lines(std::string_view keys) {
    return ReadText(minimal_protocol, std::string("[animation]\n").append(keys)).lines();
}

} // namespace

TEST_CASE("a table of places says how object and light stand in each frame", "[unit]") {
    const WithTable read("playback = \"ping-pong\"\nframe_rate_hz = 10\n",
                         "t_s,x,y,z,angle_deg,light_deg\n0,0,0,0,0,0\n1,10,0,-4,90,0\n2,10,0,-4,90,200\n");
    CHECK(read.diagnostics.print() == "");
    REQUIRE(read.protocol);
    const Animation& motion = read.motion();
    CHECK(motion.frame_count == 21);
    CHECK(motion.object_in({0}) == ObjectPose{});
    CHECK(motion.object_in({5}).shift == glm::dvec3(5.0, 0.0, -2.0));
    CHECK(motion.object_in({5}).angle.value == Approx(45.0));
    CHECK(motion.object_in({10}).angle.value == Approx(90.0));
    CHECK(motion.pose_of({15}).light.value == Approx(100.0));
    CHECK(motion.pose_of({20}).light.value == Approx(-160.0));
    CHECK(read.protocol->included.size() == 1); // so the record has its text

    const WithTable steps("playback = \"ping-pong\"\nframe_rate_hz = 10\nbetween = \"step\"\n",
                          "t_s;angle_deg\n0;0\n0,5;-30\n1;15\n");
    REQUIRE(steps.protocol);
    CHECK(steps.motion().angle_of({4}).value == 0.0);
    CHECK(steps.motion().angle_of({5}).value == -30.0);
    CHECK(steps.motion().angle_of({9}).value == -30.0);
    CHECK(steps.motion().angle_of({10}).value == 15.0);
    CHECK(steps.motion().pictures().size() == 3);
}

TEST_CASE("rotations of a table go the shortest way, and a way that closes is a loop", "[unit]") {
    // Identity, a quarter of a turn about x, and back; written with either sign.
    const WithTable read("frame_rate_hz = 10\n",
                         "t_s,qw,qx,qy,qz\n0,1,0,0,0\n0.4,-0.70710678,-0.70710678,0,0\n"
                         "0.8,1,0,0,0\n");
    CHECK(read.diagnostics.print() == "");
    REQUIRE(read.protocol);
    const Animation& motion = read.motion();
    CHECK(motion.frame_count == 9);
    CHECK(motion.object_in({1}).tilt.x == Approx(0.195090).epsilon(1e-5));
    CHECK(motion.object_in({4}).tilt.x == Approx(0.707107).epsilon(1e-5));
    CHECK(motion.pose_of({8}) == motion.pose_of({0}));
    CHECK(motion.pictures().size() == 5);
    CHECK(motion.frame_at_step(8).value == 0);
}

TEST_CASE("a table of places is refused where it is wrong, all at once", "[unit]") {
    const WithTable read("frame_rate_hz = 10\n", "t_s,qw,qx,qy,speed\n0.1,1,0,0,2\n0.1,much,0,0,3\n");
    CHECK_FALSE(read.protocol);
    CHECK_THAT(read.diagnostics.print(),
               Contains("way.csv:1:14: error: there is no column \"speed\"") &&
                   Contains("way.csv:1:1: error: a rotation is of the four columns") &&
                   Contains("way.csv:3:5: error: qw: \"much\" is no number"));
    const WithTable open("frame_rate_hz = 10\n", "t_s,angle_deg\n0,0\n1,10\n");
    CHECK_THAT(open.diagnostics.print(), Contains("way.csv:3:1: error: the last place is not the first"));
    const WithTable back("frame_rate_hz = 10\n", "t_s,angle_deg\n0.5,0\n0.2,0\n");
    CHECK_THAT(back.diagnostics.print(), Contains("way.csv:2:1: error: the first row is not at t_s = 0") &&
                                             Contains("way.csv:3:1: error: t_s goes from 0.5 to 0.2"));
    const WithTable long_one("frame_rate_hz = 10\n", "t_s,qw,qx,qy,qz\n0,2,0,0,0\n1,1,0,0,0\n");
    CHECK_THAT(long_one.diagnostics.print(), Contains("way.csv:2:3: error: a rotation of length 2"));
    CHECK(motion_lines("kind = \"keyframes\"\nkeyframes = \"none.csv\"\n").size() == 1);
    CHECK(motion_lines("kind = \"keyframes\"\n") ==
          std::vector<std::string>{"13:8: a motion of kind \"keyframes\" needs the table of its places"});
}

TEST_CASE("keys that a kind needs, or has no use for, are told at their place", "[unit]") {
    CHECK(motion_lines("kind = \"turntable\"\n").empty());
    CHECK(motion_lines("kind = \"turntable\"\nturns = 0\n") ==
          std::vector<std::string>{"14:9: no turn at all: turns is 0"});
    CHECK(
        motion_lines("kind = \"turntable\"\namplitude_deg = 5\n") ==
        std::vector<std::string>{"14:17: \"amplitude_deg\" has no effect on a motion of kind \"turntable\""});
    CHECK(motion_lines("kind = \"steps\"\n").front() ==
          "13:8: a motion of kind \"steps\" needs the angles where it stands");
    CHECK(motion_lines("kind = \"steps\"\nangles_deg = [0, 10, 20, 30, 40, 50, 60]\n").front() ==
          "14:14: 61 frames, of which the last is the first again, are not divided evenly among 7 angles");
    CHECK(motion_lines("kind = \"steps\"\nangles_deg = [0, 10, 20]\n").empty());
    CHECK(motion_lines("kind = \"waves\"\n").size() == 1);
    CHECK(motion_lines("kind = \"waves\"\nwaves = [[20, 1, 0], [5, 3, 90]]\n").empty());
    CHECK(motion_lines("kind = \"waves\"\nwaves = [20, 1.5, 0]\n").front() ==
          "14:9: a sine of 1.5 periods in all frames does not close the loop");
    CHECK(motion_lines("axis = [0, 0, 0]\n").front() == "13:8: an axis of length 0 points nowhere");
    CHECK(motion_lines("kind = \"approach\"\n").size() == 1);
    CHECK(motion_lines("kind = \"approach\"\napproach_mm = 20\n").empty());
    CHECK(motion_lines("kind = \"trapezoid\"\nrest_share = 0.3\nease = \"minimum-jerk\"\n").empty());
    CHECK(motion_lines("kind = \"orbit\"\naxis = [1, 0, 0]\n").size() == 1);
    CHECK(motion_lines("kind = \"still\"\nlight_turns = 1\n").empty());
}

TEST_CASE("what the observer turns and tilts has a frame for each turn at each elevation", "[unit]") {
    const std::string turned = "kind = \"observer\"\nstep_deg = 10\nfrom_deg = -30\nto_deg = 30\n";
    const ReadText tilted(minimal_protocol,
                          "[animation]\n" + turned +
                              "elevation_step_deg = 5\nelevation_from_deg = -10\nelevation_to_deg = 20\n");
    CHECK(tilted.lines().empty());
    REQUIRE(tilted.protocol);
    const MotionSettings& motion = tilted.protocol->motions.front();
    CHECK(motion.frame_count == 7 * 7);
    CHECK(motion.pictures().size() == 49);
    CHECK(motion.by_observer.keys == std::vector<std::string>{"left", "right", "up", "down"});
    CHECK_FALSE(motion.only_turns());
    CHECK(motion_lines(turned + "elevation_to_deg = 20\n").front() ==
          "17:20: \"elevation_to_deg\" says how far it is tilted, and nothing in which steps");
    CHECK(motion_lines(turned + "elevation_step_deg = 7\nelevation_to_deg = 20\n").front() ==
          "17:22: from 0 to 20 deg are 2.85714 steps of 7 deg, which is no whole number");
    CHECK(motion_lines(turned + "elevation_step_deg = 5\nelevation_to_deg = -20\n").front() ==
          "18:20: it can be tilted from 0 to -20 deg");
    CHECK(motion_lines(turned + "with = \"keys\"\nelevation_step_deg = 5\nelevation_to_deg = 20\n"
                                "keys = [\"left\", \"right\"]\n")
              .front() == "20:8: an object is turned and tilted with four keys");
    CHECK(
        motion_lines("kind = \"observer\"\nstep_deg = 0.1\nelevation_step_deg = 0.1\nelevation_to_deg = 20\n")
            .back() == "15:22: 3600 turns at 201 elevations are 723600 poses, and a motion has up to 10000");
    CHECK(motion_lines("kind = \"turn\"\nelevation_step_deg = 5\n").front() ==
          "14:22: \"elevation_step_deg\" is for a motion of kind \"observer\"");
}
