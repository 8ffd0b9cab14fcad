/// A session on ports that do what they are told.
#include "experiment/session.h"

#include <catch2/catch.hpp>

#include "experiment/protocol_fixtures.h"
#include "experiment/schedule.h"

using namespace overt;
using namespace overt::test;

namespace {

class StandingClock final : public Clock {
  public:
    SessionTime now() const noexcept override { return now_; }
    void wait_until(SessionTime time) noexcept override { now_ = std::max(now_, time); }

  private:
    SessionTime now_{};
};

class PlainPresenter final : public Presenter {
  public:
    explicit PlainPresenter(StandingClock& clock) : clock_(clock) {}
    DisplayTiming timing() const override { return {120.0, VblankSource::virtual_display}; }
    void load_frames(const Condition& condition) override { loaded.push_back(condition); }
    FlipReport show(const Screen& screen) override {
        if (screen.kind == Screen::Kind::text)
            texts.push_back(screen.text);
        return next();
    }
    FlipReport flip(AnimationFrameIndex) noexcept override { return next(); }
    bool closed() const noexcept override { return false; }

    std::vector<Condition> loaded;
    std::vector<std::string> texts;

  private:
    FlipReport next() noexcept {
        FlipReport report;
        clock_.wait_until(SessionTime(std::chrono::nanoseconds(++refresh_ * 8'333'333)));
        report.refresh = {refresh_};
        report.requested = report.swapped = report.vertical_blank = clock_.now();
        return report;
    }
    StandingClock& clock_;
    std::int64_t refresh_ = 0;
};

/// Sees no eye during the presentations that it is told of, by their number from 0.
class BlinkingTracker final : public EyeTracker {
  public:
    TrackerDescription description() const override { return {"blinking", 1000.0, Eye::left}; }
    ValidationResult calibrate() override { return {}; }
    std::optional<Degrees> drift_check(ScreenPoint) override { return Degrees{0.1}; }
    ClockPair read_clocks() noexcept override { return {}; }
    void start_recording() override { ++recording_; }
    void stop_recording() override {}
    std::size_t poll(std::span<GazeSample> into) noexcept override {
        into[0] = {};
        if (std::find(blind.begin(), blind.end(), recording_) == blind.end())
            into[0].gaze = ScreenPoint{1.0, 2.0};
        return 1;
    }
    bool lost() const noexcept override { return false; }

    std::vector<int> blind;

  private:
    int recording_ = -1;
};

/// Presses once at each time that it is asked, with the keys that it is told of and then «next» for ever.
class ScriptedPanel final : public ResponsePanel {
  public:
    explicit ScriptedPanel(StandingClock& clock) : clock_(clock) {}
    void await_key(SessionTime) override {}
    void await_response(const Trial&, SessionTime) override { ++responses_; }
    std::optional<ResponsePress> poll() noexcept override {
        if (clock_.now() == last_)
            return std::nullopt;
        last_ = clock_.now();
        const bool is_told = std::find(rejected.begin(), rejected.end(), responses_) != rejected.end();
        if (is_told)
            ++responses_; // once
        return ResponsePress{is_told ? ResponsePress::Key::reject : ResponsePress::Key::next, clock_.now()};
    }
    std::string answer() override { return "yes"; }

    std::vector<int> rejected; ///< response screens, from 1

  private:
    StandingClock& clock_;
    SessionTime last_{};
    int responses_ = 0;
};

class NotingLog final : public SessionLog {
  public:
    void flip(const FlipRecord&) noexcept override { ++flips; }
    void missed(const MissedRefresh&) noexcept override {}
    void sample(int, const GazeSample&) noexcept override { ++samples; }
    void clock_pair(const ClockPair&) noexcept override {}
    void event(const SessionEvent& event) override {
        kinds.emplace_back(event.kind);
        details.push_back(event.detail);
    }
    void trial_started(const Trial& trial, SessionTime) override { started.push_back(trial.index); }
    void trial_finished(const Trial&, const TrialOutcome& outcome) override {
        completed.push_back(outcome.status == TrialOutcome::Status::completed);
    }
    long count(std::string_view kind) const { return std::count(kinds.begin(), kinds.end(), kind); }

