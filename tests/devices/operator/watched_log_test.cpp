/// What the operator's view is told of a session's log, by what a client of its socket sees.
#include "devices/operator/watched_log.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "devices/operator/operator_client.h"
#include "experiment/ports/answer_offer.h"
#include "experiment/ports/event_kinds.h"
#include "experiment/ports/turning_offer.h"
#include "tests/support/temporary_folder.h"

using namespace overt;
using namespace overt::test;
using namespace std::chrono_literals;

namespace {

class SetClock final : public Clock {
  public:
    SessionTime time;
    SessionTime now() const noexcept override { return time; }
    void wait_until(SessionTime) noexcept override {}
};

/// Answers nothing, and is told nothing.
class NoPanel final : public ResponsePanel {
  public:
    void await(Awaited, SessionTime, const Trial*) override {}
    std::optional<ResponsePress> poll() noexcept override { return std::nullopt; }
    std::string answer() override { return {}; }
};

/// The names of what came, in their order.
class NamedCalls final : public SessionLog {
  public:
    std::string calls;
    void flip(const FlipRecord&) noexcept override { calls += "flip "; }
    void slot_flip(const SlotFlip&) noexcept override { calls += "slot_flip "; }
    void steered_flip(const SteeredFlip&) noexcept override { calls += "steered_flip "; }
    void missed(const MissedRefresh&) noexcept override { calls += "missed "; }
    void sample(int, const GazeSample&) noexcept override { calls += "sample "; }
    void tracker_item(int, const TrackerItem&) noexcept override { calls += "item "; }
    void clock_pair(const ClockPair&) noexcept override { calls += "pair "; }
    void event(const SessionEvent&) override { calls += "event "; }
    void calibration(const RecordedCalibration&) override { calls += "calibration "; }
    void observer_fields(const std::vector<RecordedObserverField>&) override { calls += "fields "; }
    void consent(const RecordedConsent&) override { calls += "consent "; }
    void buttons(const std::vector<RecordedButton>&) override { calls += "buttons "; }
    void key_presses(const std::vector<RecordedKeyPress>&) override { calls += "keys "; }
    void gaze_came(const GazeYield&) override { calls += "yield "; }
    void markers(const std::vector<RecordedMarker>&) override { calls += "markers "; }
    void answer_recorded(const RecordedAnswer&) override { calls += "recorded "; }
    void trial_started(const Trial&, SessionTime) override { calls += "started "; }
    void trial_finished(const Trial&, const TrialOutcome&) override { calls += "finished "; }
};

class CountingListener final : public SampleListener {
  public:
    int samples = 0;
    void measured(const GazeSample&) noexcept override { ++samples; }
};

OperatorServer::Options watched_options(const std::filesystem::path& socket) {
    OperatorServer::Options options;
    options.socket = socket;
    ViewedTrial trial{"t", "Which?", {}};
    trial.shown.resize(2);
    trial.picture_of_frame = {{0, 1, 2, 3, 4}, {4, 3, 2, 1, 0}};
    options.trials.assign(4, trial);
    return options;
}

/// A log that is watched, and a view of it.
struct Watch {
    explicit Watch(SampleListener* gaze = nullptr) : log(record, server, panel, clock, gaze) {}

    /// The view once all that was told until now has come.
    const SessionView& seen() {
        clock.time += 1ms;
        const double now_s = to_seconds(clock.time);
        log.event({clock.time, 0, "mark", std::to_string(++marks)});
        for (int tries = 0; tries < 500 && client.view().time_s < now_s; ++tries)
            client.read(10ms);
        CHECK(client.view().time_s == Approx(now_s));
        return client.view();
    }

    TemporaryFolder folder;
    NamedCalls record;
    SetClock clock;
    OperatorServer server{watched_options(folder.path() / "s")};
    NoPanel silent;
    OperatorPanel panel{server, clock, silent};
    WatchedLog log;
    OperatorClient client{folder.path() / "s"};
    int marks = 0;
};

GazeSample sample_at(std::chrono::microseconds time, bool is_seen = true) {
    return {TrackerTime(time), Eye::right, is_seen ? std::optional(ScreenPoint{1.0, 2.0}) : std::nullopt,
            1.0f};
}

} // namespace

