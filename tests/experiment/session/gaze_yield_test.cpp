/// How much of its gaze a recording gave, and what is made of that.
#include "experiment/ports/gaze_yield.h"

#include <deque>

#include <catch2/catch.hpp>

#include "experiment/ports/area_view.h"
#include "experiment/session/gaze_watch.h"
#include "experiment/session/step_screens.h"
#include "experiment/session/tracker_feed.h"
#include "tests/experiment/record/plain_session.h"

using namespace overt;
using namespace overt::test;

namespace {

constexpr double rate_hz = 500.0;

/// Samples of one eye from one time to another, s; `blind`: none of them with gaze.
void give(GazeYieldCount& count, double from_s, double to_s, Eye eye = Eye::right, bool blind = false) {
    for (int i = 0; from_s + i / rate_hz < to_s; ++i) {
        GazeSample sample{.sampled_at = TrackerTime(
                              std::chrono::microseconds(std::llround(1e6 * (100.0 + from_s + i / rate_hz)))),
                          .eye = eye,
                          .gaze = {}};
        if (!blind)
            sample.gaze = ScreenPoint{1.0, 2.0};
        count.take(sample);
    }
}

GazeYieldCount begun(bool both_eyes = false) {
    GazeYieldCount count;
    count.begin(rate_hz, both_eyes ? 2 : 1);
    return count;
}

constexpr SessionDuration eight_seconds = std::chrono::seconds(8);

} // namespace

TEST_CASE("all that comes is all there should be, but for what a tracker needs to begin", "[unit]") {
    GazeYieldCount count = begun();
    give(count, 0.2, 8.0);
    const GazeYield gaze = count.ended_after(eight_seconds);
    CHECK(gaze.missing == 0);
    CHECK(gaze.share() == 1.0);
}

TEST_CASE("what no eye was found in, what never came, and what came of one eye alone is missing", "[unit]") {
    SECTION("no eye") {
        GazeYieldCount count = begun();
        give(count, 0.0, 2.0);
        give(count, 2.0, 8.0, Eye::right, true);
        CHECK(count.ended_after(eight_seconds).share() == Approx(0.25));
        CHECK(count.ended_after(eight_seconds).missing == 0);
    }
    SECTION("a gap") {
        GazeYieldCount count = begun();
        give(count, 0.0, 1.0);
        give(count, 7.0, 8.0);
        CHECK(count.ended_after(eight_seconds).missing == Approx(3000).margin(2));
        CHECK(count.ended_after(eight_seconds).share() == Approx(0.25).margin(0.001));
    }
    SECTION("an end that comes early") {
        GazeYieldCount count = begun();
        give(count, 0.0, 2.0);
        CHECK(count.ended_after(eight_seconds).share() == Approx(0.25).margin(0.001));
    }
    SECTION("nothing at all") {
        GazeYieldCount count = begun();
        CHECK(count.ended_after(eight_seconds).missing == 4000);
        CHECK(count.ended_after(eight_seconds).share() == 0.0);
    }
    SECTION("one of two eyes") {
        GazeYieldCount count = begun(true);
        give(count, 0.0, 8.0);
        CHECK(count.ended_after(eight_seconds).share() == Approx(0.5).margin(0.001));
    }
    SECTION("a rate that is not known") {
        GazeYieldCount count;
        count.begin(0.0, 1);
        CHECK(count.ended_after(eight_seconds).share() == 0.0);
        give(count, 0.0, 1.0);
        CHECK(count.ended_after(eight_seconds).share() == 1.0);
    }
}

