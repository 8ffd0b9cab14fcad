/// Each fault of a simulated eye tracker, as a session gets to see it.
#include "devices/simulated/faulty_tracker.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/clock_map.h"
#include "tests/devices/simulated/sitting.h"
#include "tests/support/still_setup_screen.h"

using namespace overt;
using namespace overt::test;
using Kind = TrackerFault::Kind;
using namespace std::chrono_literals;

namespace {

/// 500 Hz, polled every 4 ms as a presentation does. Faults strike halfway between two samples: a tracker's
/// clock runs at a rate of its own.
class Bench {
  public:
    explicit Bench(std::vector<TrackerFault> faults, bool both_eyes = false)
        : tracker(std::make_unique<SimulatedEyeTracker>(
                      sitting.clock, sitting.observer, 3,
                      SimulatedTrackerSettings{.rate_hz = 500.0, .both_eyes = both_eyes}),
                  sitting.clock, {.granted_rate_hz = {}, .given = std::move(faults)}) {}

    /// A trial whose recording lasts so long; gives all that it delivers.
    std::vector<TrackerItem> record(int trial, SessionDuration length = 1s) {
        tracker.mark({sitting.clock.now(), fmt::format("TRIALID {}", trial + 1)});
        tracker.start_recording();
        std::vector<TrackerItem> all;
        arrivals.clear();
        state_changed_at.reset();
        const SessionTime begin = sitting.clock.now();
        while (sitting.clock.now() < begin + length) {
            sitting.clock.wait_until(sitting.clock.now() + 4ms);
            take(all, begin);
            if (!state_changed_at && tracker.recording_state() != RecordingState::running)
                state_changed_at = to_seconds(sitting.clock.now() - begin);
        }
        tracker.stop_recording();
        take(all, begin);
        return all;
    }

    SimulatedSitting sitting{3};
    FaultyTracker tracker;
    std::vector<double> arrivals; ///< of each item, in seconds since the recording began
    std::optional<double> state_changed_at;

  private:
    void take(std::vector<TrackerItem>& all, SessionTime begin) {
        std::vector<TrackerItem> some(64);
        std::size_t taken = 0;
        do {
            taken = tracker.poll(some);
            all.insert(all.end(), some.begin(), some.begin() + static_cast<std::ptrdiff_t>(taken));
            arrivals.resize(all.size(), to_seconds(sitting.clock.now() - begin));
        } while (taken == some.size());
    }
};

std::vector<GazeSample> samples_of(const std::vector<TrackerItem>& items) {
    std::vector<GazeSample> samples;
    for (const TrackerItem& item : items)
        if (const auto* sample = std::get_if<GazeSample>(&item))
            samples.push_back(*sample);
    return samples;
}

std::vector<TrackerGap> gaps_of(const std::vector<TrackerItem>& items) {
    std::vector<TrackerGap> gaps;
    for (const TrackerItem& item : items)
        if (const auto* gap = std::get_if<TrackerGap>(&item))
            gaps.push_back(*gap);
    return gaps;
}

bool same(const GazeSample& a, const GazeSample& b) {
    return a.sampled_at == b.sampled_at && a.eye == b.eye && a.gaze.has_value() == b.gaze.has_value() &&
           (!a.gaze || (a.gaze->x_px == b.gaze->x_px && a.gaze->y_px == b.gaze->y_px));
}

} // namespace

TEST_CASE("a tracker without faults, or in other trials, delivers what it measured", "[unit]") {
    Bench sound({}), other({{.kind = Kind::gap, .trial = 4, .s = 1.0}});
    const auto expected = samples_of(sound.record(0)), found = samples_of(other.record(0));
    REQUIRE(found.size() == expected.size());
    CHECK(std::ranges::equal(found, expected, same));
    CHECK(found.size() == 500);
    CHECK(other.tracker.take_struck().empty());
}