TEST_CASE("all that a watched log is told goes on to the record, once and in its order", "[unit]") {
    CountingListener gaze;
    Watch watch(&gaze);
    watch.log.trial_started({}, {});
    watch.log.flip({});
    watch.log.slot_flip({});
    watch.log.steered_flip({});
    watch.log.missed({});
    watch.log.sample(0, sample_at(0us));
    watch.log.tracker_item(0, {});
    watch.log.clock_pair({});
    watch.log.event({{}, 0, operator_pressed_event, "pause"});
    watch.log.calibration({});
    watch.log.observer_fields({});
    watch.log.consent({});
    watch.log.buttons({});
    watch.log.key_presses({});
    watch.log.gaze_came({});
    watch.log.markers({});
    watch.log.answer_recorded({});
    watch.log.trial_finished({}, {});
    CHECK(watch.record.calls ==
          "started flip slot_flip steered_flip missed sample item pair event calibration fields "
          "consent buttons keys yield markers recorded finished ");
    CHECK(gaze.samples == 1);
}

TEST_CASE("a view sees samples counted every 15 ms, of the trial and of the session", "[unit]") {
    Watch watch;
    watch.log.trial_started({}, {});
    watch.log.sample(0, sample_at(0us));
    watch.log.sample(0, sample_at(14'999us, false));
    CHECK(watch.seen().samples == 1);
    CHECK(watch.client.view().lost == 0);
    watch.log.sample(0, sample_at(15'000us, false));
    CHECK(watch.seen().samples == 3);
    CHECK(watch.client.view().lost == 2);
    CHECK(watch.client.view().samples_in_trial == 3);
    CHECK(watch.client.view().lost_in_trial == 2);
    // A clock that was set back does not keep them away.
    watch.log.sample(0, sample_at(14'000us));
    CHECK(watch.seen().samples == 4);
    Trial next;
    next.index = 1;
    watch.log.missed({});
    watch.log.trial_started(next, watch.clock.time);
    watch.log.missed({});
    watch.log.missed({});
    watch.log.sample(1, sample_at(1s, false));
    CHECK(watch.seen().samples == 5);
    CHECK(watch.client.view().trial == 1);
    CHECK(watch.client.view().lost == 3);
    CHECK(watch.client.view().samples_in_trial == 1);
    CHECK(watch.client.view().lost_in_trial == 1);
    watch.log.trial_finished(next, {});
    watch.seen();
    CHECK(watch.client.view().missed == 3);
    CHECK(watch.client.view().missed_in_trial == 2);
}

TEST_CASE("a view sees each new frame of each slot, and when a slot is dark", "[unit]") {
    Watch watch;
    Trial trial;
    trial.beside.resize(1);
    watch.log.trial_started(trial, {});
    FlipRecord flip;
    flip.shown = no_frame; // as a trial begins: no news
    flip.refresh_in_trial = 6;
    watch.log.flip(flip);
    CHECK(watch.seen().refresh == 0);
    flip.shown = {2};
    flip.pose = {5};
    flip.refresh_in_trial = 7;
    flip.report.vertical_blank = SessionTime(3s);
    watch.log.flip(flip);
    watch.log.slot_flip({0, 7, 1, {3}, {3}, {6}});
    watch.log.slot_flip({0, 7, 2, {3}, {3}, {6}}); // no such slot
    const SessionView& view = watch.client.view();
    watch.clock.time = SessionTime(3s);
    watch.seen();
    REQUIRE(view.shown.size() == 2);
    CHECK(view.refresh == 7);
    CHECK((view.shown[0].pose == 5 && view.shown[0].picture == 2));
    CHECK((view.shown[1].pose == 6 && view.shown[1].picture == 1));
    // The same frame again is no news, with whatever refresh.
    flip.refresh_in_trial = 8;
    watch.log.flip(flip);
    watch.seen();
    CHECK(view.refresh == 7);
    flip.refresh_in_trial = 9;
    flip.shown = no_frame;
    watch.log.flip(flip);
    watch.seen();
    CHECK(view.refresh == 9);
    CHECK((view.shown[0].pose == -1 && view.shown[0].picture == -1));
    CHECK(view.shown[1].pose == 6);
    flip.refresh_in_trial = 10;
    flip.shown = {0};
    watch.log.flip(flip);
    watch.seen();
    CHECK(view.refresh == 10);
    CHECK((view.shown[0].pose == 5 && view.shown[0].picture == 0));
}

TEST_CASE("a view sees what came of trials, validations and phases, and the level every 50 ms", "[unit]") {
    Watch watch;
    const SessionView& view = watch.client.view();
    RecordedCalibration calibration;
    calibration.validation.mean_error = Degrees{0.25};
    calibration.validation.max_error = Degrees{0.75};
    watch.log.calibration(calibration);
    TrialOutcome outcome;
    outcome.answer = "left";
    watch.log.trial_finished({}, outcome);
    watch.seen();
    CHECK(view.validation_mean_deg == 0.25);
    CHECK(view.validation_max_deg == 0.75);
    CHECK((view.done == 1 && view.failed == 0));
    CHECK(view.answer == "left");
    CHECK_FALSE(view.drift_deg);
    outcome.status = TrialOutcome::Status::aborted;
    outcome.drift = Degrees{1.5};
    watch.log.trial_finished({}, outcome);
    watch.log.entered(SessionPhase::stimulus, 3);
    watch.clock.time = SessionTime(1s);
    watch.log.level({0.5f, 0.25f, true});
    watch.seen();
    CHECK((view.done == 1 && view.failed == 1));
    CHECK(view.drift_deg == 1.5);
    CHECK(view.phase == "stimulus");
    CHECK(view.trial == 3);
    CHECK((view.level_peak == 0.5 && view.level_rms == 0.25 && view.is_clipping));
    watch.clock.time = SessionTime(1s + 50ms - 1ns);
    watch.log.level({0.75f, 0.125f, false});
    watch.seen();
    CHECK(view.level_peak == 0.5);
    watch.clock.time = SessionTime(1s + 50ms);
    watch.log.level({0.75f, 0.125f, false});
    watch.clock.time += 2ms; // seen() waits for a later time than the last
    watch.seen();
    CHECK((view.level_peak == 0.75 && view.level_rms == 0.125 && !view.is_clipping));
}

namespace {

/// Writes down what it is asked.
class DiaryPanel final : public ResponsePanel {
  public:
    std::string calls;
    std::optional<ResponsePress> press;
    void await(Awaited what, SessionTime since, const Trial*) override {
        calls += fmt::format("await {} {} ", static_cast<int>(what), to_seconds(since));
    }
    void offer(const std::vector<AnswerOffer>& offers) override {
        calls += fmt::format("offer {} ", offers.size());
    }
    void offer_turning(const TurningOffer&) override { calls += "turning "; }
    void window_opened(SessionTime) noexcept override { calls += "opened "; }
    std::optional<SetupKey> next_setup_key() override { return SetupKey{SetupKey::Kind::enter}; }
    std::optional<ObserverInput> next_input() noexcept override { return ObserverInput{}; }
    std::optional<ResponsePress> poll() noexcept override { return std::exchange(press, std::nullopt); }
    bool has_keyboard() const noexcept override { return false; }
    std::string answer() override { return "typed"; }
    std::vector<std::string> closing_warnings() const override { return {"one"}; }
    void write_down(SessionLog&) override { calls += "written "; }
    void entered(SessionPhase phase, int trial) noexcept override {
        calls += fmt::format("entered {} {} ", name_of(phase), trial);
    }
};

} // namespace

TEST_CASE(
    "an operator's view stands beside the panel that answers, which is asked and told all that it would be",
    "[unit]") {
    const TemporaryFolder folder;
    OperatorServer server(watched_options(folder.path() / "s"));
    SetClock clock;
    DiaryPanel answering;
    NamedCalls log;
    OperatorPanel panel(server, clock, answering);
    panel.await(Awaited::response, SessionTime(2s), nullptr);
    panel.offer(std::vector<AnswerOffer>(3));
    panel.offer_turning({});
    panel.window_opened({});
    panel.entered(SessionPhase::stimulus, 5);
    panel.write_down(log);
    CHECK(answering.calls == fmt::format("await {} 2 offer 3 turning opened entered stimulus 5 written ",
                                         static_cast<int>(Awaited::response)));
    CHECK(log.calls.empty());
    CHECK(panel.next_setup_key()->kind == SetupKey::Kind::enter);
    CHECK(panel.next_input());
    CHECK_FALSE(panel.has_keyboard());
    CHECK(panel.answer() == "typed");
    CHECK(panel.closing_warnings() == std::vector<std::string>{"one"});
    CHECK_FALSE(panel.poll());
    answering.press = ResponsePress{ResponsePress::Key::next, SessionTime(3s)};
    CHECK(panel.poll()->pressed_at == SessionTime(3s));
}

TEST_CASE(
    "a view is told each event with its kind, words, trial and time, and each note that stands beside it",
    "[unit]") {
    Watch watch;
    watch.seen();
    static_cast<void>(watch.client.take_events());
    const SessionTime at = watch.clock.time + 250ms;
    watch.log.event({at, 3, "tracker lost", "for 2 s"});
    watch.log.event({at, -1, operator_pressed_event, "pause"});
    watch.clock.time = at;
    watch.seen();
    const auto events = watch.client.take_events();
    REQUIRE(events.size() == 3);
    CHECK(events[0].kind == "tracker lost");
    CHECK(events[0].detail == "for 2 s");
    CHECK(events[0].trial == 3);
    CHECK(events[0].at_s == Approx(to_seconds(at)));
    CHECK(events[1].kind == operator_pressed_event);
    CHECK(events[1].detail == "pause");
    CHECK(events[1].trial == -1);
}
