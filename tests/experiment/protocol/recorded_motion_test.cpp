/// Motions that show again how observers of earlier sessions turned objects: their tables, and which trial
/// shows which.
#include <catch2/catch.hpp>

#include "experiment/design/recorded_trials.h"
#include "experiment/design/schedule.h"
#include "tests/experiment/protocol/protocol_fixtures.h"
#include "tests/support/temporary_folder.h"

using namespace overt;
using namespace overt::test;
using Catch::Contains;

namespace {

constexpr std::string_view yoked_protocol = R"([protocol]
name = "yoked"
[[motion]]
id = "again"
kind = "recorded"
recorded = ["way.tsv"]
[[object]]
id = "a"
shipped = "muse"
[[object]]
id = "b"
shipped = "runner"
[[material]]
id = "gold"
kind = "smooth-conductor"
[[task]]
id = "free"
question = "Look."
repetitions = 2
)";

/// A protocol, and the table of its recorded motion beside it.
struct WithCourses {
    WithCourses(std::string_view text, std::string_view table) {
        std::ofstream(folder.path() / "p.toml") << text;
        std::ofstream(folder.path() / "way.tsv") << table;
        protocol = read_protocol(folder.path() / "p.toml", shipped_names, diagnostics);
    }
    const MotionSettings& motion() const { return protocol->motions.front(); }

    TemporaryFolder folder;
    Diagnostics diagnostics;
    std::optional<Protocol> protocol;
};

std::string yoked_with(std::string_view keys) {
    std::string text(yoked_protocol);
    return text.insert(text.find("[[object]]"), keys);
}

/// Two observers; the first saw "a" twice and "b" once, the second each once.
constexpr std::string_view two_observers =
    "observer\tsession\ttrial\tslot\tobject\tt_s\tangle_deg\televation_deg\n"
    "P01\t1\t1\tcentre\ta\t0\t0\t0\n"
    "P01\t1\t1\tcentre\ta\t0.5\t2\t0\n"
    "P01\t1\t1\tcentre\ta\t1\t2\t0\n"
    "P01\t1\t2\tcentre\tb\t0\t2\t10\n"
    "P01\t1\t2\tcentre\tb\t2\t2\t10\n"
    "P01\t1\t3\tcentre\ta\t0\t-4\t0\n"
    "P01\t1\t3\tcentre\ta\t1.5\t-4\t0\n"
    "P02\t2\t1\tcentre\tb\t0\t0\t0\n"
    "P02\t2\t1\tcentre\tb\t1\t0\t0\n"
    "P02\t2\t2\tcentre\ta\t0\t6\t0\n"
    "P02\t2\t2\tcentre\ta\t1\t6\t0\n";

std::vector<std::string> yoked_of(const Protocol& protocol, int observer) {
    const Schedule schedule = make_schedule(protocol, {"P", observer}, 1);
    std::vector<std::string> shown;
    for (const Trial& trial : schedule.trials)
        shown.push_back(protocol.object_of(trial.stimulus).id + " " +
                        std::string(own_level(trial, yoked_to)));
    return shown;
}

} // namespace

TEST_CASE("a table of courses gives poses, and at each refresh the one that stood", "[unit]") {
    const WithCourses read(yoked_protocol, two_observers);
    INFO(read.diagnostics.print());
    REQUIRE(read.protocol);
    const MotionSettings& motion = read.motion();
    REQUIRE(motion.courses.size() == 5);
    CHECK_FALSE(motion.has_plan());
    CHECK(motion.frame_count == 5);
    CHECK(motion.duration_s == Approx(2.0)); // the longest
    CHECK(motion.object_in({1}) == ObjectPose{{2.0}});
    CHECK(motion.object_in({2}) == turned_and_tilted({2.0}, {10.0}));
    CHECK(elevation_of(motion.object_in({2})).value == Approx(10.0));
    const RecordedCourse& course = motion.courses.front();
    CHECK(course.name() == "P01 session 1 trial 1");
    CHECK(course.lasts_s == 1.0);
    CHECK(course.turns.size() == 2);
    CHECK(course.frame_at(0, 120.0).value == 0);
    CHECK(course.frame_at(59, 120.0).value == 0);
    CHECK(course.frame_at(60, 120.0).value == 1);
    CHECK(course.frame_at(5000, 120.0).value == 1); // after its end it stands
    CHECK(course.frame_at(29, 60.0).value == 0);
    CHECK(course.frame_at(30, 60.0).value == 1);
    // Times to a microsecond: the third refresh at 120 Hz.
    RecordedCourse rounded;
    rounded.turns = {{0.0, {0}}, {0.016667, {1}}};
    CHECK(rounded.frame_at(1, 120.0).value == 0);
    CHECK(rounded.frame_at(2, 120.0).value == 1);
    CHECK(read.protocol->included.size() == 1); // so the record has its text
}