TEST_CASE("a gap takes its samples away and says how many they were", "[unit]") {
    for (const auto& [kind, reason] : {std::pair(Kind::gap, TrackerGap::Reason::connection),
                                       std::pair(Kind::garbage, TrackerGap::Reason::unreadable)})
        for (const bool both : {false, true}) {
            Bench sound({}, both), bench({{.kind = kind, .trial = 0, .at_s = 0.199, .s = 0.1}}, both);
            const auto all = samples_of(sound.record(0));
            const auto items = bench.record(0);
            const auto left = samples_of(items);
            const std::size_t eyes = both ? 2 : 1;
            REQUIRE(gaps_of(items).size() == 1);
            const TrackerGap gap = gaps_of(items).front();
            CHECK(gap.reason == reason);
            CHECK(gap.lost_samples == static_cast<std::int64_t>(50 * eyes));
            CHECK(left.size() + 50 * eyes == all.size());
            CHECK(gap.after == left[100 * eyes - 1].sampled_at);
            CHECK(bench.tracker.take_struck() ==
                  std::vector<std::string>{fmt::format("{} for 0.1 s at 0.199 s", name_of(kind))});
        }
}

TEST_CASE("a gap that lasts to the end of a recording is told at its end", "[unit]") {
    Bench bench({{.kind = Kind::gap, .at_s = 0.499, .s = 9.0}});
    const auto items = bench.record(2);
    CHECK(samples_of(items).size() == 250);
    REQUIRE(gaps_of(items).size() == 1);
    CHECK(gaps_of(items).front().lost_samples == 250);
}

TEST_CASE("samples come twice, without an eye, or not yet, as the script says", "[unit]") {
    Bench sound({});
    const auto all = samples_of(sound.record(0));

    Bench doubled({{.kind = Kind::doubled, .at_s = 0.199, .s = 0.1}});
    const auto twice = samples_of(doubled.record(0));
    REQUIRE(twice.size() == all.size() + 50);
    CHECK(same(twice[100], twice[101]));
    CHECK(same(twice[100], all[100]));
    CHECK(same(twice.back(), all.back()));

    Bench blind({{.kind = Kind::no_eye, .at_s = 0.199, .s = 0.1}});
    const auto unseen = samples_of(blind.record(0));
    REQUIRE(unseen.size() == all.size());
    for (std::size_t i = 100; i < 150; ++i)
        CHECK_FALSE(unseen[i].gaze);
    CHECK(unseen[150].gaze.has_value() == all[150].gaze.has_value());

    Bench slow({{.kind = Kind::slow_start, .s = 0.299}});
    const auto late = samples_of(slow.record(0));
    REQUIRE(late.size() + 150 == all.size());
    CHECK(same(late.front(), all[150]));
}

TEST_CASE("after a stall all samples come late, and after a second of it the tracker is lost", "[unit]") {
    Bench sound({}), stalled({{.kind = Kind::stall, .at_s = 0.199, .s = 0.4}});
    const auto all = samples_of(sound.record(0)), late = samples_of(stalled.record(0));
    CHECK(std::ranges::equal(all, late, same));
    CHECK_FALSE(stalled.state_changed_at);
    for (std::size_t i = 0; i < 99; ++i)
        CHECK(stalled.arrivals[i] < 0.22);
    CHECK(stalled.arrivals[101] >= 0.6);

    Bench lost({{.kind = Kind::stall, .at_s = 0.199, .s = 5.0}});
    CHECK(samples_of(lost.record(0, 3s)).size() == 100);
    REQUIRE(lost.state_changed_at);
    CHECK(*lost.state_changed_at == Approx(1.21).margin(0.01));
    CHECK(lost.tracker.lost());
    CHECK_THROWS_WITH(lost.tracker.start_recording(), "the simulated eye tracker is unplugged");
    lost.tracker.reconnect();
    CHECK(samples_of(lost.record(0)).size() == 500); // the second attempt at this trial
}

TEST_CASE("a tracker that is unplugged is lost until it can be connected again", "[unit]") {
    Bench bench({{.kind = Kind::unplug, .trial = 1, .at_s = 0.499, .refusals = 2}});
    CHECK(samples_of(bench.record(0)).size() == 500);
    CHECK(samples_of(bench.record(1)).size() == 250);
    CHECK(*bench.state_changed_at == Approx(0.5).margin(0.01));
    StillSetupScreen setup_screen;
    const char* const unplugged = "the simulated eye tracker is unplugged";
    CHECK_THROWS_WITH(bench.tracker.set_up(setup_screen), unplugged);
    CHECK_THROWS_WITH(bench.tracker.drift_check({}), unplugged);
    CHECK_FALSE(bench.tracker.read_clocks());
    CHECK_THROWS_WITH(bench.tracker.reconnect(), unplugged);
    CHECK_THROWS_WITH(bench.tracker.reconnect(), unplugged);
    bench.tracker.reconnect();
    CHECK_FALSE(bench.tracker.lost());
    CHECK(samples_of(bench.record(1)).size() == 500);

    Bench at_start({{.kind = Kind::unplug, .at_s = 0.0}});
    CHECK_THROWS_WITH(at_start.record(0), unplugged);
}

