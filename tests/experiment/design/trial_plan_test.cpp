/// What a trial is going to do: durations as they are drawn and rounded.
#include <catch2/catch.hpp>

#include <cmath>

#include "experiment/base/random.h"
#include "experiment/design/trial_plan.h"

using namespace overt;
using Catch::Matchers::Contains;

namespace {

StepSettings step_of(StepKind kind, std::optional<StepDuration> duration = {}) {
    StepSettings step;
    step.kind = kind;
    step.duration = std::move(duration);
    return step;
}

Protocol protocol_with(std::vector<StepSettings> steps) {
    Protocol protocol;
    Task task;
    task.id = "task";
    task.steps = std::move(steps);
    protocol.tasks = {task};
    return protocol;
}

StepDuration cut_exponential(double from_s, double to_s, double mean_s) {
    return {StepDuration::Law::exponential, {}, from_s, to_s, mean_s};
}

} // namespace

TEST_CASE("seconds become the nearest refresh, and at least one", "[unit]") {
    CHECK(refreshes_in(0.1, 144.0) == 14);
    CHECK(refreshes_in(0.5, 59.94) == 30);
    CHECK(refreshes_in(1.0 / 120.0, 120.0) == 1);
    CHECK(refreshes_in(0.0001, 120.0) == 1);
}

