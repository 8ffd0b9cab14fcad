/// Steps that cannot be run are errors at their places, all at once.
#include <catch2/catch.hpp>

#include "tests/experiment/protocol/protocol_fixtures.h"

using namespace overt;
using namespace overt::test;

using Lines = std::vector<std::string>;

namespace {

/// A task of a minimal protocol with these steps, each on a line of its own, the first in line 17.
Lines lines_of(const std::string& steps) {
    return ReadText(minimal_protocol,
                    "\n[[task]]\nid = \"t\"\nquestion = \"Look.\"\nsteps = [\n" + steps + "\n]\n")
        .lines();
}

} // namespace

TEST_CASE("steps are read with their durations, places and waits", "[unit]") {
    const ReadText read(minimal_protocol, R"(
[[task]]
id = "t"
question = "Look."
steps = [
  { text = "Now: {question}", id = "words" },
  { fixation = { from = 0.5, to = 1.0 }, right_deg = 2, up_deg = -1 },
  { fixation = { until = { gaze_within_deg = 1.5, for_s = 0.1, patience_s = 5, otherwise = "drift-check" } } },
  { show = "centre", for_s = 2, until = { gaze_on = "head", patience_s = 8, key = true } },
  { blank = [0.5, 2.0, 8.0] },
  { mask = { from = 0.1, to = 0.9, mean = 0.3 }, cell_deg = 0.5 },
  { answer = "spoken", limit_s = 4 },
  { feedback = { answered = "Thank you", missed = "Too slow" }, for_s = 1 },
]
)");
    CHECK(read.lines() == Lines{});
    REQUIRE(read.protocol);
    const std::vector<StepSettings>& steps = read.protocol->tasks.back().steps;
    REQUIRE(steps.size() == 8);
    CHECK(steps[0].kind == StepKind::text);
    CHECK(steps[0].text == "Now: {question}");
    CHECK(steps[0].id == "words");
    CHECK(steps[1].duration->law == StepDuration::Law::uniform);
    CHECK(steps[1].up_deg == -1.0);
    REQUIRE(steps[2].gaze);
    CHECK(steps[2].gaze->within_deg == 1.5);
    CHECK(steps[2].gaze->for_s == 0.1);
    CHECK(steps[2].gaze->blink_s == 0.3);
    CHECK(steps[2].gaze->otherwise == GazeMissed::drift_check);
    CHECK_FALSE(steps[2].duration);
    CHECK(steps[3].gaze->area == "head");
    CHECK(steps[3].ends_by_key);
    CHECK(steps[3].duration->choices_s == std::vector<double>{2.0});
    CHECK(steps[4].duration->law == StepDuration::Law::one_of);
    CHECK(steps[5].duration->mean_s == 0.3);
    CHECK(steps[5].cell_deg == 0.5);
    CHECK(steps[6].duration->longest_s() == 4.0);
    CHECK(steps[7].missed == "Too slow");
}

TEST_CASE("what is wrong with a step is said at its place, and all of it at once", "[unit]") {
    const Lines found = lines_of(R"(  { fixtion = 0.5 },
  { blank = 0 },
  { blank = -1 },
  { blank = 0.5, mask = 0.5 },
  { blank = 0.5, colour = "red" },
  { fixation = { from = 1.0, to = 0.5 } },
  { fixation = { from = 0.5, to = 1.0, mean = 0.9 } },
  { answer = "spoken" },
  { show = "centre", until = "soon" },
  { show = "centre", until = { for_s = 1 } },
  0.5,)");
    CHECK(found ==
          Lines{"17:3: no kind of step is named here", "18:13: blank: a step of 0 s shows nothing",
                "19:13: blank: a step of -1 s shows nothing",
                "20:18: a step is one kind, and this one is \"blank\" already",
                "21:18: a step \"blank\" has no key \"colour\"",
                "22:16: fixation: from 1 to 0.5 s there is nothing to draw",
                "23:47: fixation: the mean of 0.9 s does not lie between 0.5 s and the middle, 0.75 s",
                "25:30: until: unknown value \"soon\"", "26:30: until: nothing says where gaze is waited for",
                "27:3: steps: expected a step such as { blank = 0.5 }, found a number"});
}