TEST_CASE("the tracker's host asks for what the script says, once", "[unit]") {
    for (const auto& [kind, state] :
         {std::pair(Kind::repeat, RecordingState::repeat), std::pair(Kind::skip, RecordingState::skip),
          std::pair(Kind::abort, RecordingState::abort)}) {
        Bench bench({{.kind = kind, .trial = 0, .attempt = 2, .at_s = 0.25}});
        bench.record(0);
        CHECK(bench.tracker.recording_state() == RecordingState::running);
        CHECK(samples_of(bench.record(0)).size() == 500);
        CHECK(bench.tracker.recording_state() == state);
        CHECK(*bench.state_changed_at == Approx(0.25).margin(0.01));
        bench.record(0);
        CHECK(bench.tracker.recording_state() == RecordingState::running);
    }
}

TEST_CASE("a clock that jumps does so in samples and in readings, for good", "[unit]") {
    Bench bench({{.kind = Kind::clock_jump, .trial = 0, .at_s = 0.499, .ms = -250.0}});
    const auto before = bench.tracker.read_clocks();
    const auto samples = samples_of(bench.record(0));
    REQUIRE(samples.size() == 500);
    CHECK(samples[250].sampled_at - samples[249].sampled_at == 2ms - 250ms);
    const auto after = bench.tracker.read_clocks();
    REQUIRE((before && after));
    const std::optional<SessionDuration> jump = clock_jump(*before, *after);
    REQUIRE(jump);
    CHECK(to_seconds(*jump) == Approx(-0.25).margin(0.001));
    const auto next = samples_of(bench.record(1));
    CHECK(next.front().sampled_at > samples.back().sampled_at);
    CHECK(next.size() == 500);
}

TEST_CASE("the calibration that is to fail fails, and the one after it does not", "[unit]") {
    Bench bench({{.kind = Kind::calibration, .number = 2}});
    StillSetupScreen setup_screen;
    CHECK(bench.tracker.set_up(setup_screen).kind == SetupOutcome::Kind::done);
    const SetupOutcome failed = bench.tracker.set_up(setup_screen);
    CHECK(failed.kind == SetupOutcome::Kind::failed);
    CHECK(failed.message == "the simulated eye tracker found no eye");
    CHECK(bench.tracker.set_up(setup_screen).kind == SetupOutcome::Kind::done);
    CHECK(bench.tracker.take_struck() == std::vector<std::string>{"calibration 2 failed"});
}

namespace {

/// Gives what waits, and writes down what it is told to do.
class DiaryTracker final : public EyeTracker {
  public:
    explicit DiaryTracker(std::string& calls, std::vector<TrackerItem>& waiting)
        : calls_(calls), waiting_(waiting) {}
    TrackerDescription description() const override { return {"diary", 500.0, Eye::right}; }
    SetupOutcome set_up(SetupScreen&) override { return {}; }
    DriftOutcome drift_check(ScreenPoint) override { return {}; }
    std::optional<ClockPair> read_clocks() noexcept override { return ClockPair{}; }
    void start_recording() override { calls_ += "start "; }
    void stop_recording() override { calls_ += "stop "; }
    void reconnect() override { calls_ += "reconnect "; }
    std::size_t poll(std::span<TrackerItem> into) noexcept override {
        const std::size_t count = std::min(into.size(), waiting_.size());
        std::copy_n(waiting_.begin(), count, into.begin());
        waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(count));
        return count;
    }

  private:
    std::string& calls_;
    std::vector<TrackerItem>& waiting_;
};

} // namespace

