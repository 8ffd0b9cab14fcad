/// Trials whose level is chosen when they come: what is chosen, what an answer says, and that a session taken
/// up again chooses the same.
#include "experiment/design/procedure_trials.h"

#include <algorithm>
#include <map>
#include <set>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "experiment/base/random.h"
#include "experiment/design/schedule.h"
#include "experiment/design/trial_queue.h"
#include "tests/experiment/protocol/protocol_fixtures.h"

using namespace overt;
using namespace overt::test;

namespace {

std::string procedure_protocol(std::string_view procedures, std::string_view trials) {
    return fmt::format(R"([protocol]
name = "thresholds"
[view]
width_px = 200
height_px = 200
[[object]]
id = "vase"
shipped = "muse"
[[object]]
id = "bust"
shipped = "scholar"
[[material]]
id = "gloss"
kind = "rough-conductor"
series = {{ roughness = [0.05, 0.1, 0.2, 0.4, 0.8] }}
[[slot]]
id = "left"
right_deg = -5
[[slot]]
id = "right"
right_deg = 5
{}
[[task]]
id = "rougher"
question = "Which is rougher?"
slots = ["left", "right"]
trials = {{ {} }}
[[task.answer]]
id = "which"
kind = "choice"
choices = ["left", "right"]
keys = ["left", "right"]
)",
                       procedures, trials);
}

constexpr std::string_view two_tracks = R"([[procedure]]
id = "above"
start = 0.8
trials = 12
[[procedure]]
id = "below"
start = 0.1
down = 1
trials = 8
)";
constexpr std::string_view against_standard =
    R"(rule = "procedure", procedure = ["above", "below"], of = "roughness", same = ["object"], standard = "0.05")";

std::vector<std::string> findings_of(const std::string& text) {
    Diagnostics diagnostics;
    (void)read_protocol_text(text, "p.toml", shipped_names, diagnostics, {});
    std::vector<std::string> lines;
    for (const Finding& finding : diagnostics.findings())
        lines.push_back(finding.message);
    return lines;
}

Protocol sound_one(const std::string& text) {
    Diagnostics diagnostics;
    std::optional<Protocol> protocol = read_protocol_text(text, "p.toml", shipped_names, diagnostics, {});
    INFO(diagnostics.print());
    REQUIRE(protocol);
    return *protocol;
}

/// An observer who sees what is rougher where it is by enough.
std::vector<GivenAnswer> answers_to(const Protocol& protocol, const Trial& trial, RandomStream& random) {
    const std::size_t test = chosen_place(protocol, trial);
    const bool sees = trial.shown(test).stimulus.material >= 2 || random.uniform() < 0.5;
    const std::size_t chosen = sees ? test : 1 - test;
    GivenAnswer given;
    given.id = "which";
    given.is_missed = random.uniform() < 0.1;
    given.value = protocol.slots[static_cast<std::size_t>(trial.shown(chosen).slot)].id;
    return {given};
}

} // namespace

TEST_CASE("a procedure chooses among the levels of its condition, and all else stays", "[unit]") {
    const Protocol protocol = sound_one(procedure_protocol(two_tracks, against_standard));
    const Schedule schedule = make_schedule(protocol, {"P01", 1}, 5);
    REQUIRE(schedule.trials.size() == 40); // 20 for each object
    TrialQueue queue(protocol, schedule);
    RandomStream random(1, "answers");
    std::map<std::pair<std::string, int>, int> trials;
    std::set<double> levels;
    while (const std::optional<SessionStep> step = queue.next()) {
        REQUIRE(step->choice);
        const Trial& planned = schedule.trials[static_cast<std::size_t>(step->trial.index)];
        const std::size_t test = chosen_place(protocol, step->trial), standard = 1 - test;
        CHECK(step->trial.shown(standard) == planned.shown(standard));
        CHECK(step->trial.shown(test).slot == planned.shown(test).slot);
        CHECK(step->trial.shown(test).stimulus.object == planned.stimulus.object);
        CHECK(own_level(step->trial, "side") ==
              protocol.slots[static_cast<std::size_t>(step->trial.shown(test).slot)].id);
        const auto& [procedure, condition] = std::pair(step->choice->procedure, step->choice->condition);
        if (trials[{procedure, condition}]++ == 0)
            CHECK(step->choice->level == (procedure == "above" ? 0.8 : 0.1));
        levels.insert(step->choice->level);
        std::vector<GivenAnswer> given = answers_to(protocol, step->trial, random);
        given.front().is_missed = false;
        AttemptResult result;
        result.given = given;
        queue.tell(result);
    }
    CHECK(trials == std::map<std::pair<std::string, int>, int>{
                        {{"above", 0}, 12}, {{"above", 1}, 12}, {{"below", 0}, 8}, {{"below", 1}, 8}});
    CHECK(levels.size() > 2);
}

