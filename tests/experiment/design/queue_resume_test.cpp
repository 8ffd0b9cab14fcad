/// A queue that goes through what was done stands where the interrupted one stood.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/random.h"
#include "experiment/design/schedule.h"
#include "experiment/design/trial_queue.h"
#include "tests/experiment/protocol/protocol_fixtures.h"

using namespace overt;
using namespace overt::test;

namespace {

Protocol blocks_with_everything(RandomStream& random) {
    Protocol protocol = paper_protocol();
    protocol.schedule.max_task_run = 0;
    protocol.schedule.max_object_run = 0;
    for (const char* id : {"one", "two", "three"}) {
        protocol.blocks.emplace_back();
        protocol.blocks.back().id = id;
        protocol.blocks.back().tasks = {protocol.blocks.size() == 2 ? "age" : "free"};
        protocol.blocks.back().instructions = random.below(2) ? "Read this." : "";
    }
    protocol.practice = {{"age", {"muse", "rough"}, "two", "Well done."},
                         {"free", {"muse", "rough"}, "", ""},
                         {"free", {"runner", "rough"}, "", ""}};
    constexpr RepeatWhen whens[] = {RepeatWhen::never, RepeatWhen::now, RepeatWhen::end_of_block};
    protocol.repeat.rejected = whens[random.below(3)];
    protocol.repeat.most_attempts = 1 + static_cast<int>(random.below(4));
    protocol.breaks.every_trials = static_cast<int>(random.below(6));
    protocol.breaks.between_blocks = random.below(2) == 0;
    return protocol;
}

/// Whether the n-th attempt at a trial fails: the same however often the session is interrupted.
bool fails(std::uint64_t seed, const SessionStep& step) {
    RandomStream random(seed, "failures", static_cast<std::uint64_t>(100 * step.trial.index + step.attempt));
    return random.below(3) == 0;
}

AttemptFate fate_of(const AttemptVerdict& verdict) {
    if (verdict.counts)
        return AttemptFate::counted;
    constexpr AttemptFate of[] = {AttemptFate::skipped, AttemptFate::comes_again_now,
                                  AttemptFate::comes_again_at_end};
    return of[static_cast<int>(verdict.comes_again)];
}

std::string word_of(const SessionStep& step) {
    constexpr std::string_view kinds[] = {"text", "practice", "trial", "pause"};
    return fmt::format("{} {} {} | ", kinds[static_cast<int>(step.kind)], step.trial.index, step.attempt);
}

/// Goes on until the end, or until `last_step` steps were begun; the last one is cut off. Gives the story
/// without what was cut off, and notes what was done.
std::string go_on(TrialQueue& queue, std::uint64_t seed, int last_step, std::vector<RecordedStep>& done) {
    std::string story;
    for (int number = 1; const auto step = queue.next(); ++number) {
        const bool is_cut_off = number == last_step;
        if (step->kind == SessionStep::Kind::trial) {
            if (is_cut_off) {
                done.push_back({RecordedStep::Kind::trial, step->trial.index, AttemptFate::interrupted, {}});
                return story;
            }
            const AttemptVerdict verdict = queue.tell({.is_rejected = fails(seed, *step)});
            done.push_back({RecordedStep::Kind::trial, step->trial.index, fate_of(verdict), {}});
        } else if (is_cut_off) {
            return story;
        } else if (step->kind == SessionStep::Kind::practice) {
            done.push_back({RecordedStep::Kind::practice, -1, {}, {}});
        } else if (step->kind == SessionStep::Kind::pause) {
            done.push_back({RecordedStep::Kind::pause, -1, {}, {}});
        }
        story += word_of(*step);
    }
    return story;
}

std::string without_texts(std::string story) {
    for (std::size_t at; (at = story.find("text ")) != std::string::npos;)
        story.erase(at, story.find("| ", at) + 2 - at);
    return story;
}

} // namespace

TEST_CASE("however often a session is interrupted and redone, its steps are those of one that is not",
          "[unit]") {
    RandomStream random(1, "interruptions");
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        const Protocol protocol = blocks_with_everything(random);
        const Schedule schedule = make_schedule(protocol, {"P", 1}, seed);
        std::vector<RecordedStep> unused;
        TrialQueue whole(protocol, schedule);
        const std::string expected = without_texts(go_on(whole, seed, -1, unused));

        std::string story;
        std::vector<RecordedStep> done;
        for (bool is_done = false; !is_done;) {
            TrialQueue queue(protocol, schedule);
            queue.go_through(done);
            story += go_on(queue, seed, 1 + static_cast<int>(random.below(12)), done);
            done.push_back({RecordedStep::Kind::resumed, -1, {}, ResumePolicy::redo});
            TrialQueue look(protocol, schedule);
            look.go_through(done);
            is_done = look.is_done();
        }
        REQUIRE(without_texts(story) == expected);
    }
}

TEST_CASE("a skipped trial does not come again, whatever comes after it does", "[unit]") {
    RandomStream random(2, "interruptions");
    Protocol protocol = blocks_with_everything(random);
    protocol.practice.clear();
    protocol.breaks = {};
    const Schedule schedule = make_schedule(protocol, {"P", 1}, 1);
    const std::vector<RecordedStep> past{{RecordedStep::Kind::trial, 0, AttemptFate::counted, {}},
                                         {RecordedStep::Kind::trial, 1, AttemptFate::interrupted, {}}};
    TrialQueue queue(protocol, schedule);
    queue.go_through(past);
    CHECK_FALSE(queue.is_done());
    CHECK(queue.resume(ResumePolicy::skip).skipped == 1);
    CHECK(queue.next()->trial.index == 2);
}

TEST_CASE("a block that begins again has all its trials, in their order, and no other", "[unit]") {
    RandomStream random(3, "interruptions");
    for (int round = 0; round < 100; ++round) {
        Protocol protocol = blocks_with_everything(random);
        const Schedule schedule = make_schedule(protocol, {"P", 1}, 1);
        std::vector<RecordedStep> done;
        TrialQueue before(protocol, schedule);
        const auto seed = static_cast<std::uint64_t>(round);
        go_on(before, seed, 1 + static_cast<int>(random.below(60)), done);
        TrialQueue queue(protocol, schedule);
        queue.go_through(done);
        const ResumeEffect effect = queue.resume(ResumePolicy::restart_block);
        CHECK_FALSE(effect.skipped);
        std::vector<int> order;
        while (const auto step = queue.next()) {
            if (step->kind != SessionStep::Kind::trial)
                continue;
            order.push_back(step->trial.index);
            CHECK(step->attempt == 1);
            queue.tell({});
        }
        std::vector<int> expected;
        const int first_block = effect.restarted_block.value_or(-1);
        for (const Trial& trial : schedule.trials)
            if (first_block >= 0 ? trial.block >= first_block
                                 : !order.empty() && trial.index >= order.front())
                expected.push_back(trial.index);
        CHECK(order == expected);
    }
}

TEST_CASE("steps that an order does not have are refused", "[unit]") {
    const Protocol protocol = paper_protocol();
    const Schedule schedule = make_schedule(protocol, {"P", 1}, 1);
    const std::vector<RecordedStep> other_trial{{RecordedStep::Kind::trial, 5, AttemptFate::counted, {}}};
    const std::vector<RecordedStep> practice{{RecordedStep::Kind::practice, -1, {}, {}}};
    CHECK_THROWS_AS(TrialQueue(protocol, schedule).go_through(other_trial), RecordError);
    CHECK_THROWS_AS(TrialQueue(protocol, schedule).go_through(practice), RecordError);
}
