/// A driver on its own thread: nothing is lost or doubled, what has no room is told, and what the driver
/// says of the recording comes through.
#include <catch2/catch.hpp>

#include <array>
#include <atomic>
#include <mutex>
#include <thread>

#include "devices/host/clocks.h"
#include "devices/tracker/threaded_tracker.h"
#include "experiment/base/error.h"
#include "tests/devices/tracker/scripted_driver.h"
#include "tests/support/counted_clock.h"

using namespace overt;
using namespace overt::test;
using namespace std::chrono_literals;

namespace {

struct TrackerBench {
    SteadyClock clock;
    DriverDiary diary;
    ThreadedTracker tracker;
    explicit TrackerBench(double rate_hz = 2000.0, std::size_t ring = std::size_t{1} << 16)
        : tracker(std::make_unique<ScriptedDriver>(clock, diary, rate_hz), clock,
                  {.rate_hz = rate_hz, .screen = {}}, ring) {}

    std::vector<TrackerItem> take_all() {
        std::vector<TrackerItem> all;
        std::array<TrackerItem, 100> some;
        for (std::size_t taken = some.size(); taken == some.size();) {
            taken = tracker.poll(some);
            all.insert(all.end(), some.begin(), some.begin() + static_cast<std::ptrdiff_t>(taken));
        }
        return all;
    }
};

template <class Kind> std::vector<Kind> all_of(const std::vector<TrackerItem>& items) {
    std::vector<Kind> found;
    for (const TrackerItem& item : items)
        if (const auto* one = std::get_if<Kind>(&item))
            found.push_back(*one);
    return found;
}

/// Waits for what another thread does; not for ever.
bool comes_true(const std::function<bool()>& condition) {
    bool is_true = condition();
    for (int i = 0; i < 2000 && !is_true; ++i) {
        std::this_thread::sleep_for(5ms);
        is_true = condition();
    }
    return is_true;
}

} // namespace

TEST_CASE("each sample of a driver arrives once, in order, with clock readings between", "[unit]") {
    TrackerBench bench;
    bench.tracker.start_recording();
    std::vector<TrackerItem> items;
    const SessionTime end = bench.clock.now() + 1300ms;
    while (bench.clock.now() < end) {
        std::this_thread::sleep_for(8ms);
        const std::vector<TrackerItem> more = bench.take_all();
        items.insert(items.end(), more.begin(), more.end());
    }
    bench.tracker.stop_recording();
    const std::vector<TrackerItem> last = bench.take_all();
    items.insert(items.end(), last.begin(), last.end());
    const std::vector<GazeSample> samples = all_of<GazeSample>(items);
    REQUIRE(samples.size() > 2000);
    for (std::size_t i = 0; i < samples.size(); ++i)
        REQUIRE(samples[i].gaze->x_px == static_cast<double>(i));
    CHECK_FALSE(all_of<ClockPair>(items).empty());
    CHECK(all_of<TrackerGap>(items).empty());
    CHECK(bench.diary.starts == 1);
    CHECK(bench.diary.stops == 1);
    CHECK_FALSE(bench.tracker.lost());
}

TEST_CASE("samples that nobody takes are told as a gap, with their number", "[unit]") {
    TrackerBench bench(2000.0, 256);
    bench.tracker.start_recording();
    REQUIRE(comes_true([&] { return bench.diary.reads > 200; }));
    std::vector<TrackerItem> items = bench.take_all();
    REQUIRE(comes_true([&] {
        const std::vector<TrackerItem> more = bench.take_all();
        items.insert(items.end(), more.begin(), more.end());
        return !all_of<TrackerGap>(items).empty();
    }));
    const std::size_t gap_at = static_cast<std::size_t>(
        std::ranges::find_if(items,
                             [](const auto& item) { return std::holds_alternative<TrackerGap>(item); }) -
        items.begin());
    const TrackerGap gap = std::get<TrackerGap>(items[gap_at]);
    REQUIRE(gap_at + 1 < items.size());
    const auto before = std::get<GazeSample>(items[gap_at - 1]);
    const auto* after = std::get_if<GazeSample>(&items[gap_at + 1]);
    REQUIRE(after);
    CHECK(gap.reason == TrackerGap::Reason::overflow);
    CHECK(gap.after == before.sampled_at);
    CHECK(static_cast<double>(gap.lost_samples) == after->gaze->x_px - before.gaze->x_px - 1.0);
    bench.tracker.stop_recording();
}

