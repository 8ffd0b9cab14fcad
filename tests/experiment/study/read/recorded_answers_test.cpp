/// Answers, gauges and turned objects of recorded sessions, each column with a value of its own.
#include <algorithm>
#include <array>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/ports/event_kinds.h"
#include "experiment/record/session_schema.h"
#include "experiment/study/read/answer_reader.h"
#include "experiment/study/read/exploration_reader.h"
#include "experiment/study/read/gauge_reader.h"
#include "tests/experiment/record/session_fixture.h"

using namespace overt;
using namespace overt::testing;
namespace fs = std::filesystem;

namespace {

using SameObservers = std::vector<std::pair<std::string, std::string>>;

/// Two slots; materials have a number and a word of their own.
SessionHeader asked_header(const std::string& observer = "AB7") {
    SessionHeader header = example_header();
    header.schedule.observer = {observer, 2};
    header.slots = {{"left", "Left", {10, 44}, {512, 511}}, {"right", "Right", {280, 44}, {512, 511}}};
    header.materials[0].columns = {{"gloss", "0.25", 0.25}, {"family", "metal", {}}};
    header.materials[1].columns = {{"gloss", "0.5", 0.5}, {"family", "metal", {}}};
    return header;
}

struct AskedAttempt {
    Trial trial;
    TrialOutcome outcome;
    std::vector<FlipRecord> flips = {};
};

fs::path asked_session(const fs::path& root, SessionHeader header, const std::vector<AskedAttempt>& attempts,
                       const std::vector<SessionEvent>& events = {}) {
    header.schedule.trials.clear();
    for (const AskedAttempt& attempt : attempts)
        header.schedule.trials.push_back(attempt.trial);
    std::ranges::sort(header.schedule.trials, {}, &Trial::index);
    const fs::path session = make_session(root, header);
    SessionStore store(session / session_file_name, patient());
    for (const AskedAttempt& attempt : attempts) {
        const int index = attempt.trial.index;
        store.trial_started(attempt.trial, at_ms(10'000 * index));
        for (const SessionEvent& event : events)
            if (event.trial == index)
                store.event(event);
        for (const FlipRecord& flip : attempt.flips)
            store.flip(flip);
        store.trial_finished(attempt.trial, attempt.outcome);
    }
    store.close();
    return session;
}

GivenAnswer given_at(const std::string& id, const std::string& value, std::int64_t at) {
    GivenAnswer answer{.id = id, .item = {}, .kind = "choice", .is_missed = false, .value = value};
    answer.window_onset = at_ms(at - 750);
    answer.answered_at = at_ms(at);
    return answer;
}

std::string level_pairs(const std::vector<std::pair<std::string, std::string>>& levels) {
    std::string all;
    for (const auto& [factor, level] : levels)
        all += (all.empty() ? "" : " ") + factor + "=" + level;
    return all;
}

std::string words_of_answer(const StudyAnswer& one) {
    std::string shown;
    for (const AnsweredStimulus& stimulus : one.shown) {
        shown += fmt::format(" [{}: {}", stimulus.slot, level_pairs(stimulus.levels));
        for (const auto& [factor, number] : stimulus.numbers)
            shown += fmt::format(" {}:{}", factor, number);
        shown += stimulus.until_answer_s ? fmt::format(" {:.3f} s]", *stimulus.until_answer_s) : " never]";
    }
    return fmt::format("{} {} {}/{} {} {}~{} {} {} n {} in {} | s{} t{} | {} | {} {} {} |{}", one.observer,
                       one.task, one.answer, one.item, one.kind, one.value, one.correct,
                       one.is_missed ? "missed" : "given",
                       one.is_correct ? (*one.is_correct ? "right" : "wrong") : "-",
                       one.number.value_or(-1.0), one.response_s.value_or(-1.0), one.session, one.trial,
                       level_pairs(one.levels), one.procedure, one.procedure_factor, one.track, shown);
}

} // namespace

TEST_CASE("an answer has what was asked, shown and answered, and what a procedure chose for it", "[unit]") {
    const TemporaryFolder root;
    // The same material in both slots; another object beside it.
    Trial both{0, 1, {0, 1}};
    both.slot = 1;
    both.beside = {{{1, 1}, 0}};
    both.levels = {{"size", "8"}};
    // The second of these was asked again.
    Trial alone{2, 0, {1, 0}}, practice{3, 0, {1, 0}}, silent{1, 0, {0, 0}};
    practice.role = TrialRole::practice;
    TrialOutcome first = outcome_at(0);
    first.given = {given_at("which", "left", 3500), given_at("how", "3", 4000)};
    first.given[0].correct = "right";
    first.given[0].is_correct = false;
    first.given[1].item = "smooth";
    first.given[1].kind = "scale";
    first.given[1].number = 3.0;
    first.given[1].is_correct = true;
    TrialOutcome third = outcome_at(20'000);
    third.given = {given_at("which", "", 24'000)};
    third.given[0].is_missed = true;
    third.given[0].answered_at.reset();
    const std::vector<SessionEvent> events{
        {at_ms(1), 0, level_chosen_event, "stair: gloss 0.5, condition 2, step 4"},
        {at_ms(20'001), 2, level_chosen_event, "stair: fine gloss 0.25, condition 3"},
        {at_ms(20'002), 2, level_chosen_event, "no condition here"},
        {at_ms(20'003), 2, level_chosen_event, "one: two, condition many"},
        {at_ms(20'003), 2, "another kind", "stair: gloss 0.5, condition 9"},
        {at_ms(20'004), 2, level_chosen_event, ", condition 7, one: two three"}};
    const fs::path own = asked_session(
        root.path(), asked_header(),
        {{both, first}, {silent, outcome_at(10'000)}, {alone, third}, {practice, third}}, events);
    const fs::path other = asked_session(root.path(), asked_header("CD8"), {{both, first}});
    const std::vector<StudyAnswer> answers =
        read_answers(std::array{own, other}, SameObservers{{"XX1", "YY2"}, {"CD8", "AB7"}});
    std::vector<std::string> lines;
    for (const StudyAnswer& one : answers)
        lines.push_back(words_of_answer(one));
    const std::string slots = " [right: object=bust material=silver gloss=0.5 gloss:0.5 {} s] "
                              "[left: object=vase material=silver gloss=0.5 gloss:0.5 {} s]";
    CHECK(lines ==
          std::vector<std::string>{
              "AB7 age which/ choice left~right given wrong n -1 in 0.75 | s0 t1 | size=8 material=silver "
              "gloss=0.5 | "
              "stair gloss 2 |" +
                  fmt::format(fmt::runtime(slots), "2.500", "2.500"),
              "AB7 age how/smooth scale 3~ given right n 3 in 0.75 | s0 t1 | size=8 material=silver "
              "gloss=0.5 | "
              "stair gloss 2 |" +
                  fmt::format(fmt::runtime(slots), "3.000", "3.000"),
              "AB7 free which/ choice ~ missed - n -1 in -1 | s0 t3 | object=vase material=gold gloss=0.25 | "
              "stair fine gloss 3 | [left: object=vase material=gold gloss=0.25 gloss:0.25 never]",
              "AB7 age which/ choice left~right given wrong n -1 in 0.75 | s1 t1 | size=8 material=silver "
              "gloss=0.5 |  "
              " 0 |" +
                  fmt::format(fmt::runtime(slots), "2.500", "2.500"),
              "AB7 age how/smooth scale 3~ given right n 3 in 0.75 | s1 t1 | size=8 material=silver "
              "gloss=0.5 |   "
              "0 |" +
                  fmt::format(fmt::runtime(slots), "3.000", "3.000")});
}

TEST_CASE("a match has the levels of what it is matched to, the first in another slot", "[unit]") {
    const TemporaryFolder root;
    Trial trial{0, 0, {0, 1}};
    trial.slot = 0;
    trial.beside = {{{1, 0}, 1}};
    TrialOutcome outcome = outcome_at(0);
    outcome.given = {given_at("match", "0.5", 3500), given_at("match", "0.5", 3500),
                     given_at("match", "0.5", 900)};
    for (GivenAnswer& one : outcome.given) {
        one.kind = "match";
        one.settings = {
            {.along = "gloss", .start = 0.1, .final = 0.5, .low = 0.0, .high = 1.0, .reference = 0.25}};
        one.slot = 0;
    }
    outcome.given[1].slot = 1;
    const fs::path session = asked_session(root.path(), asked_header(), {{trial, outcome}});
    const std::vector<StudyAnswer> answers = read_answers(std::array{session}, {});
    REQUIRE(answers.size() == 3);
    CHECK(level_pairs(answers[0].levels) == "object=vase material=gold gloss=0.25");
    CHECK(level_pairs(answers[1].levels) == "object=bust material=silver gloss=0.5");
    REQUIRE(answers[0].settings.size() == 1);
    CHECK(answers[0].settings[0] == outcome.given[0].settings[0]);
    // Answered before anything was shown.
    CHECK_FALSE(answers[2].shown[0].until_answer_s);
    CHECK(answers[0].shown[0].until_answer_s == 2.5);
}

TEST_CASE("a setting of a gauge has its place as the camera sees it, and its picture's names", "[unit]") {
    const TemporaryFolder root;
    SessionHeader header = asked_header();
    header.objects[1].cameras = {Camera{{0.0, -100.0, 0.0}, {0.0, 0.0, 0.0}, Degrees{11.5}}};
    header.objects[1].axis_point = {0.0, 0.0, 0.0};
    header.lights = {{.id = "dawn"}, {.id = "noon"}};
    header.motions = {{.id = "to and fro"}};
    header.views = {{.id = "front"}};
    header.poses = {{{{-90.0}}, {{0.0}}, {{90.0}}}, {{PoseIndex{0}, PoseIndex{1}, PoseIndex{2}}}};
    const glm::dvec3 nose{3.0, -4.0, 5.0};
    SessionHeader other = header;
    other.schedule.observer.label = "EF9";
    header.points = {{0, "nose", 1, {1.0, 0.0, 0.0}, {9.0, 9.0, 9.0}},
                     {1, "nose", 1, {1.0, 0.0, 0.0}, nose},
                     {1, "chin", 1, {1.0, 0.0, 0.0}, -nose}};
    Trial trial{0, 1, {0, 1}};
    trial.beside = {{{1, 0, 1}, 1}};
    TrialOutcome outcome = outcome_at(0);
    const auto gauge = [&](const std::string& probe, const std::string& point, int frame) {
        GivenAnswer answer = given_at("lean", "set", 4000);
        answer.kind = "gauge";
        answer.gauge = GaugeAnswer{
            probe, point, {{1.0}, {2.0}}, {{30.0}, {70.0}}, false, Attitude{{33.0}, {75.0}}, frame, true};
        outcome.given.push_back(answer);
        return &outcome.given.back();
    };
    outcome.probes = {{.step = 1, .id = "mark", .point = "chin", .place = 1},
                      {.step = 1, .id = "first", .point = "nose", .place = 0}};
    gauge("mark", "nose", 0);
    GivenAnswer* const second = gauge("mark", "chin", 1);
    second->gauge->is_at_limit = true;
    second->gauge->truth.reset();
    // None of these is a setting: missed, hidden, without a frame, at a place that is not there, of no probe.
    gauge("mark", "nose", 0)->is_missed = true;
    gauge("mark", "nose", 0)->gauge->is_visible = false;
    gauge("mark", "nose", 0)->gauge->is_visible.reset();
    gauge("mark", "nose", 0)->gauge->frame.reset();
    gauge("mark", "ear", 0);
    gauge("none", "nose", 0);
    gauge("first", "chin", 0);
    outcome.given.push_back(given_at("which", "left", 3500));
    Trial practice = trial;
    practice.index = 1;
    practice.role = TrialRole::practice;
    const fs::path session = asked_session(root.path(), header, {{trial, outcome}, {practice, outcome}}),
                   without = asked_session(root.path(), other, {{trial, outcome}});
    const std::vector<GaugeSettingRow> rows =
        read_gauge_settings(std::array{without, session}, SameObservers{{"ZZ", "Z"}, {"AB7", "one"}});
    // Of one session after the other.
    const auto of_three = read_gauge_settings(std::array{session, without, session}, {});
    REQUIRE(of_three.size() == 4);
    CHECK(of_three[1].session == 0);
    CHECK(of_three[3].session == 2);
    REQUIRE(rows.size() == 2);
    CHECK(rows[0].of == ReliefOf{"one", "age", "lean", "vase", "gold", "noon", "to and fro", "front", 0});
    CHECK(rows[0].session == 1);
    CHECK(rows[0].trial == 1);
    CHECK(rows[0].point == "nose");
    // Turned by -90 degrees, counter-clockwise from above, (3, -4, 5) is (-4, -3, 5): the camera, 100 before
    // it, sees its x to the right, z up, and it is 97 away.
    CHECK(rows[0].x == Approx(-4.0));
    CHECK(rows[0].y == Approx(5.0));
    CHECK(rows[0].z == Approx(-97.0));
    CHECK(rows[0].set == Attitude{{30.0}, {70.0}});
    CHECK(rows[0].truth == Attitude{{33.0}, {75.0}});
    CHECK_FALSE(rows[0].is_at_limit);
    CHECK(rows[0].response_s == 0.75);
    CHECK(rows[1].of.frame == 1);
    CHECK(rows[1].x == Approx(-3.0));
    CHECK(rows[1].y == Approx(-5.0));
    CHECK(rows[1].z == Approx(-104.0));
    CHECK(rows[1].is_at_limit);
    CHECK_FALSE(rows[1].truth);
}

TEST_CASE("an object that was turned has its ways, times and levels, show by show", "[unit]") {
    const TemporaryFolder root;
    SessionHeader header = asked_header();
    header.animations.push_back(header.animations.front());
    header.animations[0].kind = MotionKind::observer;
    header.motions = {{.id = "own"}, {.id = "planned"}};
    header.poses = {{{{0.0}}, {{10.0}}, {{20.0}}},
                    {{PoseIndex{0}, PoseIndex{1}, PoseIndex{2}}, {PoseIndex{0}, PoseIndex{1}, PoseIndex{2}}}};
    SessionHeader other = header;
    other.schedule.observer.label = "EF9";
    other.animations[0].kind = MotionKind::turn;
    Trial turned{0, 1, {0, 1, 0, 0}}, planned{1, 0, {0, 0, 0, 1}};
    std::vector<FlipRecord> flips;
    const std::array poses{0, 1, 2, 2, 1, 1, 0, 1};
    for (int i = 0; i < 8; ++i) {
        const int pose = poses[static_cast<std::size_t>(i)];
        FlipRecord flip{0, i, {pose}, {pose}, {pose}, {}};
        flip.report.refresh = {i};
        flip.report.vertical_blank = at_ms(1000 + 10 * i);
        flips.push_back(flip);
    }
    const fs::path session = asked_session(root.path(), header,
                                           {{turned, outcome_at(0), flips}, {planned, outcome_at(10'000)}}),
                   without = asked_session(root.path(), other,
                                           {{turned, outcome_at(0), flips}, {planned, outcome_at(10'000)}});
    const std::vector<ExplorationRow> rows =
        read_explorations(std::array{without, session}, SameObservers{{"ZZ", "Z"}, {"AB7", "one"}});
    // A session with one task and one motion alone has no levels of these.
    header.schedule.observer.label = "GH1";
    header.tasks.resize(1);
    header.motions.clear();
    header.animations.resize(1);
    header.poses.of_motion.resize(1);
    turned.task = 0;
    const fs::path alone = asked_session(root.path(), header, {{turned, outcome_at(0), flips}});
    const auto of_three = read_explorations(std::array{session, without, alone}, {});
    REQUIRE(of_three.size() == 2);
    CHECK(of_three[1].session == 2);
    CHECK(level_pairs(of_three[1].levels) == "object=bust material=silver");
    REQUIRE(rows.size() == 1);
    CHECK(rows[0].observer == "one");
    CHECK(rows[0].session == 1);
    CHECK(rows[0].trial == 1);
    CHECK(level_pairs(rows[0].levels) == "task=age object=bust material=silver motion=own");
    CHECK(rows[0].seconds == Approx(0.07));
    CHECK(rows[0].turning_s == Approx(0.05));
    CHECK(rows[0].path_deg == Approx(50.0));
    CHECK(rows[0].net_deg == Approx(10.0));
    CHECK(rows[0].reversals == 2);
    CHECK(rows[0].poses == 3);
}
