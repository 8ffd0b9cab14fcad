/// Recordings that are played back, by samples, events and times that are known.
#include "devices/replay/replay_tracker.h"

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "tests/support/asc_text.h"
#include "tests/support/counted_clock.h"
#include "tests/support/diary_setup_screen.h"
#include "tests/support/temporary_folder.h"

using namespace overt;
using namespace overt::test;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;
using overt::testing::AscExample;

namespace {

/// An EyeLink recording of two trials, 500 samples a second, of which each has a fixation, a blink and a
/// saccade.
struct Replay {
    explicit Replay(const AscExample& example = {})
        : recording(overt::testing::write_asc(folder.path() / "r.asc", asc_text(example))),
          tracker(recording, clock) {}

    std::vector<GazeSample> poll(std::size_t room = 400) {
        std::vector<TrackerItem> items(room);
        const std::size_t count = tracker.poll(items);
        std::vector<GazeSample> samples;
        for (std::size_t i = 0; i < count; ++i)
            if (const auto* sample = std::get_if<GazeSample>(&items[i]))
                samples.push_back(*sample);
        items.resize(count);
        all.insert(all.end(), items.begin(), items.end());
        return samples;
    }
    TrackerTime now() { return tracker.read_clocks()->other; }

    TemporaryFolder folder;
    std::filesystem::path recording;
    CountedClock clock;
    ReplayTracker tracker;
    std::vector<TrackerItem> all; ///< that were polled
};

template <class Item> std::size_t count_of(const std::vector<TrackerItem>& items) {
    return static_cast<std::size_t>(std::ranges::count_if(
        items, [](const TrackerItem& item) { return std::holds_alternative<Item>(item); }));
}

} // namespace

TEST_CASE("a recording that is played back tells what it is of, and each of its set-ups once", "[unit]") {
    Replay replay;
    const TrackerDescription told = replay.tracker.description();
    CHECK(told.name == "replay");
    CHECK(told.sample_rate_hz == 500.0);
    CHECK(told.eye == Eye::left);
    CHECK_FALSE(told.both_eyes);
    CHECK_THAT(told.model, Catch::StartsWith("gaze of r.asc, by "));
    CHECK(replay.tracker.tells_events());
    DiarySetupScreen screen(replay.clock);
    const SetupOutcome set_up = replay.tracker.set_up(screen);
    CHECK(set_up.kind == SetupOutcome::Kind::done);
    CHECK_FALSE(set_up.validation);
    CHECK(set_up.method == "replay");
    CHECK_THAT(set_up.message, Contains("no validation"));
    AscExample both;
    both.right = true;
    CHECK(Replay(both).tracker.description().both_eyes);
    AscExample right;
    right.left = false;
    right.right = true;
    right.has_header = false;
    right.has_events = false;
    Replay other(right);
    CHECK(other.tracker.description().eye == Eye::right);
    CHECK_FALSE(other.tracker.tells_events());
}

TEST_CASE("without an onset, gaze is played back from the recording's beginning, each item when it is due",
          "[unit]") {
    Replay replay;
    replay.tracker.start_recording();
    const TrackerTime began = replay.now();
    CHECK(replay.poll().size() == 1); // the first is due at once
    replay.clock.time += 2ms - 1us;
    CHECK(replay.poll().empty());
    replay.clock.time += 1us;
    std::vector<GazeSample> samples = replay.poll();
    REQUIRE(samples.size() == 1);
    CHECK((samples[0].sampled_at - began) == 2ms);
    CHECK(samples[0].gaze->x_px == Approx(100.1));
    replay.clock.time += 18ms;
    CHECK(replay.poll(4).size() == 4); // as many as there is room for
    samples = replay.poll();
    REQUIRE(samples.size() == 5);
    CHECK((samples.back().sampled_at - began) == 20ms);
    replay.clock.time += 1s;
    CHECK(replay.poll().size() == 49);
    CHECK(replay.poll().empty());
    CHECK(count_of<GazeSample>(replay.all) == 60);
    CHECK(count_of<TrackerEvent>(replay.all) == 3);
    // In the order in which the tracker told them.
    std::vector<TrackerTime> times;
    for (const TrackerItem& item : replay.all)
        if (const auto* event = std::get_if<TrackerEvent>(&item))
            times.push_back(event->end);
        else if (const auto* sample = std::get_if<GazeSample>(&item))
            times.push_back(sample->sampled_at);
    CHECK(std::ranges::is_sorted(times));
}