TEST_CASE("the exponential law that is cut off has its mean, and draws what its formula says", "[unit]") {
    // From 0.5 to 2.5 s with a time constant of 0.5 s.
    const double mean_s = 0.962685;
    CHECK(time_constant_s(0.5, 2.5, mean_s) == Approx(0.5).margin(2e-6));
    const StepDuration duration = cut_exponential(0.5, 2.5, mean_s);
    const std::pair<double, double> known[] = {
        {0.1, 0.551664}, {0.25, 0.640798}, {0.5, 0.837499}, {0.75, 1.166402}, {0.9, 1.575000}};
    for (const auto& [u, seconds] : known)
        CHECK(drawn_s(duration, u) == Approx(seconds).margin(3e-6));
    CHECK(drawn_s(duration, 0.0) == Approx(0.5));
    CHECK(drawn_s(duration, 1.0 - 1e-12) == Approx(2.5).margin(1e-6));
    RandomStream random(1, "durations");
    for (const double wanted_s : {0.6, 0.9, 1.4}) {
        double sum_s = 0.0;
        for (int i = 0; i < 20'000; ++i)
            sum_s += drawn_s(cut_exponential(0.5, 2.5, wanted_s), random.uniform());
        CHECK(sum_s / 20'000 == Approx(wanted_s).margin(0.02));
    }
}

TEST_CASE("durations are drawn by seed, trial and step, and by nothing else", "[unit]") {
    const StepDuration uniform{StepDuration::Law::uniform, {}, 0.5, 1.0, 0.0};
    const StepDuration list{StepDuration::Law::one_of, {0.5, 2.0, 8.0}, 0.0, 0.0, 0.0};
    const Protocol protocol = protocol_with(
        {step_of(StepKind::fixation, uniform), step_of(StepKind::show), step_of(StepKind::blank, list)});
    std::array<int, 3> count{};
    double sum_s = 0.0;
    for (int index = 0; index < 3000; ++index) {
        Trial trial;
        trial.index = index;
        const TrialPlan plan = plan_trial(protocol, 7, trial, false),
                        again = plan_trial(protocol, 7, trial, false);
        REQUIRE(plan.steps.size() == 3);
        CHECK(plan.steps[0].drawn_s == again.steps[0].drawn_s);
        CHECK(plan.steps[0].refreshes == refreshes_in(*plan.steps[0].drawn_s, protocol.display.refresh_hz));
        CHECK((*plan.steps[0].drawn_s >= 0.5 && *plan.steps[0].drawn_s < 1.0));
        CHECK(plan.steps[0].drawn_s != plan_trial(protocol, 8, trial, false).steps[0].drawn_s);
        CHECK(plan.steps[0].drawn_s != plan_trial(protocol, 7, trial, true).steps[0].drawn_s);
        CHECK(plan.steps[1].drawn_s == protocol.motions.front().duration_s);
        sum_s += *plan.steps[0].drawn_s;
        count[*plan.steps[2].drawn_s == 0.5 ? 0 : *plan.steps[2].drawn_s == 2.0 ? 1 : 2]++;
    }
    CHECK(sum_s / 3000 == Approx(0.75).margin(0.01));
    for (const int times : count)
        CHECK(times == Approx(1000).margin(110)); // 4 standard deviations
    // A step more in front of it draws anew, one behind it does not.
    const Protocol longer = protocol_with({step_of(StepKind::fixation, uniform), step_of(StepKind::show),
                                           step_of(StepKind::blank, list), step_of(StepKind::answer)});
    CHECK(plan_trial(longer, 7, {}, false).steps[2].drawn_s ==
          plan_trial(protocol, 7, {}, false).steps[2].drawn_s);
}

TEST_CASE("a task without steps is the question, the drift check, the stimulus and the answer", "[unit]") {
    const Protocol protocol = protocol_with({});
    const TrialPlan plan = plan_trial(protocol, 1, {}, false);
    REQUIRE(plan.steps.size() == 4);
    CHECK(plan.steps[0].kind == StepKind::text);
    CHECK(plan.steps[1].kind == StepKind::drift_check);
    CHECK(plan.steps[2].kind == StepKind::show);
    CHECK(plan.steps[2].refreshes ==
          make_page_cycle(protocol.motions.front(), protocol.display.refresh_hz).total_refreshes);
    CHECK(plan.steps[3].kind == StepKind::answer);
    for (const PlannedStep& step : plan.steps) {
        CHECK_FALSE(step.settings);
        CHECK(step.is_watched == (step.kind == StepKind::show));
    }
    CHECK(describe_steps(protocol, protocol.tasks.front()).empty());
}

TEST_CASE("gaze is recorded around the step that shows, as far as steps may be watched", "[unit]") {
    const auto watched = [](std::vector<StepSettings> steps) { return watched_steps(steps); };
    const StepDuration half{StepDuration::Law::fixed, {0.5}, 0.0, 0.0, 0.0};
    const std::vector<bool> all =
        watched({step_of(StepKind::blank, half), step_of(StepKind::text), step_of(StepKind::fixation, half),
                 step_of(StepKind::show), step_of(StepKind::mask, half), step_of(StepKind::answer),
                 step_of(StepKind::blank, half)});
    CHECK(all == std::vector<bool>{false, false, true, true, true, false, false});
    // Of several shows all are, and what stands between them; an answer parts them.
    CHECK(watched({step_of(StepKind::show), step_of(StepKind::blank, half), step_of(StepKind::show),
                   step_of(StepKind::answer), step_of(StepKind::show)}) ==
          std::vector<bool>{true, true, true, false, true});
}

TEST_CASE("a step shows what the trial has in its slots, and a mask covers what was shown", "[unit]") {
    StepSettings first = step_of(StepKind::show), second = first;
    first.slots = {"one"};
    second.slots = {"two", "three"};
    const StepDuration half{StepDuration::Law::fixed, {0.5}, 0.0, 0.0, 0.0};
    Protocol protocol = protocol_with({step_of(StepKind::mask, half), first, step_of(StepKind::mask, half),
                                       second, step_of(StepKind::mask, half)});
    protocol.slots.clear();
    for (const char* const id : {"one", "two", "three"})
        protocol.slots.push_back({id, id, {}, {}, {}, {}, -1});
    MotionSettings slow = protocol.motions.front();
    slow.duration_s = 3.0;
    protocol.motions.push_back(slow);
    Trial trial;
    trial.beside = {{{0, 0, 0, 1}, 2}};
    const TrialPlan plan = plan_trial(protocol, 1, trial, false);
    using Places = std::vector<int>;
    CHECK(plan.steps[0].places == Places{0}); // before the first, the next
    CHECK(plan.steps[1].places == Places{0});
    CHECK(plan.steps[2].places == Places{0});
    CHECK(plan.steps[3].places == Places{1}); // "two" is empty in this trial
    CHECK(plan.steps[4].places == Places{1});
    CHECK(plan.steps[3].drawn_s == 3.0); // the motion of what it lights
    CHECK(places_shown(protocol, second, Trial{}) == Places{});
    const Trial lit = trial.only(plan.steps[3].places);
    CHECK(lit.slot == 2);
    CHECK(lit.stimulus.motion == 1);
    CHECK(lit.shown_count() == 1);
}

TEST_CASE("steps are described in seconds and in refreshes, with all that can end them", "[unit]") {
    StepSettings fixation = step_of(StepKind::fixation);
    fixation.gaze.emplace();
    fixation.gaze->within_deg = 1.5;
    fixation.gaze->patience_s = 5.0;
    fixation.gaze->otherwise = GazeMissed::drift_check;
    Protocol protocol = protocol_with(
        {fixation, step_of(StepKind::show, StepDuration{StepDuration::Law::fixed, {0.1}, 0, 0, 0})});
    protocol.display.refresh_hz = 144.0;
    const std::string text = describe_steps(protocol, protocol.tasks.front());
    CHECK_THAT(text,
               Contains("1. fixation: a target to be looked at; until gaze is within 1.5 deg for 0.2 s, for "
                        "5 s at most: then a drift check, and the step again"));
    CHECK_THAT(text, Contains("2. show: the trial's stimulus; 0.1 s (14 refreshes, 97.2 ms)"));
    CHECK_THAT(text, Contains("together 0.3 to 5.1 s"));
}