TEST_CASE("a trial shows again one with its stimulus, in the order of the recording, of the observer's own "
          "forerunner",
          "[unit]") {
    const WithCourses read(yoked_protocol, two_observers);
    REQUIRE(read.protocol);
    std::vector<std::string> first = yoked_of(*read.protocol, 1);
    REQUIRE(first.size() == 4);
    std::vector<std::string> of_a;
    for (const std::string& one : first)
        if (one.starts_with("a"))
            of_a.push_back(one);
        else
            CHECK(one == "b P01 session 1 trial 2"); // both times the only one
    CHECK(of_a == std::vector<std::string>{"a P01 session 1 trial 1", "a P01 session 1 trial 3"});
    for (const std::string& one : yoked_of(*read.protocol, 2))
        CHECK(one == (one.starts_with("a") ? "a P02 session 2 trial 2" : "b P02 session 2 trial 1"));
    for (const std::string& one : yoked_of(*read.protocol, 3))
        CHECK(one.find("P01") != std::string::npos); // in turn
    // A trial has the course of its slot, and of a further show the next, or the last.
    Trial trial = make_schedule(*read.protocol, {"P", 2}, 1).trials.front();
    REQUIRE(course_of(*read.protocol, trial, 0, 0));
    CHECK(course_of(*read.protocol, trial, 0, 0) == course_of(*read.protocol, trial, 0, 3));
    trial.levels.clear();
    CHECK_FALSE(course_of(*read.protocol, trial, 0, 0));
}

TEST_CASE("by their numbers trials show again those with the same ones", "[unit]") {
    const std::string text = yoked_with("matched_by = \"trial\"\n");
    std::string table = "trial\tslot\tt_s\tangle_deg\n";
    for (int trial = 1; trial <= 4; ++trial)
        table += fmt::format("{0}\tcentre\t0\t{0}\n{0}\tcentre\t1\t{0}\n", trial);
    const WithCourses read(text, table);
    INFO(read.diagnostics.print());
    REQUIRE(read.protocol);
    const Schedule schedule = make_schedule(*read.protocol, {"P", 1}, 1);
    for (const Trial& trial : schedule.trials) // of a table without observers: its file's name
        CHECK(own_level(trial, yoked_to) == fmt::format("way session 1 trial {}", trial.index + 1));
    const WithCourses few(text, table.substr(0, table.find("4\t")));
    CHECK_FALSE(few.protocol);
    CHECK_THAT(
        few.diagnostics.print(),
        Contains("p.toml:6:12: error: trial 4 shows motion \"again\" in slot \"centre\", and way session "
                 "1 has no such trial there (observer 1)"));
}

TEST_CASE("what was not recorded cannot be shown again, and a protocol may say which trial is", "[unit]") {
    const WithCourses read(yoked_protocol, "trial\tslot\tobject\tt_s\tangle_deg\n"
                                           "1\tcentre\ta\t0\t0\n1\tcentre\ta\t1\t0\n");
    CHECK_FALSE(read.protocol);
    CHECK_THAT(read.diagnostics.print(),
               Contains("p.toml:6:12: error: \"b, gold\" is shown in slot \"centre\", and "
                        "way session 1 has no trial with it there (observer 1)"));
    Trial trial;
    trial.levels = {{std::string(yoked_to), "way session 1 trial 1"}};
    Protocol protocol;
    protocol.objects.resize(1);
    protocol.materials.resize(1);
    protocol.motions.front().kind = MotionKind::recorded;
    protocol.motions.front().courses = {{"way session 1", 1, protocol.slots.front().id, {}, {{}}, 1.0}};
    CHECK_FALSE(yoke(protocol, 1, std::span(&trial, 1)));
    CHECK(trial.levels.size() == 1);
    trial.levels.front().level = "way session 1 trial 2";
    CHECK(yoke(protocol, 1, std::span(&trial, 1)));
}

TEST_CASE("a table of courses is refused where it is wrong, all at once", "[unit]") {
    const auto told = [](std::string_view table) {
        return WithCourses(yoked_protocol, table).diagnostics.print();
    };
    CHECK_THAT(told("trial\tt_s\n1\t0\n"),
               Contains("way.tsv:1:1: error: the table has no column slot") &&
                   Contains("way.tsv:1:1: error: the table has no column angle_deg"));
    CHECK_THAT(told("trial\tslot\tt_s\tangle_deg\televation_deg\n1.5\tcentre\t0\t0\t0\n"
                    "1\tcentre\t-1\tmuch\t91\n"),
               Contains("way.tsv:2:1: error: trial: 1.5 is no whole number") &&
                   Contains("way.tsv:3:10: error: t_s is -1, which is outside 0 … 3600") &&
                   Contains("way.tsv:3:13: error: angle_deg: \"much\" is no number") &&
                   Contains("way.tsv:3:18: error: elevation_deg is 91, which is outside -90 … 90"));
    CHECK_THAT(
        told("trial\tslot\tt_s\tangle_deg\n1\tcentre\t0\t0\n1\tcentre\t1\t0\n1\tcentre\t1\t0\n"
             "2\tcentre\t0.1\t0\n"),
        Contains("way.tsv:4:10: error: t_s goes from 1 to 1: times have to rise") &&
            Contains("way.tsv:5:10: error: the first row of way session 1 trial 2 in slot \"centre\" is not "
                     "at t_s = 0"));
    CHECK_THAT(
        WithCourses(std::string(yoked_protocol).replace(yoked_protocol.find("way.tsv"), 7, "none.tsv"), "")
            .diagnostics.print(),
        Contains("p.toml:6:12: error: recorded \"none.tsv\""));
    CHECK_THAT(WithCourses(yoked_with("amplitude_deg = 3\n"), two_observers).diagnostics.print(),
               Contains("p.toml:7:17: error: \"amplitude_deg\" says nothing of a motion that was recorded"));
    CHECK_THAT(
        WithCourses(yoked_with("duration_s = 1\n"), two_observers).diagnostics.print(),
        Contains("p.toml:7:14: warning: \"again\" is shown for 1 s, and was recorded for 1.000 … 2.000 s"));
}
