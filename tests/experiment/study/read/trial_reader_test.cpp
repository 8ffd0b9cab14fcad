/// Trials as a study reads them: which samples and events their traces have, up to the bounds, and what is
/// said of those that are excluded.
#include "experiment/study/read/trial_reader.h"

#include <functional>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "experiment/record/session_schema.h"
#include "experiment/study/read/study_reader.h"
#include "tests/experiment/record/session_fixture.h"

using namespace overt;
using namespace overt::testing;
namespace fs = std::filesystem;

namespace {

/// One trial, whose presentation lasts from 12 s to 13 s; the tracker's clock is 3 s ahead.
struct ReadOne {
    double rate_hz = 500.0;
    std::vector<std::pair<int, int>> lost_ms = {}; ///< the eye, from and up to
    struct Event {
        GazeEvent::Kind kind;
        int from_ms, lasts_ms;
    };
    std::vector<Event> events = {};
    std::function<void(SessionHeader&, TrialOutcome&)> change = {};
    StudyOptions options = {};

    StudyResults read() const {
        const TemporaryFolder root;
        SessionHeader header = example_header();
        header.schedule.trials.resize(1);
        header.tracker.eye = Eye::left;
        TrialOutcome outcome;
        outcome.task_screen_onset = at_ms(11'000);
        outcome.presentation_onset = at_ms(12'000);
        outcome.presentation_end = outcome.response_screen_onset = at_ms(13'000);
        outcome.responded_at = at_ms(14'000);
        outcome.shown_refreshes = 70;
        outcome.missed_refreshes = 4;
        if (change)
            change(header, outcome);
        const fs::path session = make_session(root.path(), header);
        SessionStore store(session / session_file_name, patient());
        const auto tracker_us = [](double ms) {
            return tracker_time(3'000'000 + 12'000'000 + std::llround(1000.0 * ms));
        };
        for (const std::int64_t second : {0, 100})
            store.clock_pair(
                {at_ms(1000 * second), tracker_time(3'000'000 + 1'000'000 * second), at_ms(1000 * second)});
        store.trial_started(header.schedule.trials[0], at_ms(10'000));
        const double interval_ms = 1000.0 / rate_hz;
        for (int i = -static_cast<int>(50.0 / interval_ms); i * interval_ms < 1100.0; ++i) {
            GazeSample sample{tracker_us(i * interval_ms), Eye::left, ScreenPoint{300.0, 200.0}, 5.0f};
            for (const auto& [from, until] : lost_ms)
                if (i * interval_ms >= from && i * interval_ms < until)
                    sample.gaze.reset();
            store.sample(0, sample);
        }
        for (const Event& one : events) {
            TrackerEvent event;
            event.kind = one.kind;
            event.eye = Eye::left;
            event.start = tracker_us(one.from_ms);
            event.end = tracker_us(one.from_ms + one.lasts_ms - 2);
            event.duration = std::chrono::milliseconds(one.lasts_ms);
            event.amplitude_deg = 2.5f;
            event.peak_velocity_deg_s = 150.0f;
            store.tracker_item(0, event);
        }
        store.trial_finished(header.schedule.trials[0], outcome);
        store.close();
        return read_study(
                   std::array{session},
                   [](const SessionRecord&, std::size_t, const ViewedObject&) -> const SurfaceLookup* {
                       return nullptr;
                   },
                   options, [](std::string_view, int, int) {})
            .results;
    }
};

using Kind = GazeEvent::Kind;

} // namespace

TEST_CASE("traces are thinned to 125 Hz at most, from the onset to the end, both with them", "[unit]") {
    struct Known {
        double rate_hz;
        std::size_t points;
        double interval_s, last_s;
    };
    for (const Known& known :
         {Known{500.0, 126, 0.008, 1.0}, Known{1000.0, 126, 0.008, 1.0}, Known{125.0, 126, 0.008, 1.0},
          Known{50.0, 51, 0.02, 1.0}, Known{200.0, 101, 0.01, 1.0}, Known{250.0, 126, 0.008, 1.0}}) {
        CAPTURE(known.rate_hz);
        const StudyResults results = ReadOne{.rate_hz = known.rate_hz}.read();
        CHECK(*results.trials[0].quality.rate_hz == Approx(known.rate_hz));
        const std::vector<StudyTracePoint>& points = results.traces.at(0).points;
        REQUIRE(points.size() == known.points);
        CHECK(points.front().time_s == Approx(0.0).margin(1e-9));
        CHECK(points[1].time_s == Approx(known.interval_s));
        CHECK(points.back().time_s == Approx(known.last_s));
        CHECK(points[3].gaze == ScreenPoint{300.0, 200.0});
        CHECK(points[3].pupil == 5.0f);
    }
}

TEST_CASE("a trace has the first sample of each loss of the eye, and the first after it", "[unit]") {
    const StudyResults results = ReadOne{.lost_ms = {{102, 104}, {506, 518}}}.read();
    std::string changes;
    const StudyTracePoint* before = nullptr;
    for (const StudyTracePoint& point : results.traces.at(0).points) {
        if (before && before->gaze.has_value() != point.gaze.has_value())
            changes += fmt::format("{} at {:.3f} after {:.3f}; ", point.gaze ? "seen" : "lost", point.time_s,
                                   before->time_s);
        before = &point;
    }
    CHECK(changes ==
          "lost at 0.102 after 0.096; seen at 0.104 after 0.102; lost at 0.506 after 0.504; seen at "
          "0.518 after 0.514; ");
}

TEST_CASE("a trace has events that reach into the presentation, and none that touch its ends only",
          "[unit]") {
    const StudyResults results = ReadOne{
        .events = {{Kind::saccade, -40, 40},
                   {Kind::blink, -30, 40},
                   {Kind::fixation, 990, 60},
                   {Kind::saccade, 1000,
                    40}}}.read();
    const std::vector<StudyTraceEvent>& events = results.traces.at(0).events;
    REQUIRE(events.size() == 2);
    CHECK(events[0].kind == Kind::blink);
    CHECK(events[0].onset_s == Approx(-0.03));
    CHECK(events[0].duration_s == Approx(0.04));
    CHECK(events[1].kind == Kind::fixation);
    CHECK(events[1].onset_s == Approx(0.99));
    CHECK(events[1].amplitude_deg == 2.5);
    CHECK(events[1].peak_velocity_deg_s == 150.0);
}

TEST_CASE("of a trial are its refreshes, drift and exclusion as its outcome has them", "[unit]") {
    ReadOne one;
    one.change = [](SessionHeader&, TrialOutcome& outcome) { outcome.drift = Degrees{0.75}; };
    const StudyTrial plain = one.read().trials.at(0);
    CHECK(plain.label == "observer AB7, trial 1");
    CHECK(plain.quality.refreshes == 74);
    CHECK(plain.quality.missed_refreshes == 4);
    CHECK(plain.quality.drift_deg == 0.75);
    CHECK_FALSE(plain.quality.accuracy_deg);
    CHECK(plain.presentation_s == 1.0);
    CHECK_FALSE(plain.excluded);
    CHECK(plain.turns.empty());
    // Where nothing proves when pictures were lit, nobody knows how many were missed.
    one.change = [](SessionHeader& header, TrialOutcome&) {
        header.display.timing = "unproven";
        header.clock = ClockKind::steady;
    };
    one.options.exclude.most_missed_refreshes = 9;
    const StudyTrial unproven = one.read().trials.at(0);
    CHECK_FALSE(unproven.quality.missed_refreshes);
    CHECK_FALSE(unproven.quality.drift_deg);
    CHECK(unproven.why_excluded == "How many refreshes were missed is unproven.");
    CHECK(unproven.excluded);
    // No gaze at all, though there are samples, is a reason of its own; a fixation that was told is gaze.
    ReadOne blind{.lost_ms = {{-100, 2000}}};
    CHECK(blind.read().trials[0].why_excluded == "No gaze was recorded in it.");
    CHECK_FALSE(blind.read().trials[0].has_gaze);
    blind.events = {{Kind::blink, 100, 100}};
    CHECK(blind.read().trials[0].excluded);
    blind.events = {{Kind::fixation, 100, 100}};
    CHECK(blind.read().trials[0].has_gaze);
    CHECK_FALSE(blind.read().trials[0].excluded);
}

TEST_CASE("what stands in another slot is a presentation with its slot's name", "[unit]") {
    ReadOne one;
    one.change = [](SessionHeader& header, TrialOutcome&) {
        header.slots = {{"left", "Left", {10, 44}, {512, 511}}, {"right", "Right", {280, 44}, {512, 511}}};
        header.schedule.trials[0].slot = 1;
        header.schedule.trials[0].beside = {{{1, 0}, 0}};
    };
    const StudyResults results = one.read();
    REQUIRE(results.trials.size() == 2);
    CHECK(results.trials[0].label == "observer AB7, trial 1, slot right");
    CHECK(results.trials[1].label == "observer AB7, trial 1, slot left");
    CHECK(results.trials[0].key("slot") == "right");
    CHECK(results.objects[static_cast<std::size_t>(results.trials[0].object)].id == "bust");
    CHECK(results.objects[static_cast<std::size_t>(results.trials[1].object)].id == "vase");
    // Samples of one trial count once.
    CHECK(static_cast<double>(results.glance.samples) == results.trials[0].quality.samples);
    CHECK(results.trials[0].key("day") == "3");
    CHECK(results.trials[0].key("session") == "3");
}