TEST_CASE("a fault strikes from its first instant to the one before its end, and what was lost does not come "
          "after a "
          "connection",
          "[unit]") {
    VirtualClock clock;
    std::string calls;
    std::vector<TrackerItem> waiting;
    const auto wait_for = [&](std::initializer_list<int> milliseconds) {
        for (const int at : milliseconds)
            waiting.push_back(GazeSample{.sampled_at = tracker_time(1'000'000 + 1000 * at),
                                         .eye = Eye::right,
                                         .gaze = ScreenPoint{1.0 * at, 0.0}});
    };
    TrackerFault gap{.kind = Kind::gap};
    gap.at_s = 0.25;
    gap.s = 0.25;
    TrackerFault unplug{.kind = Kind::unplug};
    unplug.at_s = 1.0;
    FaultyTracker tracker(std::make_unique<DiaryTracker>(calls, waiting), clock,
                          {.granted_rate_hz = {}, .given = {gap, unplug}});
    tracker.mark({clock.now(), "TRIALID 1"});
    const auto polled = [&] {
        std::vector<TrackerItem> items(64);
        items.resize(tracker.poll(items));
        std::string all;
        for (const TrackerItem& item : items)
            if (const auto* sample = std::get_if<GazeSample>(&item))
                all += fmt::format("{} ", sample->gaze->x_px);
            else if (const auto* lost = std::get_if<TrackerGap>(&item))
                all += fmt::format("gap of {} ", lost->lost_samples);
            else if (const auto* pressed = std::get_if<TrackerButton>(&item))
                all += fmt::format("button {} ", pressed->number);
        return all;
    };
    tracker.start_recording();
    const TrackerButton button{tracker_time(5), 3, true};
    wait_for({0, 249});
    waiting.push_back(button);
    wait_for({250});
    waiting.push_back(button); // of the gap
    wait_for({499, 500, 999, 1000, 1001, 1002});
    CHECK(polled() == "0 249 button 3 gap of 2 500 999 ");
    CHECK(tracker.recording_state() == RecordingState::lost);
    CHECK_FALSE(tracker.read_clocks());
    tracker.reconnect();
    CHECK(calls == "start stop reconnect ");
    CHECK(tracker.recording_state() == RecordingState::running);
    CHECK(polled().empty());
    wait_for({2000, 2001});
    CHECK(polled() == "2000 2001 ");
}