TEST_CASE("marks reach the driver in order, before, in and after a recording", "[unit]") {
    TrackerBench bench;
    bench.tracker.mark({bench.clock.now(), "TRIALID 1"});
    bench.tracker.start_recording();
    for (int i = 0; i < 100; ++i)
        bench.tracker.mark({bench.clock.now(), "FRAME " + std::to_string(i)});
    bench.tracker.mark({bench.clock.now(), std::string(500, 'x')});
    bench.tracker.stop_recording();
    bench.tracker.mark({bench.clock.now(), "TRIAL_RESULT 0"});
    REQUIRE(bench.diary.marks.size() == 103);
    CHECK(bench.diary.marks.front() == "TRIALID 1");
    for (int i = 0; i < 100; ++i)
        CHECK(bench.diary.marks[static_cast<std::size_t>(1 + i)] == "FRAME " + std::to_string(i));
    CHECK(bench.diary.marks[101] == std::string(longest_mark, 'x'));
    CHECK(bench.diary.marks.back() == "TRIAL_RESULT 0");
}

TEST_CASE("what becomes of a recording at the tracker is seen, and a lost tracker can be had again",
          "[unit]") {
    TrackerBench bench;
    for (const RecordingState state : {RecordingState::repeat, RecordingState::skip, RecordingState::abort}) {
        bench.tracker.start_recording();
        CHECK(bench.tracker.recording_state() == RecordingState::running);
        bench.diary.state = state;
        CHECK(comes_true([&] { return bench.tracker.recording_state() == state; }));
        bench.tracker.stop_recording();
        bench.diary.state = RecordingState::running;
    }
    bench.tracker.start_recording();
    bench.diary.unplugged = true;
    REQUIRE(comes_true([&] { return bench.tracker.lost(); }));
    bench.tracker.stop_recording();
    CHECK(bench.tracker.lost());
    bench.diary.unplugged = false;
    bench.tracker.reconnect();
    CHECK_FALSE(bench.tracker.lost());
    CHECK(bench.diary.connects == 2);
    bench.tracker.start_recording();
    CHECK(comes_true([&] { return !bench.take_all().empty(); }));
}

TEST_CASE("drift is measured from samples where a tracker has no check of its own", "[unit]") {
    // The x of the samples runs away: nothing rests.
    TrackerBench bench;
    CHECK(bench.tracker.drift_check({960.0, 540.0}).kind == DriftOutcome::Kind::no_eye);
    CHECK(bench.diary.stops == 1);
}

TEST_CASE("who listens is told of each sample that poll() gives, at once and in order", "[unit]") {
    struct Listener final : SampleListener {
        void measured(const GazeSample& sample) noexcept override {
            const std::lock_guard lock(mutex);
            heard.push_back(sample.gaze->x_px);
        }
        std::size_t count() {
            const std::lock_guard lock(mutex);
            return heard.size();
        }
        std::mutex mutex;
        std::vector<double> heard;
    };
    TrackerBench bench;
    Listener listener;
    CHECK(bench.tracker.tell_samples_to(&listener));
    bench.tracker.start_recording();
    REQUIRE(comes_true([&] { return listener.count() > 200; })); // nobody polls
    bench.tracker.stop_recording();
    const std::vector<GazeSample> samples = all_of<GazeSample>(bench.take_all());
    REQUIRE(samples.size() == listener.heard.size());
    for (std::size_t i = 0; i < samples.size(); ++i)
        REQUIRE(samples[i].gaze->x_px == listener.heard[i]);
    bench.tracker.tell_samples_to(nullptr);
    bench.tracker.start_recording();
    std::this_thread::sleep_for(20ms);
    bench.tracker.stop_recording();
    CHECK(listener.heard.size() == samples.size());
}

namespace {

/// Notes when it is read and until when it may wait, in a time of its own, which each of the first twelve
/// readings takes 300 ms of.
struct NotedReadings {
    std::mutex mutex;
    std::vector<SessionDuration> waits;
    std::atomic<int> readings{0};
};

class TimedDriver final : public TrackerDriver {
  public:
    TimedDriver(CountedClock& clock, NotedReadings& noted) : clock_(clock), noted_(noted) {}
    TrackerDescription connect(const TrackerWish& wish) override { return {"timed", 10.0, wish.eye}; }
    void start() override {}
    void stop() noexcept override {}
    RecordingState read(TrackerItemSink& sink, SessionTime deadline) noexcept override {
        const int reading = ++noted_.readings;
        {
            const std::lock_guard lock(noted_.mutex);
            noted_.waits.push_back(deadline - clock_.time);
        }
        if (reading <= 12) {
            GazeSample sample;
            sample.sampled_at = tracker_time(reading);
            sink.put(sample);
            clock_.time += 300ms;
        }
        return RecordingState::running;
    }
    std::optional<ClockPair> read_clocks() noexcept override {
        return ClockPair{clock_.time, tracker_time(7), clock_.time};
    }
    std::vector<std::string> finish(const std::string&, const EyeTracker::FileProgress&) override {
        return {"its own word"};
    }