TEST_CASE("a session taken up again has the levels that it would have had", "[unit]") {
    const Protocol protocol = sound_one(procedure_protocol(two_tracks, against_standard));
    const Schedule schedule = make_schedule(protocol, {"P01", 1}, 5);
    std::vector<RecordedStep> done;
    std::vector<Trial> shown;
    TrialQueue whole(protocol, schedule);
    RandomStream random(3, "answers");
    while (const std::optional<SessionStep> step = whole.next()) {
        const std::vector<GivenAnswer> given = answers_to(protocol, step->trial, random);
        AttemptResult result;
        result.is_rejected = random.uniform() < 0.1; // comes again at the end, with a level of then
        result.given = given;
        const AttemptVerdict verdict = whole.tell(result);
        done.push_back({RecordedStep::Kind::trial,
                        step->trial.index,
                        verdict.failure == TrialFailure::none             ? AttemptFate::counted
                        : verdict.comes_again == RepeatWhen::end_of_block ? AttemptFate::comes_again_at_end
                                                                          : AttemptFate::skipped,
                        {},
                        given});
        shown.push_back(step->trial);
    }
    for (const std::size_t at : {std::size_t{1}, std::size_t{17}, done.size() - 1}) {
        TrialQueue again(protocol, schedule);
        again.go_through(std::span(done).first(at));
        CHECK(again.next()->trial == shown[at]);
    }
}

TEST_CASE("what an answer says to a procedure", "[unit]") {
    ProcedureSettings settings;
    GivenAnswer other, read;
    other.id = "sure";
    other.is_missed = false;
    read.id = "which";
    read.is_missed = false;
    read.value = "left";
    read.is_correct = false;
    settings.answer = "which";
    const std::vector<GivenAnswer> given{other, read};
    CHECK(track_answer(settings, true, "left", given) == TrackAnswer::yes); // the slot of the test
    CHECK(track_answer(settings, true, "right", given) == TrackAnswer::no);
    CHECK(track_answer(settings, false, "left", given) == TrackAnswer::no); // by what is correct
    settings.yes = "left";
    CHECK(track_answer(settings, false, "right", given) == TrackAnswer::yes);
    settings.answer = "another";
    CHECK(track_answer(settings, false, "right", given) == TrackAnswer::missed);
    CHECK(track_answer({}, true, "right", {}) == TrackAnswer::missed);
}