TEST_CASE("steps that could not go together are found where they stand", "[unit]") {
    CHECK(
        lines_of(
            "  { fixation = 0.5, id = \"a\" },\n  { blank = 0.5, id = \"a\" },\n  { show = \"centre\" },") ==
        Lines{"18:23: step id \"a\" is used twice, first in line 17"});
    CHECK(lines_of("  { fixation = 0.5 },") == Lines{"17:3: no step of task t shows the stimulus"});
    CHECK(lines_of("  { show = \"centre\" },\n  { show = \"centre\" },") == Lines{});
    CHECK(lines_of("  { show = \"left\" },") == Lines{"17:3: unknown slot \"left\""});
    CHECK(lines_of("  { fixation = { until = { gaze_within_deg = 1 } } },\n  { show = \"centre\" },") ==
          Lines{"17:3: this step never ends for an observer who does not look there"});
    CHECK(lines_of("  { show = \"centre\" },\n  { answer = \"spoken\" },\n  { feedback = { answered = "
                   "\"Yes\" } },") == Lines{"19:3: this step feedback never ends"});
    CHECK(lines_of("  { feedback = { answered = \"Yes\" }, for_s = 1 },\n  { show = \"centre\" },") ==
          Lines{"17:3: there is no answer yet that feedback could be about"});
    CHECK(lines_of("  { show = \"centre\" },\n  { answer = \"spoken\" },\n  { feedback = {}, for_s = 1 },") ==
          Lines{"19:16: feedback: neither words nor a tone are given"});
    CHECK(lines_of("  { show = \"centre\" },\n  { answer = \"spoken\" },\n  { feedback = { tone = true }, "
                   "for_s = 1 },")
              .empty());
    CHECK(lines_of("  { show = \"centre\", frame = 61 },") == Lines{"17:30: frame: there is no frame 61"});
    CHECK(
        lines_of(
            "  { fixation = { until = { gaze_within_deg = 1, patience_s = 2 } } },\n  { text = \"Go on\" },\n"
            "  { show = \"centre\" },") == Lines{"17:3: no gaze is recorded during this step"});
    CHECK(lines_of("  { blank = 0.5, until = { gaze_on = \"head\" } },\n  { show = \"centre\" },") ==
          Lines{"17:38: a step blank shows no head"});
}

TEST_CASE("a step shows some of the task's slots, and slots of one place are never shown at once", "[unit]") {
    const auto lines = [](const std::string& slots, const std::string& steps) {
        std::string places;
        for (const auto& [id, right] : {std::pair("first", 0), std::pair("second", 0), std::pair("left", -5)})
            places += std::string("[[slot]]\nid = \"") + id + "\"\nright_deg = " + std::to_string(right) +
                      "\nsize_deg = 4\n";
        return ReadText(std::string(minimal_protocol) + "slots = \"left\"\n",
                        "[[task]]\nid = \"t\"\nquestion = \"Look.\"\nslots = " + slots + "\nsteps = [\n" +
                            steps + "\n]\n" + places)
            .lines();
    };
    const std::string two = "[\"first\", \"second\"]", three = "[\"first\", \"second\", \"left\"]";
    const std::string in_turn = "{ show = \"first\", for_s = 1 },\n{ blank = 0.5 },\n{ show = \"second\" },";
    CHECK(lines(two, in_turn) == Lines{});
    CHECK(lines(three, in_turn) == Lines{"20:1: no step of task t shows its slot left"});
    CHECK(lines(two, in_turn + "\n{ show = \"left\" },") ==
          Lines{"21:1: task t shows stimuli in first, second, and this step in left"});
    const Lines overlap = lines(two, "{ show = " + two + " },");
    REQUIRE(overlap.size() == 1);
    CHECK(overlap[0].starts_with("18:1: the slots \"first\" and \"second\" overlap: columns "));
    CHECK(lines(three,
                "{ show = \"first\" },\n{ show = [\"second\", \"left\"], until = { gaze_on = \"head\", "
                "slot = \"left\" } },") == Lines{});
    const Lines elsewhere =
        lines(three, "{ show = \"first\", until = { gaze_on = \"head\", slot = \"left\" } },\n{ show = "
                     "[\"second\", \"left\"] },");
    CHECK(elsewhere == Lines{"18:54: this step shows nothing in slot left"});
    CHECK(lines(three,
                "{ fixation = { until = { gaze_within_deg = 2, slot = \"rihgt\", patience_s = 2 } } },\n" +
                    in_turn + "\n{ show = \"left\" },") == Lines{"18:54: unknown slot \"rihgt\""});
}