  private:
    CountedClock& clock_;
    NotedReadings& noted_;
};

} // namespace

TEST_CASE("a driver is read for 2 ms at a time and thrice at the end, and its clock once a second",
          "[unit]") {
    CountedClock clock;
    NotedReadings noted;
    ThreadedTracker tracker(std::make_unique<TimedDriver>(clock, noted), clock, {});
    const auto before = tracker.read_clocks();
    REQUIRE(before);
    tracker.start_recording();
    REQUIRE(comes_true([&] { return noted.readings > 14; }));
    CHECK_FALSE(tracker.read_clocks()); // the thread reads it
    tracker.stop_recording();
    CHECK(tracker.read_clocks());
    const std::size_t count = noted.waits.size();
    REQUIRE(count > 16);
    for (std::size_t i = 0; i < count; ++i) {
        CAPTURE(i, count);
        CHECK(noted.waits[i] == (i + 3 < count ? 2ms : 0ms));
    }
    std::string order;
    std::array<TrackerItem, 4> some;
    while (const std::size_t taken = tracker.poll(some))
        for (std::size_t i = 0; i < taken; ++i)
            order += std::holds_alternative<GazeSample>(some[i]) ? 's' : 'c';
    // Readings begin at 0, 0.3, 0.6 s and so on; the clock is read after the one that begins at 1.2 s.
    CHECK(order == "ssssscsssscsssc");
    // What was not taken before the next recording is none of it.
    noted.readings = 0;
    tracker.start_recording();
    REQUIRE(comes_true([&] { return noted.readings > 3; }));
    tracker.stop_recording();
    noted.readings = 100;
    tracker.start_recording();
    tracker.stop_recording();
    CHECK(tracker.poll(some) == 0);
    CHECK(tracker.finish("", {}) == std::vector<std::string>{"its own word"});
}

namespace {

/// Does not come back from its reading before it may.
class HeldDriver final : public TrackerDriver {
  public:
    struct Hold {
        std::atomic<bool> is_reading{false}, may_go{false};
        std::atomic<int> marks{0};
    };
    explicit HeldDriver(Hold& hold) : hold_(hold) {}
    TrackerDescription connect(const TrackerWish& wish) override { return {"held", 10.0, wish.eye}; }
    void start() override {}
    void stop() noexcept override {}
    RecordingState read(TrackerItemSink&, SessionTime) noexcept override {
        hold_.is_reading = true;
        while (!hold_.may_go)
            std::this_thread::sleep_for(1ms);
        return RecordingState::running;
    }
    void send(const TrackerMark&) noexcept override { ++hold_.marks; }
    std::optional<ClockPair> read_clocks() noexcept override { return std::nullopt; }

  private:
    Hold& hold_;
};

} // namespace

TEST_CASE("1024 marks wait for a driver that reads, and those that find no room are counted", "[unit]") {
    SteadyClock clock;
    HeldDriver::Hold hold;
    ThreadedTracker tracker(std::make_unique<HeldDriver>(hold), clock, {});
    tracker.start_recording();
    REQUIRE(comes_true([&] { return hold.is_reading.load(); }));
    for (int i = 0; i < 1027; ++i)
        tracker.mark({clock.now(), "M"});
    hold.may_go = true;
    tracker.stop_recording();
    CHECK(hold.marks == 1024);
    CHECK(tracker.finish("", {}) ==
          std::vector<std::string>{"3 messages for the tracker's file were lost: too many at once"});
}

TEST_CASE("a recording under way ends before its tracker is connected anew, or is gone", "[unit]") {
    SteadyClock clock;
    DriverDiary diary;
    {
        ThreadedTracker tracker(std::make_unique<ScriptedDriver>(clock, diary, 500.0), clock,
                                {.rate_hz = 500.0, .screen = {}}, 4096);
        tracker.start_recording();
        REQUIRE(comes_true([&] { return diary.reads > 2; }));
        tracker.reconnect();
        CHECK(diary.stops == 1);
        CHECK(diary.connects == 2);
        const int reads = diary.reads;
        std::this_thread::sleep_for(20ms);
        CHECK(diary.reads == reads); // nobody reads any more
        CHECK(tracker.read_clocks());
        tracker.start_recording();
        CHECK_FALSE(tracker.read_clocks());
        REQUIRE(comes_true([&] { return diary.reads > reads; }));
        CHECK(diary.stops == 1);
    }
    CHECK(diary.stops == 2);
    {
        const ThreadedTracker idle(std::make_unique<ScriptedDriver>(clock, diary, 500.0), clock,
                                   {.rate_hz = 500.0, .screen = {}}, 4096);
    }
    CHECK(diary.stops == 2);
}