    int flips = 0, samples = 0;
    std::vector<std::string> kinds, details;
    std::vector<int> started;
    std::vector<bool> completed;
};

struct Sitting {
    explicit Sitting(const Protocol& sat) : protocol(sat) {}
    SessionResult run() {
        const Schedule schedule = make_schedule(protocol, {"P", 1}, 1);
        return Session(protocol, schedule, {960.0, 540.0}, {clock, presenter, tracker, panel, log, {}})
            .run({});
    }
    Protocol protocol;
    StandingClock clock;
    PlainPresenter presenter{clock};
    BlinkingTracker tracker;
    ScriptedPanel panel{clock};
    NotingLog log;
};

Protocol short_protocol(std::string_view more) {
    const ReadText read(minimal_protocol, "[[material]]\nid = \"clay\"\nkind = \"diffuse\"\n"
                                          "[animation]\nduration_s = 0.1\n" +
                                              std::string(more));
    INFO(read.diagnostics.print());
    REQUIRE(read.protocol);
    return *read.protocol;
}

} // namespace

TEST_CASE("practice shows its stimulus and its feedback, and leaves no rows but events", "[unit]") {
    Sitting sitting(short_protocol("[[practice]]\ntask = \"free\"\nsculpture = \"a\"\nmaterial = \"clay\"\n"
                                   "feedback = \"That was right.\"\n"));
    const SessionResult result = sitting.run();
    CHECK_FALSE(result.aborted);
    CHECK(result.completed_trials == 2);
    CHECK(sitting.presenter.loaded.size() == 3);
    CHECK(sitting.presenter.loaded.front() == Condition{0, 1});
    CHECK(sitting.log.started == std::vector<int>{0, 1});
    CHECK(sitting.log.flips == 2 * 12);
    CHECK(sitting.log.count("practice") == 1);
    CHECK(sitting.log.count("practice answered") == 1);
    const auto& texts = sitting.presenter.texts;
    CHECK(std::count(texts.begin(), texts.end(), "That was right.") == 1);
}

TEST_CASE("breaks stand on the screen for as long as they are to, and are noted", "[unit]") {
    for (const std::string pace : {"timed", "self"}) {
        Sitting sitting(short_protocol("[breaks]\nevery_trials = 1\npace = \"" + pace +
                                       "\"\nduration_s = 300\ntext = \"Rest.\"\n"));
        CHECK_FALSE(sitting.run().aborted);
        CHECK(sitting.log.count("break begins") == 1);
        CHECK(sitting.log.count("break ends") == 1);
        CHECK((to_seconds(sitting.clock.now() - SessionTime{}) > 300.0) == (pace == "timed"));
    }
}

TEST_CASE("a trial without gaze is repeated as the protocol says, and only the last attempt counts",
          "[unit]") {
    Sitting sitting(short_protocol("[repeat]\ngaze_lost = \"end-of-block\"\ngaze_lost_limit = 0.5\n"));
    sitting.tracker.blind = {0};
    const SessionResult result = sitting.run();
    CHECK_FALSE(result.aborted);
    CHECK(result.completed_trials == 2);
    CHECK(sitting.log.started == std::vector<int>{0, 1, 0});
    CHECK(sitting.log.completed == std::vector<bool>{false, true, true});
    CHECK(sitting.log.count("trial failed") == 1);
    // Without the rule it counts as it is.
    Sitting patient(short_protocol(""));
    patient.tracker.blind = {0};
    CHECK(patient.run().completed_trials == 2);
    CHECK(patient.log.started == std::vector<int>{0, 1});
}

TEST_CASE("a trial that the operator rejects comes again, or is left out, and the session ends in order",
          "[unit]") {
    for (const std::string when : {"now", "end-of-block", "never"}) {
        Sitting sitting(short_protocol("[repeat]\nrejected = \"" + when + "\"\n"));
        sitting.panel.rejected = {1};
        const SessionResult result = sitting.run();
        CHECK_FALSE(result.aborted);
        CHECK(result.completed_trials == (when == "never" ? 1 : 2));
        CHECK(sitting.log.started == (when == "now"            ? std::vector<int>{0, 0, 1}
                                      : when == "end-of-block" ? std::vector<int>{0, 1, 0}
                                                               : std::vector<int>{0, 1}));
        CHECK(sitting.log.kinds.back() == "session completed");
    }
}
