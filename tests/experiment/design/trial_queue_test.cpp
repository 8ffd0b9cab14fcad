#include "experiment/design/trial_queue.h"

#include <map>
#include <set>

#include <catch2/catch.hpp>

#include "experiment/base/random.h"
#include "experiment/design/schedule.h"
#include "tests/experiment/protocol/protocol_fixtures.h"

using namespace overt;
using namespace overt::test;

namespace {

constexpr RepeatWhen whens[] = {RepeatWhen::never, RepeatWhen::now, RepeatWhen::end_of_block};

Protocol three_blocks() {
    Protocol protocol = paper_protocol();
    protocol.schedule.max_object_run = 0;
    for (const char* id : {"one", "two", "three"}) {
        protocol.blocks.emplace_back();
        protocol.blocks.back().id = id;
        protocol.blocks.back().tasks = {protocol.blocks.size() == 2 ? "age" : "free"};
    }
    return protocol;
}

/// All steps of a session in which attempts go as `how` says.
template <class How>
std::vector<SessionStep> steps_of(const Protocol& protocol, const Schedule& schedule, How how) {
    std::vector<SessionStep> steps;
    TrialQueue queue(protocol, schedule);
    while (const auto step = queue.next()) {
        steps.push_back(*step);
        REQUIRE(steps.size() < 10'000);
        if (step->kind == SessionStep::Kind::trial)
            queue.tell(how(*step));
    }
    CHECK(queue.is_done());
    return steps;
}

std::vector<SessionStep> steps_of(const Protocol& protocol, const Schedule& schedule) {
    return steps_of(protocol, schedule, [](const SessionStep&) { return AttemptResult{}; });
}

int count_of(const std::vector<SessionStep>& steps, SessionStep::Kind kind) {
    return static_cast<int>(std::count_if(steps.begin(), steps.end(),
                                          [&](const SessionStep& step) { return step.kind == kind; }));
}

} // namespace

TEST_CASE("without failures a session is its schedule, trial by trial", "[unit]") {
    for (const Protocol& protocol : {paper_protocol(), three_blocks()}) {
        const Schedule schedule = make_schedule(protocol, {"P", 1}, 1);
        const std::vector<SessionStep> steps = steps_of(protocol, schedule);
        REQUIRE(steps.size() == schedule.trials.size());
        for (std::size_t i = 0; i < steps.size(); ++i) {
            CHECK(steps[i].trial == schedule.trials[i]);
            CHECK(steps[i].attempt == 1);
        }
    }
}

TEST_CASE("whatever fails, each trial ends, in its block, with attempts that count up to the most",
          "[unit]") {
    RandomStream random(1, "failures");
    for (int round = 0; round < 300; ++round) {
        Protocol protocol = three_blocks();
        protocol.repeat.missed_refreshes = whens[random.below(3)];
        protocol.repeat.gaze_lost = whens[random.below(3)];
        protocol.repeat.rejected = whens[random.below(3)];
        protocol.repeat.most_attempts = 1 + static_cast<int>(random.below(4));
        protocol.breaks.every_trials = static_cast<int>(random.below(6));
        protocol.breaks.between_blocks = random.below(2) == 0;
        const Schedule schedule = make_schedule(protocol, {"P", 1}, static_cast<std::uint64_t>(round));
        const double failure_rate = random.uniform();
        std::map<int, int> attempts, counted, rejected;
        std::vector<int> blocks;
        TrialQueue queue(protocol, schedule);
        std::optional<SessionStep::Kind> before;
        while (const auto step = queue.next()) {
            const bool is_trial = step->kind == SessionStep::Kind::trial;
            CHECK((is_trial || before != step->kind)); // no two breaks in a row
            CHECK((is_trial || before.has_value()));   // none before the first
            before = step->kind;
            if (!is_trial)
                continue;
            REQUIRE(step->attempt == ++attempts[step->trial.index]);
            REQUIRE(counted[step->trial.index] == 0); // none after the one that counts
            if (blocks.empty() || blocks.back() != step->trial.block)
                blocks.push_back(step->trial.block);
            AttemptResult result;
            if (random.uniform() < failure_rate) {
                const std::uint32_t kind = random.below(3);
                result.missed_refreshes = kind == 0 ? 1 : 0;
                result.gaze_lost_share = kind == 1 ? 1.0 : 0.0;
                result.is_rejected = kind == 2;
            }
            const AttemptVerdict verdict = queue.tell(result);
            counted[step->trial.index] += verdict.counts;
            if (!verdict.counts && verdict.comes_again == RepeatWhen::never) {
                CHECK(verdict.failure == TrialFailure::rejected);
                ++rejected[step->trial.index];
            }
        }
        CHECK((before == SessionStep::Kind::trial)); // no break after the last
        CHECK(blocks == std::vector<int>{0, 1, 2});
        CHECK(attempts.size() == schedule.trials.size());
        for (const auto& [trial, number] : attempts) {
            CHECK(number <= protocol.repeat.most_attempts);
            CHECK(counted[trial] + rejected[trial] == 1);
        }
    }
}

TEST_CASE("a failed trial comes again at once, at the end of its block, or not at all", "[unit]") {
    Protocol protocol = three_blocks();
    const Schedule schedule = make_schedule(protocol, {"P", 1}, 1);
    const auto fails_first = [](const SessionStep& step) {
        return AttemptResult{.is_rejected = step.trial.index == 2 && step.attempt == 1};
    };
    const auto places = [&](RepeatWhen when) {
        protocol.repeat.rejected = when;
        std::vector<std::size_t> found;
        const auto steps = steps_of(protocol, schedule, fails_first);
        for (std::size_t i = 0; i < steps.size(); ++i) {
            if (steps[i].trial.index == 2)
                found.push_back(i);
        }
        return found;
    };
    CHECK(places(RepeatWhen::never) == std::vector<std::size_t>{2});
    CHECK(places(RepeatWhen::now) == std::vector<std::size_t>{2, 3});
    CHECK(places(RepeatWhen::end_of_block) == std::vector<std::size_t>{2, 9}); // the block has nine trials
}

TEST_CASE("what is not to be repeated counts, however it went, but for a rejected attempt", "[unit]") {
    Protocol protocol = three_blocks();
    const Schedule schedule = make_schedule(protocol, {"P", 1}, 1);
    const auto verdict_on = [&](const AttemptResult& result) {
        TrialQueue queue(protocol, schedule);
        queue.next();
        return queue.tell(result);
    };
    CHECK(verdict_on({.missed_refreshes = 99, .gaze_lost_share = 1.0}).counts);
    // Of gaze there was none: that is said, though the protocol repeats nothing for it.
    CHECK(verdict_on({.gaze_lost_share = 1.0}).failure == TrialFailure::gaze_lost);
    CHECK(verdict_on({.gaze_lost_share = 1.0}).comes_again == RepeatWhen::never);
    CHECK(verdict_on({.gaze_lost_share = 0.9}).failure == TrialFailure::none);
    // What a device broke is no rejection, and never counts.
    for (const AttemptResult& broken :
         {AttemptResult{.is_tracker_lost = true}, AttemptResult{.has_clock_jumped = true},
          AttemptResult{.is_broken_off = true}}) {
        CHECK(verdict_on(broken).failure > TrialFailure::rejected);
        CHECK_FALSE(verdict_on(broken).counts);
        CHECK(verdict_on(broken).comes_again == protocol.repeat.rejected);
    }
    CHECK(verdict_on({.is_tracker_lost = true}).failure == TrialFailure::tracker_lost);
    CHECK(verdict_on({.has_clock_jumped = true}).failure == TrialFailure::clock_jumped);
    CHECK(verdict_on({.is_broken_off = true}).failure == TrialFailure::broken_off);
    CHECK(verdict_on({.is_repeated = true, .is_tracker_lost = true}).failure == TrialFailure::tracker_lost);
    CHECK(verdict_on({.is_repeated = true, .is_tracker_lost = true}).comes_again == RepeatWhen::now);
    protocol.repeat.missed_refreshes = RepeatWhen::now;
    protocol.repeat.missed_refreshes_limit = 2;
    CHECK(verdict_on({.missed_refreshes = 2}).failure == TrialFailure::none);
    CHECK(verdict_on({.missed_refreshes = 3}).failure == TrialFailure::missed_refreshes);
    CHECK_FALSE(verdict_on({.missed_refreshes = 3}).counts);
    protocol.repeat.gaze_lost = RepeatWhen::end_of_block;
    protocol.repeat.gaze_lost_limit = 0.25;
    CHECK(verdict_on({.gaze_lost_share = 0.25}).failure == TrialFailure::none);
    CHECK(verdict_on({.gaze_lost_share = 0.26}).comes_again == RepeatWhen::end_of_block);
    protocol.repeat.most_attempts = 1;
    CHECK(verdict_on({.gaze_lost_share = 0.26}).counts);
    CHECK_FALSE(verdict_on({.is_rejected = true}).counts);
}

TEST_CASE("practice and instructions come before their block, breaks where they are due", "[unit]") {
    Protocol protocol = three_blocks();
    protocol.practice = {{"age", {"muse", "rough"}, "two", "Well done."},
                         {"free", {"muse", "rough"}, "", ""},
                         {"free", {"runner", "rough"}, "", ""}};
    protocol.blocks[1].instructions = "Now something else.";
    protocol.breaks.every_trials = 4;
    protocol.breaks.between_blocks = true;
    const Schedule schedule = make_schedule(protocol, {"P", 1}, 1);
    std::string story;
    for (const SessionStep& step : steps_of(protocol, schedule))
        story += "ipt-"[static_cast<int>(step.kind)];
    // Nine trials, three, nine; a break begins the count anew, and one that would come a single trial before
    // that between two blocks waits for it.
    CHECK(story == "pptttt-ttttt-ipttt-tttt-tttt-t");
    protocol.breaks = {};
    CHECK(count_of(steps_of(protocol, schedule), SessionStep::Kind::pause) == 0);
    CHECK(count_of(steps_of(protocol, schedule), SessionStep::Kind::practice) == 3);
}

TEST_CASE("practice, breaks and repetition reshuffle no trial", "[unit]") {
    Protocol protocol = three_blocks();
    const std::vector<Trial> before = make_schedule(protocol, {"P", 4}, 9).trials;
    protocol.practice = {{"age", {"muse", "rough"}, "", ""}};
    protocol.breaks.every_trials = 3;
    protocol.repeat.missed_refreshes = RepeatWhen::now;
    CHECK(make_schedule(protocol, {"P", 4}, 9).trials == before);
}

TEST_CASE("the stimulus that is expected is the one that comes, unless a trial fails", "[unit]") {
    Protocol protocol = three_blocks();
    protocol.practice = {{"age", {"scholar", "coated"}, "three", ""}};
    const Schedule schedule = make_schedule(protocol, {"P", 1}, 1);
    TrialQueue queue(protocol, schedule);
    std::optional<Trial> expected = queue.expected();
    while (const auto step = queue.next()) {
        CHECK(((expected && expected->stimulus == step->trial.stimulus) ||
               step->kind == SessionStep::Kind::practice));
        expected = queue.expected();
        if (step->kind == SessionStep::Kind::trial)
            queue.tell({});
    }
    CHECK_FALSE(expected);
}

TEST_CASE("what practice, breaks and repetition say wrongly is said", "[unit]") {
    const auto print = [](std::string_view more) {
        return ReadText(minimal_protocol, more).diagnostics.print();
    };
    using Catch::Contains;
    CHECK_THAT(print("[[practice]]\ntask = \"fre\"\nobject = \"a\"\nmaterial = \"gold\"\n"),
               Contains("p.toml:13:8: error: there is no task \"fre\"") && Contains("did you mean"));
    CHECK_THAT(print("[[practice]]\ntask = \"free\"\nobject = \"a\"\nmaterial = \"gold\"\nblock = \"x\"\n"),
               Contains("there is no block \"x\""));
    CHECK_THAT(print("[breaks]\npace = \"timed\"\nmin_s = 3\n"),
               Contains("\"min_s\" is for breaks that a key ends"));
    CHECK_THAT(print("[breaks]\nbetween_blocks = true\n"), Contains("no blocks to break between"));
    CHECK_THAT(print("[breaks]\nbetween_blocks = 1\n"),
               Contains("expected true or false, found a whole number"));
    CHECK_THAT(print("[repeat]\nmost_attempts = 1\n"), Contains("with one attempt nothing is ever repeated"));
    CHECK(print("[repeat]\nmissed_refreshes = \"end-of-block\"\nmost_attempts = 2\n") == "");
}