TEST_CASE("an attempt without gaze counts where the protocol repeats none for it, and says what it lacks",
          "[unit]") {
    Sitting sitting(short_protocol(""));
    sitting.tracker.blind = {0};
    CHECK(sitting.run().completed_trials == 2);
    REQUIRE(sitting.log.outcomes.size() == 2);
    CHECK(sitting.log.completed[0]);
    CHECK(sitting.log.outcomes[0].failure == "gaze lost");
    CHECK(sitting.log.outcomes[1].failure.empty());
    REQUIRE(sitting.log.outcomes[0].gaze);
    CHECK(sitting.log.outcomes[0].gaze->share() == 0.0);
    CHECK(sitting.log.outcomes[1].gaze->share() == 1.0);
    // The record of the tracker has the same.
    REQUIRE(sitting.log.yields.size() == 2);
    CHECK(sitting.log.yields[0] == *sitting.log.outcomes[0].gaze);
    const auto said = sitting.log.details_of("trial failed");
    REQUIRE(said.size() == 1);
    CHECK_THAT(said[0], Catch::Contains("gaze lost") && Catch::Contains("counts as it is"));

    Sitting repeated(short_protocol("[repeat]\ngaze_lost = \"now\"\n"));
    repeated.tracker.blind = {0};
    CHECK(repeated.run().completed_trials == 2);
    CHECK(repeated.log.completed == std::vector<bool>{false, true, true});

    // Without a tracker there is nothing to lack.
    Sitting without(short_protocol(""));
    without.tracker.is_there = false;
    without.run();
    REQUIRE(without.log.outcomes.size() == 2);
    CHECK(without.log.outcomes[0].failure.empty());
    CHECK_FALSE(without.log.outcomes[0].gaze);
}

namespace {

/// Delivers what it was given, and reads its clock as it is told.
class ListedTracker final : public EyeTracker {
  public:
    TrackerDescription description() const override { return {"listed", 500.0, Eye::left, both_eyes}; }
    SetupOutcome set_up(SetupScreen&) override { return {}; }
    DriftOutcome drift_check(ScreenPoint) override { return {}; }
    std::optional<ClockPair> read_clocks() noexcept override {
        if (readings.empty())
            return std::nullopt;
        const ClockPair pair = readings.front();
        readings.pop_front();
        return pair;
    }
    void start_recording() override {
        if (fails)
            throw DeviceError("it does not begin");
    }
    void stop_recording() override { ++stops; }
    std::size_t poll(std::span<TrackerItem> into) noexcept override {
        ++polls;
        std::size_t count = 0;
        for (; count < into.size() && !items.empty(); ++count, items.pop_front())
            into[count] = items.front();
        return count;
    }
    RecordingState recording_state() const noexcept override { return says; }

    bool both_eyes = false, fails = false;
    std::deque<TrackerItem> items;
    std::deque<ClockPair> readings;
    RecordingState says = RecordingState::running;
    int polls = 0, stops = 0;
};

class ItemsLog final : public SessionLog {
  public:
    void flip(const FlipRecord&) noexcept override {}
    void missed(const MissedRefresh&) noexcept override {}
    void sample(int trial, const GazeSample& sample) noexcept override {
        CHECK(trial == 7);
        samples.push_back(sample);
    }
    void tracker_item(int trial, const TrackerItem& item) noexcept override {
        CHECK(trial == 7);
        others.push_back(item.index());
    }
    void clock_pair(const ClockPair& pair) noexcept override { pairs.push_back(pair); }
    void event(const SessionEvent&) override {}
    void trial_started(const Trial&, SessionTime) override {}
    void trial_finished(const Trial&, const TrialOutcome&) override {}
    std::vector<GazeSample> samples;
    std::vector<std::size_t> others;
    std::vector<ClockPair> pairs;
};

TrackerTime fed_at_ms(std::int64_t ms) { return TrackerTime(std::chrono::milliseconds(ms)); }

GazeSample fed_sample(std::int64_t ms, Eye eye = Eye::left,
                      std::optional<ScreenPoint> gaze = ScreenPoint{1, 2}) {
    return {.sampled_at = fed_at_ms(ms), .eye = eye, .gaze = gaze};
}

/// Both clocks at a time of the session's, the tracker's ahead by so much.
ClockPair fed_pair(std::int64_t ms, double ahead_ms) {
    const SessionTime at{std::chrono::milliseconds(ms)};
    return {at,
            TrackerTime(std::chrono::microseconds(std::llround(1e3 * (static_cast<double>(ms) + ahead_ms)))),
            at + std::chrono::microseconds(100)};
}

} // namespace