TEST_CASE("levels that are no stimuli, and what does not belong together, are errors", "[unit]") {
    const auto findings = [](std::string_view procedure) {
        return findings_of(procedure_protocol(
            fmt::format("[[procedure]]\nid = \"above\"\n{}\n", procedure),
            R"(rule = "procedure", procedure = ["above"], of = "roughness", same = ["object"], standard = "0.05")"));
    };
    CHECK(findings("").empty());
    CHECK(findings("start = 0.3") ==
          std::vector<std::string>{"procedure \"above\": there is no stimulus of level 0.3"});
    CHECK(findings("scale = \"linear\"\nsteps = [0.1]") ==
          std::vector<std::string>{
              "procedure \"above\": its steps can lead to the level 0.7, of which there is no stimulus"});
    CHECK(findings("scale = \"db\"\nsteps = [6.020599913]").empty()); // twice and half
    CHECK(findings("kind = \"quest-plus\"") ==
          std::vector<std::string>{"procedure \"above\": quest-plus needs slopes to choose between"});
    CHECK(findings("answer = \"whch\"") ==
          std::vector<std::string>{"procedure \"above\": the task \"rougher\" has no answer \"whch\""});
    CHECK(findings("yes = \"glossy\"") ==
          std::vector<std::string>{"procedure \"above\": \"glossy\" is no choice of the answer \"which\""});
    CHECK(findings("trials = 3") ==
          std::vector<std::string>{
              "procedure \"above\": 3 trials are fewer than the 5 levels that it chooses from"});
    const std::vector<std::string> unknown = findings_of(procedure_protocol(
        two_tracks,
        R"(rule = "procedure", procedure = ["abov"], of = "roughness", same = ["object"], standard = "0.05")"));
    CHECK(std::ranges::find(unknown, "there is no procedure \"abov\"") != unknown.end());
}

TEST_CASE("QUEST and QUEST+ choose levels of the series", "[unit]") {
    const std::string_view kind =
        GENERATE("kind = \"quest\"", "kind = \"quest-plus\"\nslopes = [2, 10]",
                 "kind = \"quest-plus\"\nfunction = \"weibull\"\nslopes = [1, 3]", "kind = \"constant\"");
    const Protocol protocol = sound_one(procedure_protocol(
        fmt::format("[[procedure]]\nid = \"above\"\ntrials = 20\n{}\n", kind),
        R"(rule = "procedure", procedure = ["above"], of = "roughness", same = ["object"], standard = "0.05")"));
    const Schedule schedule = make_schedule(protocol, {"P01", 1}, 2);
    TrialQueue queue(protocol, schedule);
    RandomStream random(1, "answers");
    int trials = 0;
    while (const std::optional<SessionStep> step = queue.next()) {
        REQUIRE(step->choice);
        CHECK(std::set<double>{0.05, 0.1, 0.2, 0.4, 0.8}.contains(step->choice->level));
        CHECK(step->choice->in_words().find("above: roughness ") == 0);
        AttemptResult result;
        result.given = answers_to(protocol, step->trial, random);
        queue.tell(result);
        ++trials;
    }
    CHECK(trials == 40);
}

TEST_CASE("what is left of a procedure that has ended is left out, also when the session is taken up again",
          "[unit]") {
    const Protocol protocol = sound_one(procedure_protocol(
        "[[procedure]]\nid = \"above\"\ntrials = 30\nreversals = 2\ndown = 1\n",
        R"(rule = "procedure", procedure = ["above"], of = "roughness", same = ["object"], standard = "0.05")"));
    const Schedule schedule = make_schedule(protocol, {"P01", 1}, 4);
    REQUIRE(schedule.trials.size() == 60);
    TrialQueue queue(protocol, schedule);
    std::vector<RecordedStep> done;
    std::vector<int> left_out;
    std::map<int, int> trials;
    while (const std::optional<SessionStep> step = queue.next()) {
        const bool is_yes = trials[step->choice->condition]++ % 2 == 0; // up and down
        GivenAnswer given;
        given.is_missed = false;
        given.value = is_yes ? std::string(own_level(step->trial, "side")) : "neither";
        AttemptResult result;
        result.given = {given};
        queue.tell(result);
        for (const int trial : queue.take_left_out())
            left_out.push_back(trial);
        done.push_back({RecordedStep::Kind::trial, step->trial.index, AttemptFate::counted, {}, {given}});
    }
    CHECK(trials == std::map<int, int>{{0, 3}, {1, 3}});
    CHECK(left_out.size() == 54);
    TrialQueue again(protocol, schedule);
    again.go_through(done);
    CHECK(again.is_done());
}