TEST_CASE("a recording that is stopped gives what was due until then, whenever it is asked", "[unit]") {
    Replay replay;
    CHECK(replay.poll().empty());
    replay.tracker.start_recording();
    replay.clock.time += 9950us; // the sample at 10 ms is within what times are rounded by
    replay.tracker.stop_recording();
    replay.clock.time += 1s;
    replay.tracker.stop_recording(); // it is over already
    CHECK(replay.poll().size() == 6);
    CHECK(replay.poll().empty());
    // Started anew, it begins anew.
    replay.tracker.start_recording();
    replay.clock.time += 9800us;
    replay.tracker.stop_recording();
    CHECK(replay.poll().size() == 5);
}

TEST_CASE("gaze of a recording meets what is shown at its onset, when the trial's trackers are told of it",
          "[unit]") {
    Replay replay;
    replay.tracker.mark({replay.clock.now(), "SYNCTIME"}); // of no trial
    replay.tracker.mark({replay.clock.now(), "TRIALID 2"});
    replay.tracker.start_recording();
    replay.clock.time += 1s;
    CHECK(replay.poll().empty()); // the onset is not told yet
    const SessionTime shown = replay.clock.time - 7ms;
    replay.tracker.mark({shown, "SYNCTIME and more"});
    replay.tracker.mark({shown, "!V TRIAL_VAR object vase"}); // an imported recording tells no object
    CHECK(replay.poll().empty());
    replay.tracker.mark({shown, "SYNCTIME"});
    const std::vector<GazeSample> samples = replay.poll();
    REQUIRE(samples.size() == 14); // 20 ms before the onset, and 6 ms after it
    CHECK(samples[10].gaze->x_px == Approx(201.0));
    CHECK(replay.now() - samples[10].sampled_at == 7ms);
    CHECK(replay.tracker.finish("", {}).empty());
}

TEST_CASE("each trial is played back by its number, and what has no counterpart is said at the end",
          "[unit]") {
    Replay replay;
    const auto played = [&](std::string mark) {
        replay.tracker.mark({replay.clock.now(), mark});
        replay.tracker.start_recording();
        replay.tracker.mark({replay.clock.now(), "SYNCTIME"});
        replay.clock.time += 10s;
        const std::vector<GazeSample> samples = replay.poll();
        replay.tracker.stop_recording();
        return samples.empty() ? 0.0 : samples.front().gaze->x_px;
    };
    CHECK(played("TRIALID 2") == Approx(200.0));
    CHECK(played("TRIALID 1") == Approx(100.0));
    CHECK(played("TRIALID 1") == Approx(100.0)); // another attempt than was recorded: the last one
    CHECK(replay.tracker.finish("", {}).empty());
    CHECK(played("TRIALID practice 1") == 0.0);
    CHECK(replay.tracker.finish("", {}).empty()); // practice is nobody's counterpart
    CHECK(played("TRIALID 3") == 0.0);
    CHECK(replay.tracker.finish("", {}) ==
          std::vector<std::string>{"1 trial of the recording had no gaze to be played back: 3"});
    CHECK(played("TRIALID 7") == 0.0);
    CHECK(replay.tracker.finish("", {}) ==
          std::vector<std::string>{"2 trials of the recording had no gaze to be played back: 3, 7"});
}

TEST_CASE("a check of drift of a recording takes a tenth of a second, and tells what was found then",
          "[unit]") {
    Replay replay;
    CHECK(replay.tracker.drift_check({1.0, 2.0}).kind == DriftOutcome::Kind::no_eye);
    CHECK(replay.clock.waits == std::vector<SessionDuration>{100ms});
    replay.tracker.mark({replay.clock.now(), "TRIALID 1"});
    CHECK(replay.tracker.drift_check({1.0, 2.0}).kind == DriftOutcome::Kind::no_eye); // none was recorded
}

TEST_CASE("what is no recording that can be played back is refused with what to name", "[unit]") {
    CountedClock clock;
    const TemporaryFolder folder;
    CHECK_THROWS_WITH(ReplayTracker("", clock), Contains("needs a recording"));
    CHECK_THROWS_WITH(ReplayTracker(folder.path() / "none", clock), Contains("is not there"));
    AscExample empty;
    empty.has_samples = false;
    CHECK_THROWS_AS(Replay(empty), Error);
}