TEST_CASE("a feed takes all that came, each eye's samples once, and keeps the rest in its order", "[unit]") {
    ListedTracker tracker;
    tracker.both_eyes = true;
    TrackerFeed feed(tracker);
    ItemsLog log;
    CHECK_FALSE(feed.has_recorded());
    REQUIRE(feed.start_recording(SessionTime(std::chrono::seconds(1))));
    CHECK(feed.has_recorded());
    tracker.items = {fed_sample(0),      fed_sample(0, Eye::right),
                     fed_sample(0),      fed_sample(0, Eye::right),
                     TrackerInput{},     fed_sample(2),
                     SampleDetail{},     fed_sample(2, Eye::right),
                     TrackerGap{},       fed_sample(4, Eye::left, {}),
                     fed_pair(1000, 0.0)};
    feed.take_items(7, log);
    CHECK(log.samples.size() == 5);
    CHECK(log.samples[1].eye == Eye::right);
    CHECK(log.others == std::vector<std::size_t>{TrackerItem(TrackerInput{}).index(),
                                                 TrackerItem(SampleDetail{}).index(),
                                                 TrackerItem(TrackerGap{}).index()});
    CHECK(log.pairs.size() == 1);
    CHECK(feed.readings().size() == 1);
    CHECK(feed.doubled_count() == 2);
    CHECK(feed.sample_count() == 5);
    CHECK(feed.yield().without_gaze == 1);
    // More than one poll holds.
    for (int i = 0; i < 10'000; ++i)
        tracker.items.emplace_back(fed_sample(6 + 2 * i));
    feed.take_items(7, log);
    CHECK(log.samples.size() == 10'005);
    // A second recording counts anew, and knows nothing of the one before.
    feed.stop_recording(SessionTime(std::chrono::seconds(2)));
    CHECK(tracker.stops == 1);
    REQUIRE(feed.start_recording(SessionTime(std::chrono::seconds(3))));
    tracker.items = {fed_sample(20'004)};
    feed.take_items(7, log);
    CHECK(feed.sample_count() == 1);
    CHECK(feed.doubled_count() == 0);
}

TEST_CASE("a recording's yield is judged by how long it lasted", "[unit]") {
    ListedTracker tracker;
    TrackerFeed feed(tracker);
    ItemsLog log;
    feed.start_recording(SessionTime(std::chrono::seconds(10)));
    for (int i = 0; i < 500; ++i)
        tracker.items.emplace_back(fed_sample(2 * i));
    feed.take_items(7, log);
    feed.stop_recording(SessionTime(std::chrono::seconds(14)));
    // One second of the four, at 500 Hz.
    CHECK(static_cast<double>(feed.yield().missing) == Approx(1500.0).margin(2.0));
    CHECK(feed.yield().share() == Approx(0.25).margin(0.002));
}

TEST_CASE("of a tracker of both eyes twice as many samples are expected", "[unit]") {
    for (const bool both_eyes : {false, true}) {
        ListedTracker tracker;
        tracker.both_eyes = both_eyes;
        TrackerFeed feed(tracker);
        ItemsLog log;
        feed.start_recording(SessionTime(std::chrono::seconds(10)));
        for (int i = 0; i < 1000; ++i)
            for (const Eye eye : {Eye::left, Eye::right})
                if (both_eyes || eye == Eye::left)
                    tracker.items.emplace_back(fed_sample(2 * i, eye));
        feed.take_items(7, log);
        feed.stop_recording(SessionTime(std::chrono::seconds(12)));
        CHECK(feed.yield().share() == Approx(1.0).margin(0.002));
    }
}

TEST_CASE("a feed whose tracker does not begin is lost, says why, and begins anew when asked", "[unit]") {
    ListedTracker tracker;
    TrackerFeed feed(tracker);
    tracker.fails = true;
    CHECK_FALSE(feed.start_recording({}));
    CHECK(feed.state() == RecordingState::lost);
    CHECK(feed.why_lost() == "it does not begin");
    CHECK_FALSE(feed.has_recorded());
    feed.stop_recording({});
    CHECK(tracker.stops == 0);
    tracker.fails = false;
    CHECK(feed.start_recording({}));
    CHECK(feed.state() == RecordingState::running);
    CHECK(feed.why_lost().empty());
    // The first that is not running stays.
    tracker.says = RecordingState::skip;
    feed.look_at_state();
    tracker.says = RecordingState::abort;
    feed.look_at_state();
    CHECK(feed.state() == RecordingState::skip);
    tracker.fails = true;
    CHECK_FALSE(feed.start_recording({}));
    CHECK_FALSE(feed.has_recorded());
}

TEST_CASE("two readings that agree tell of a jump of the tracker's clock, one alone does not", "[unit]") {
    ListedTracker tracker;
    TrackerFeed feed(tracker);
    ItemsLog log;
    const auto read = [&](std::deque<ClockPair> pairs) {
        tracker.readings = std::move(pairs);
        feed.read_clocks(log);
    };
    read({fed_pair(0, 0.0), fed_pair(100, 0.0), fed_pair(200, 40.0), fed_pair(300, 0.0)});
    CHECK_FALSE(feed.take_jump());
    CHECK(feed.readings().size() == 3); // without the delayed one
    read({fed_pair(400, 40.0), fed_pair(500, 40.01), fed_pair(600, 40.0)});
    const std::optional<SessionDuration> jump = feed.take_jump();
    REQUIRE(jump);
    CHECK(1e3 * to_seconds(*jump) == Approx(40.0).margin(0.2));
    CHECK_FALSE(feed.take_jump()); // told once
    REQUIRE(feed.readings().size() == 3);
    CHECK(feed.readings().front() == fed_pair(400, 40.0));
    // Readings off the line by different amounts agree with nothing.
    read({fed_pair(700, 90.0), fed_pair(800, 140.0), fed_pair(900, 40.0)});
    CHECK_FALSE(feed.take_jump());
    CHECK(log.pairs.size() == 10);
    // Eight times at most at once, and the newest thousands are kept.
    read({60, fed_pair(1000, 40.0)});
    CHECK(tracker.readings.size() == 52);
    for (int i = 0; i < 1100; ++i) {
        std::deque<ClockPair> more;
        for (int k = 0; k < 8; ++k)
            more.push_back(fed_pair(2000 + 80 * i + 10 * k, 40.0));
        read(std::move(more));
        REQUIRE(feed.readings().size() <= 4096);
    }
    CHECK(feed.readings().size() > 2000);
    CHECK(feed.readings().back() == fed_pair(2000 + 80 * 1099 + 70, 40.0));
    for (std::size_t i = 1; i < feed.readings().size(); ++i)
        REQUIRE(feed.readings()[i].before - feed.readings()[i - 1].before == std::chrono::milliseconds(10));
}

namespace {

/// Seen wherever gaze is, in one pose.
class AreaInPose final : public AreaView {
  public:
    explicit AreaInPose(int pose) : pose_(pose) {}
    bool is_at(PoseIndex pose, ScreenPoint) const noexcept override { return pose.value == pose_; }

  private:
    int pose_;
};

struct WatchBench {
    Protocol protocol = short_protocol("[display]\nrefresh_hz = 120\nlatency_ms = 20\n");
    ScreenGeometry screen = screen_geometry_of(protocol);
    GazeWatch watch{screen, protocol.display};
    TrackerDescription tracker{"t", 1000.0, Eye::left};
    ScreenPoint off(double deg) const {
        return {screen.centre().x_px + deg * screen.px_per_deg_at_centre(), screen.centre().y_px};
    }
    /// A sample each millisecond; when it came true, in ms, or -1.
    std::int64_t gaze(std::int64_t from_ms, std::int64_t to_ms, std::optional<ScreenPoint> at,
                      Eye eye = Eye::left) {
        for (std::int64_t ms = from_ms; ms < to_ms; ++ms) {
            watch.take({.sampled_at = fed_at_ms(ms), .eye = eye, .gaze = at});
            if (watch.has_come())
                return ms;
        }
        return -1;
    }
    FlipRecord lit(std::int64_t ms, int pose) const {
        FlipRecord flip;
        flip.report.vertical_blank = SessionTime(std::chrono::milliseconds(ms));
        flip.pose = {pose};
        return flip;
    }
};

} // namespace

TEST_CASE("gaze is waited for within a distance of a point, for so long, blinks left out", "[unit]") {
    WatchBench bench;
    const GazeWait wait{.within_deg = 1.5, .for_s = 0.1, .blink_s = 0.05};
    const auto begin = [&] {
        bench.watch.begin(wait, {bench.screen.centre(), {}}, 0, SessionTime(), {}, bench.tracker);
    };
    begin();
    CHECK(bench.gaze(0, 500, bench.off(1.52)) == -1);
    CHECK(bench.gaze(500, 900, bench.off(-1.48)) == 600);
    CHECK(bench.watch.condition().onset() == fed_at_ms(500));
    CHECK(bench.watch.condition().detected() == fed_at_ms(600));
    bench.watch.end();
    CHECK_FALSE(bench.watch.has_come());
    CHECK(bench.watch.condition().is_true()); // what was found stays
    // The other eye says nothing, and neither does a watch that has ended.
    begin();
    CHECK(bench.gaze(0, 500, bench.off(0.0), Eye::right) == -1);
    bench.watch.end();
    bench.gaze(500, 1000, bench.off(0.0));
    CHECK_FALSE(bench.watch.condition().is_true());
    // A blink of 50 ms neither counts nor breaks the piece; a longer one does.
    begin();
    bench.gaze(0, 61, bench.off(0.0));
    bench.gaze(61, 110, {});
    CHECK(bench.gaze(110, 400, bench.off(0.0)) == 150);
    begin();
    bench.gaze(0, 61, bench.off(0.0));
    bench.gaze(61, 113, {});
    CHECK(bench.gaze(113, 400, bench.off(0.0)) == 213);
    // What was sampled before the first flip of what is shown does not count, whatever flips follow.
    bench.watch.begin({.within_deg = 1.5, .for_s = 0.0, .blink_s = 0.0}, {bench.screen.centre(), {}}, 0,
                      SessionTime(), std::vector{fed_pair(0, 0.0), fed_pair(100'000, 0.0)}, bench.tracker);
    bench.watch.flipped(bench.lit(1000, 0), {});
    bench.watch.flipped(bench.lit(1008, 0), {});
    CHECK(bench.gaze(990, 1020, bench.off(0.0)) == 1000);
    // Of a tracker whose rate is not known samples may be 20 ms apart.
    bench.tracker.sample_rate_hz = 0.0;
    begin();
    for (std::int64_t ms = 0; ms <= 140 && !bench.watch.has_come(); ms += 20)
        bench.gaze(ms, ms + 1, bench.off(0.0));
    CHECK(bench.watch.condition().detected() == fed_at_ms(100));
}

TEST_CASE("gaze is on an area by the pose that was lit when it was sampled, in the slot that shows it",
          "[unit]") {
    WatchBench bench;
    const GazeWait wait{.within_deg = {}, .area = "head", .for_s = 0.0, .blink_s = 0.0};
    const std::vector<ClockPair> readings{fed_pair(0, 0.0), fed_pair(100'000, 0.0)};
    const auto begin = [&](int place, int lead, SessionTime since) {
        bench.watch.begin(wait, {{}, {{place, std::make_shared<AreaInPose>(5)}}}, lead, since, readings,
                          bench.tracker);
    };
    const ScreenPoint top{960.0, 0.0};
    begin(0, 0, SessionTime());
    CHECK(bench.gaze(0, 50, top) == -1); // nothing is lit
    bench.watch.flipped(bench.lit(1000, 4), {});
    bench.watch.flipped(bench.lit(1008, 5), {});
    bench.watch.flipped(bench.lit(1016, 4), {});
    // With 20 ms from the vertical blank to the light of the first row.
    CHECK(bench.gaze(1000, 1028, top) == -1);
    CHECK(bench.gaze(1028, 1060, top) == 1028);
    // What was lit before the step's first flip, or sampled before it began, does not count.
    begin(0, 0, SessionTime(std::chrono::milliseconds(2024)));
    bench.watch.flipped(bench.lit(2000, 5), {});
    CHECK(bench.gaze(2020, 2028, top) == 2024);
    begin(0, 0, SessionTime());
    bench.watch.flipped(bench.lit(3000, 5), {});
    CHECK(bench.gaze(2900, 3019, top) == -1);
    // Of a further place the pose is its own row's.
    for (const int place : {1, 2}) {
        CAPTURE(place);
        begin(place, 0, SessionTime());
        const SlotFlip rows[] = {{.place = 1, .pose = {3}}, {.place = 2, .pose = {5}}};
        bench.watch.flipped(bench.lit(4000, 7), rows);
        CHECK((bench.gaze(4020, 4028, top) >= 0) == (place == 2));
    }
    begin(2, 2, SessionTime());
    const SlotFlip other[] = {{.place = 2, .pose = {3}}};
    bench.watch.flipped(bench.lit(5000, 5), other);
    CHECK(bench.gaze(5020, 5028, top) >= 0);
    // Without readings of the clocks nobody knows what was lit.
    bench.watch.begin(wait, {{}, {{0, std::make_shared<AreaInPose>(5)}}}, 0, SessionTime(), {},
                      bench.tracker);
    bench.watch.flipped(bench.lit(6000, 5), {});
    CHECK(bench.gaze(6000, 6100, top) == -1);
}

namespace {

constexpr std::string_view waiting_for_gaze = R"([[task]]
id = "t"
question = "Look there."
steps = [ { fixation = { until = { gaze_within_deg = 1.5, for_s = 0.1, patience_s = 1, otherwise = "OTHERWISE" } }, right_deg = 5, up_deg = 3, id = "aim" },
          { show = "centre", for_s = 0.1 } ]
[[block]]
id = "b"
tasks = "t"
)";

Sitting gazing(std::string_view otherwise, std::string_view more = "") {
    std::string text(waiting_for_gaze);
    text.replace(text.find("OTHERWISE"), 9, otherwise);
    Sitting sitting(short_protocol(text + std::string(more)));
    sitting.tracker.has_clock = false; // each sample counts
    sitting.tracker.sample_rate_hz = 250.0;
    return sitting;
}

} // namespace

TEST_CASE("a fixation ends when gaze came to its target, and the record has the samples", "[unit]") {
    Sitting sitting = gazing("continue");
    const ScreenGeometry screen = screen_geometry_of(sitting.protocol);
    StepSettings aim;
    aim.right_deg = 5.0;
    aim.up_deg = 3.0;
    // In the second trial at the middle of the screen.
    sitting.tracker.looks = [&](int recording) {
        return recording == 0 ? target_of(aim, screen) : screen.centre();
    };
    CHECK(sitting.run().completed_trials == 2);
    const AttemptStep& came = sitting.log.outcomes[0].steps.front();
    CHECK(came.id == "aim");
    CHECK(came.ended_by == StepEnd::gaze);
    REQUIRE(came.gaze_onset);
    // 25 samples, 4 ms apart.
    CHECK(*came.gaze_detected - *came.gaze_onset == std::chrono::milliseconds(100));
    CHECK(to_seconds(*came.end - *came.begin) < 0.1);
    const AttemptStep& missed = sitting.log.outcomes[1].steps.front();
    CHECK(missed.ended_by == StepEnd::patience);
    CHECK_FALSE(missed.gaze_onset);
    CHECK(to_seconds(*missed.end - *missed.begin) == Approx(1.0).margin(0.001));
    CHECK(sitting.log.outcomes[1].shown_refreshes == 12);
    CHECK(sitting.log.outcomes[1].steps.back().ended_by == StepEnd::time);
}

TEST_CASE("where gaze does not come the attempt is rejected, or drift is checked as often as may be",
          "[unit]") {
    Sitting rejected = gazing("abort", "[repeat]\nrejected = \"never\"\n");
    CHECK(rejected.run().completed_trials == 0);
    REQUIRE(rejected.log.outcomes.size() == 2);
    CHECK(rejected.log.outcomes[0].shown_refreshes == 0);
    CHECK_THAT(rejected.log.details_of("trial failed").front(), Catch::Contains("gaze did not come"));
    CHECK(rejected.tracker.drift_checks == 0);

    Sitting checked = gazing("drift-check", "[tracker]\ndrift_checks = 3\n[repeat]\nrejected = \"never\"\n");
    CHECK(checked.run().completed_trials == 0);
    REQUIRE(checked.log.outcomes.size() == 2);
    for (const TrialOutcome& outcome : checked.log.outcomes) {
        std::string kinds;
        for (const AttemptStep& step : outcome.steps)
            kinds += step.kind + " ";
        CHECK(kinds == "fixation drift_check fixation drift_check fixation drift_check fixation ");
    }
    CHECK(checked.tracker.drift_checks == 6);

    // The second time it is there.
    Sitting again = gazing("drift-check", "[tracker]\ndrift_checks = 3\n");
    StepSettings aim;
    aim.right_deg = 5.0;
    aim.up_deg = 3.0;
    again.tracker.looks = [&](int recording) {
        return recording % 2 == 0 ? ScreenPoint{1.0, 2.0}
                                  : target_of(aim, screen_geometry_of(again.protocol));
    };
    CHECK(again.run().completed_trials == 2);
    CHECK(again.tracker.drift_checks == 2);
    CHECK(again.log.flips == 24);
}

TEST_CASE("gaze on an area ends a show, of the slots that are meant, and patience the others", "[unit]") {
    const auto shown = [](const std::string& slot, const std::string& only) {
        const ReadText read(R"([protocol]
name = "areas"
[[slot]]
id = "left"
right_deg = -6
size_deg = 5
[[slot]]
id = "right"
right_deg = 6
size_deg = 5
[[object]]
id = "a"
shipped = "muse"
[[material]]
id = "gold"
kind = "smooth-conductor"
[[material]]
id = "clay"
kind = "diffuse"
[[task]]
id = "t"
question = "Find it."
slots = ["left", "right"]
trials = { rule = "pairs", of = "material" }
steps = [ { show = ["left", "right"], until = { gaze_on = "head", )" +
                            slot + R"(for_s = 0.1, patience_s = 0.5 } } ]
)");
        INFO(read.diagnostics.print());
        REQUIRE(read.protocol);
        Sitting sitting(*read.protocol);
        StandingClock& clock = sitting.clock;
        const auto micros = [&clock] {
            return TrackerTime(std::chrono::floor<TrackerClock::duration>(clock.now().time_since_epoch()));
        };
        sitting.tracker.stamps = micros;
        sitting.tracker.sample_rate_hz = 120.0; // one in each refresh
        sitting.tracker.reads = [&, micros](int) { return ClockPair{clock.now(), micros(), clock.now()}; };
        class Everywhere final : public AreaView {
          public:
            bool is_at(PoseIndex, ScreenPoint) const noexcept override { return true; }
        };
        std::string asked;
        sitting.area_of = [&](const PlacedStimulus& placed,
                              const std::string& area) -> std::shared_ptr<const AreaView> {
            const std::string& id = sitting.protocol.slots[static_cast<std::size_t>(placed.slot)].id;
            asked += id + " " + area + "; ";
            if (only == "second" && id == "left")
                return std::make_shared<AreaInPose>(-7); // never seen
            if (id == only || only == "second")
                return std::make_shared<Everywhere>();
            return nullptr;
        };
        CHECK_FALSE(sitting.run().aborted);
        REQUIRE(sitting.log.outcomes.size() == 1);
        const AttemptStep& step = sitting.log.outcomes[0].steps.at(0);
        CHECK(step.gaze_onset.has_value() == (step.ended_by == StepEnd::gaze));
        if (step.ended_by == StepEnd::patience)
            CHECK(sitting.log.outcomes[0].shown_refreshes == 60);
        if (step.gaze_onset)
            CHECK(*step.gaze_detected >= *step.gaze_onset);
        return fmt::format("{}{}", asked, name_of(*step.ended_by));
    };
    CHECK(shown("", "left") == "left head; right head; gaze");
    CHECK(shown("", "right") == "left head; right head; gaze");
    CHECK(shown("", "second") == "left head; right head; gaze");
    CHECK(shown("", "none") == "left head; right head; patience");
    CHECK(shown("slot = \"right\", ", "right") == "right head; gaze");
    CHECK(shown("slot = \"right\", ", "left") == "right head; patience");
}