TEST_CASE("a slow start ends at its instant, and a clock that jumps takes all items with it", "[unit]") {
    VirtualClock clock;
    std::string calls;
    std::vector<TrackerItem> waiting;
    TrackerFault slow{.kind = Kind::slow_start};
    slow.s = 0.25;
    TrackerFault jump{.kind = Kind::clock_jump};
    jump.at_s = 0.5;
    jump.ms = 40.0;
    FaultyTracker tracker(std::make_unique<DiaryTracker>(calls, waiting), clock,
                          {.granted_rate_hz = {}, .given = {slow, jump}});
    tracker.mark({clock.now(), "TRIALID 1"});
    tracker.start_recording();
    for (const int at : {0, 249, 250, 499, 500, 501})
        waiting.push_back(
            GazeSample{.sampled_at = tracker_time(1'000'000 + 1000 * at), .eye = Eye::right, .gaze = {}});
    waiting.push_back(TrackerButton{tracker_time(1'502'000), 3, true});
    std::vector<TrackerItem> items(16);
    items.resize(tracker.poll(items));
    REQUIRE(items.size() == 5);
    const std::int64_t wanted[] = {1'250'000, 1'499'000, 1'540'000, 1'541'000};
    for (std::size_t i = 0; i < 4; ++i)
        CHECK(std::get<GazeSample>(items[i]).sampled_at == tracker_time(wanted[i]));
    CHECK(std::get<TrackerButton>(items[4]).at == tracker_time(1'542'000));
    CHECK(tracker.read_clocks()->other == tracker_time(40'000));
    tracker.stop_recording();
    CHECK(tracker.take_struck().size() == 2);
    CHECK(tracker.take_struck().empty());
}

TEST_CASE("what was withheld before a connection is not told of after it, and a second attempt has faults of "
          "its own",
          "[unit]") {
    Bench bench({{.kind = Kind::gap, .trial = 0, .at_s = 0.099, .s = 5.0},
                 {.kind = Kind::unplug, .trial = 0, .at_s = 0.199}});
    bench.record(0, 400ms);
    REQUIRE(bench.tracker.recording_state() == RecordingState::lost);
    bench.tracker.reconnect();
    const std::vector<TrackerItem> again = bench.record(0, 400ms);
    CHECK(samples_of(again).size() == 200);
    CHECK(gaps_of(again).empty());
    CHECK(bench.tracker.recording_state() == RecordingState::running);
    CHECK(bench.tracker.take_struck() ==
          std::vector<std::string>{"gap for 5 s at 0.099 s", "unplug at 0.199 s"});
}

TEST_CASE("samples that are lost on either side of a connection are counted from it", "[unit]") {
    VirtualClock clock;
    std::string calls;
    std::vector<TrackerItem> waiting;
    TrackerFault gap{.kind = Kind::gap};
    gap.at_s = 0.1;
    gap.s = 2.0;
    TrackerFault unplug{.kind = Kind::unplug};
    unplug.at_s = 1.0;
    FaultyTracker tracker(std::make_unique<DiaryTracker>(calls, waiting), clock,
                          {.granted_rate_hz = {}, .given = {gap, unplug}});
    tracker.mark({clock.now(), "TRIALID 1"});
    tracker.start_recording();
    const auto poll_after = [&](std::initializer_list<int> milliseconds) {
        for (const int at : milliseconds)
            waiting.push_back(
                GazeSample{.sampled_at = tracker_time(1'000 * at), .eye = Eye::right, .gaze = {}});
        std::vector<TrackerItem> items(16);
        items.resize(tracker.poll(items));
        return items;
    };
    CHECK(poll_after({1000, 1200, 1400, 1600, 2000}).size() == 1);
    tracker.reconnect();
    CHECK(poll_after({3000}).empty());
    const std::vector<TrackerItem> items = poll_after({3100});
    REQUIRE(items.size() == 2);
    CHECK(std::get<TrackerGap>(items[0]).lost_samples == 1);
    CHECK(std::get<TrackerGap>(items[0]).reason == TrackerGap::Reason::connection);
}

TEST_CASE(
    "a tracker that is unplugged when a recording begins says so once, and refuses as often as it is told",
    "[unit]") {
    Bench bench({{.kind = Kind::unplug, .trial = 0, .at_s = 0.0, .refusals = 1}});
    CHECK_THROWS_AS(bench.record(0), DeviceError);
    CHECK(bench.tracker.recording_state() == RecordingState::lost);
    CHECK(bench.tracker.take_struck() == std::vector<std::string>{"unplug at 0 s"});
    CHECK_THROWS_AS(bench.tracker.reconnect(), DeviceError);
    bench.tracker.reconnect();
    CHECK(samples_of(bench.record(0)).size() == 500);
    CHECK(bench.tracker.take_struck().empty());
}

TEST_CASE("a stall that lost its tracker is over once it is connected, and no fault strikes in practice",
          "[unit]") {
    Bench bench({{.kind = Kind::stall, .at_s = 0.099, .s = 5.0}});
    bench.tracker.mark({bench.sitting.clock.now(), "TRIALID practice"});
    bench.tracker.start_recording();
    bench.sitting.clock.wait_until(bench.sitting.clock.now() + 2s);
    std::vector<TrackerItem> some(2000);
    CHECK(bench.tracker.poll(some) >= 999);
    bench.tracker.stop_recording();
    CHECK(bench.tracker.take_struck().empty());

    bench.record(0, 1500ms);
    REQUIRE(bench.tracker.recording_state() == RecordingState::lost);
    bench.tracker.reconnect();
    for (int i = 0; i < 100; ++i) {
        bench.sitting.clock.wait_until(bench.sitting.clock.now() + 20ms);
        bench.tracker.poll(some);
        CHECK(bench.tracker.recording_state() == RecordingState::running);
    }
    CHECK(samples_of(bench.record(0, 400ms)).size() == 200);
    // A stall that a recording's end cuts short holds nothing back of the next.
    Bench shorter({{.kind = Kind::stall, .trial = 0, .at_s = 0.099, .s = 0.9}});
    CHECK(samples_of(shorter.record(0, 300ms)).size() == 150);
    CHECK(samples_of(shorter.record(1, 300ms)).size() == 150);
    CHECK(shorter.arrivals.front() < 0.01);
}
