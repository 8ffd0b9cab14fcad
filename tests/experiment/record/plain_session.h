/// A session on ports that do what they are told, for tests of its order.
#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "experiment/design/schedule.h"
#include "experiment/session/session.h"
#include "tests/experiment/protocol/protocol_fixtures.h"

namespace overt::test {

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
    void load_slots(std::span<const PlacedStimulus> shown) override {
        for (const PlacedStimulus& placed : shown)
            loaded.push_back(placed.stimulus);
    }
    FlipReport show(const Screen& screen) override {
        if (screen.kind != Screen::Kind::blank && screen.kind != Screen::Kind::target) {
            texts.push_back(screen.text);
            screens.push_back(screen);
        }
        return next();
    }
    void show_level(const LevelBar& bar) override { bars.push_back(bar); }
    FlipReport flip_slots(std::span<const AnimationFrameIndex> frames) noexcept override {
        for (const AnimationFrameIndex frame : frames)
            (is_veiled ? veiled_frames : seen_frames).push_back(frame.value);
        return next();
    }
    void veil(bool is_on) override { is_veiled = is_on; }
    void mark_stimuli(std::span<const StimulusMark> given) noexcept override {
        marks.assign(given.begin(), given.end());
    }
    bool closed() const noexcept override { return false; }

    std::vector<Stimulus> loaded;
    std::vector<std::string> texts;
    std::vector<Screen> screens; ///< of the texts
    std::vector<LevelBar> bars;
    bool is_veiled = false;
    std::vector<int> seen_frames, veiled_frames; ///< of flips
    std::vector<StimulusMark> marks;             ///< that stand over stimuli now

  private:
    FlipReport next() noexcept {
        FlipReport report;
        constexpr std::int64_t interval_ns = 8'333'333;
        // The next one that has not begun yet.
        refresh_ = std::max(refresh_ + 1, clock_.now().time_since_epoch().count() / interval_ns + 1);
        clock_.wait_until(SessionTime(std::chrono::nanoseconds(refresh_ * interval_ns)));
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
    bool measures_gaze() const noexcept override { return is_there; }
    enum class Step { set_up, drift_check, start };
    SetupOutcome set_up(SetupScreen& setup_screen) override {
        ++calibrations;
        fail(Step::set_up);
        if (camera)
            setup_screen.show_camera(*camera);
        if (set_ups.empty())
            return {SetupOutcome::Kind::done, ValidationResult{}, "tracker", {}};
        SetupOutcome next = set_ups.front();
        set_ups.erase(set_ups.begin());
        return next;
    }
    DriftOutcome drift_check(ScreenPoint) override {
        ++drift_checks;
        fail(Step::drift_check);
        if (set_ups_wanted > 0) {
            --set_ups_wanted;
            return {DriftOutcome::Kind::set_up_wanted, {}};
        }
        const std::optional<Degrees> found = static_cast<std::size_t>(drift_checks) <= first_drifts.size()
                                                 ? first_drifts[static_cast<std::size_t>(drift_checks) - 1]
                                                 : drift;
        return found ? DriftOutcome{DriftOutcome::Kind::measured, *found} : DriftOutcome{};
    }
    std::optional<ClockPair> read_clocks() noexcept override {
        ++clock_readings;
        return reads ? std::optional(reads(clock_readings)) : ClockPair{};
    }
    void start_recording() override {
        ++recording_;
        fail(Step::start);
    }
    void stop_recording() override { held_ = late; }
    std::size_t poll(std::span<TrackerItem> into) noexcept override {
        if (held_ > 0) {
            const std::size_t count = std::min(into.size(), held_);
            for (TrackerItem& item : into.first(count))
                item = GazeSample{.sampled_at = time_of(++samples_), .gaze = {}};
            held_ -= count;
            arrived += static_cast<int>(count);
            return count;
        }
        ++arrived;
        GazeSample sample{.sampled_at = doubles ? time_of(samples_ += arrived % 2) : time_of(++samples_),
                          .gaze = {}};
        if (std::find(blind.begin(), blind.end(), recording_) == blind.end())
            sample.gaze = ScreenPoint{1.0, 2.0};
        into[0] = sample;
        return 1;
    }

    RecordingState recording_state() const noexcept override {
        return says ? says(recording_) : RecordingState::running;
    }
    void reconnect() override {
        ++reconnections;
        if (reconnections <= refused_reconnections)
            throw DeviceError("it is still not there");
        says = {};
    }
    void mark(const TrackerMark& mark) noexcept override { marks.emplace_back(mark.at, mark.text); }

    std::vector<int> blind;
    std::optional<CameraImage> camera;                 ///< shown in each calibration
    std::vector<SetupOutcome> set_ups;                 ///< what each calibration gives; then all is well
    std::function<RecordingState(int recording)> says; ///< of the recording under way, by its number from 0
    std::vector<std::pair<SessionTime, std::string>> marks;
    std::optional<Step> fails_at;                ///< once, as a tracker that is gone
    bool doubles = false;                        ///< gives every other sample twice
    std::function<ClockPair(int reading)> reads; ///< what each reading of the clocks gives
    int set_ups_wanted = 0;                      ///< by so many drift checks
    int reconnections = 0, refused_reconnections = 0;
    std::vector<std::optional<Degrees>> first_drifts; ///< that the first drift checks find
    std::optional<Degrees> drift = Degrees{0.1};      ///< that each later one finds
    std::size_t late = 0; ///< samples that arrive only when the recording has ended
    int calibrations = 0, drift_checks = 0, clock_readings = 0;
    int arrived = 0; ///< samples handed over
    bool is_there = true;

  private:
    void fail(Step at) {
        if (fails_at != at)
            return;
        fails_at.reset();
        throw DeviceError("it is gone");
    }
    /// About as often as it is asked.
    static TrackerTime time_of(std::int64_t sample) { return tracker_time(4000 * sample); }
    std::int64_t samples_ = 0;
    int recording_ = -1;
    std::size_t held_ = 0;
};

/// Presses once at each time that it is asked: what it is told to, or yes to decisions and "next" to all
/// else.
class ScriptedPanel final : public ResponsePanel {
  public:
    using Key = ResponsePress::Key;
    explicit ScriptedPanel(StandingClock& clock) : clock_(clock) {}
    void await(Awaited what, SessionTime, const Trial*) override {
        awaited_ = what == Awaited::consent || what == Awaited::decision ? Key::yes
                   : what == Awaited::entry                              ? Key::character
                                                                         : Key::next;
    }
    void entered(SessionPhase phase, int of_trial) noexcept override {
        phases.push_back(phase);
        trial = of_trial;
        looks = 0;
    }
    std::optional<ResponsePress> poll() noexcept override {
        if (clock_.now() == last_)
            return std::nullopt;
        last_ = clock_.now();
        ++looks;
        ResponsePress press{awaited_ == Key::character ? Key::next : awaited_, last_};
        if (const std::optional<ResponsePress> told = tell ? tell(*this) : std::nullopt) {
            press = *told;
            press.pressed_at = last_;
        }
        return press;
    }
    void offer(const std::vector<AnswerOffer>&) override { opened.reset(); }
    void window_opened(SessionTime at) noexcept override { opened = at; }
    std::optional<ObserverInput> next_input() noexcept override {
        return does ? does(*this, clock_.now()) : std::nullopt;
    }
    std::string answer() override { return "yes"; }
    bool has_keyboard() const noexcept override { return !lacks_keyboard || !lacks_keyboard(*this); }

    SessionPhase phase() const { return phases.back(); }
    bool is_deciding() const { return awaited_ == Key::yes; }
    bool is_typing() const { return awaited_ == Key::character; }
    long times_in(SessionPhase phase) const { return std::count(phases.begin(), phases.end(), phase); }

    std::function<bool(const ScriptedPanel&)> lacks_keyboard;
    /// What it presses now, if not the usual.
    std::function<std::optional<ResponsePress>(ScriptedPanel&)> tell;
    /// What it does while an answer is awaited; asked again until that is nothing.
    std::function<std::optional<ObserverInput>(ScriptedPanel&, SessionTime now)> does;
    std::optional<SessionTime> opened; ///< since when presses count
    std::vector<SessionPhase> phases;
    int trial = -1;
    int looks = 0; ///< in this phase

  private:
    StandingClock& clock_;
    SessionTime last_{};
    Key awaited_ = Key::next;
};

class NotingLog final : public SessionLog {
  public:
    void flip(const FlipRecord&) noexcept override { ++flips; }
    void missed(const MissedRefresh&) noexcept override {}
    void sample(int, const GazeSample&) noexcept override { ++samples; }
    void clock_pair(const ClockPair&) noexcept override {}
    void calibration(const RecordedCalibration& calibration) override { calibrations.push_back(calibration); }
    void event(const SessionEvent& event) override {
        kinds.emplace_back(event.kind);
        details.push_back(event.detail);
        times.push_back(event.at);
    }
    void consent(const RecordedConsent& consent) override { consents.push_back(consent); }
    void gaze_came(const GazeYield& gaze) override { yields.push_back(gaze); }
    void observer_fields(const std::vector<RecordedObserverField>& filled) override { fields = filled; }
    void trial_started(const Trial& trial, SessionTime) override { started.push_back(trial.index); }
    void trial_finished(const Trial&, const TrialOutcome& outcome) override {
        outcomes.push_back(outcome);
        completed.push_back(outcome.status == TrialOutcome::Status::completed);
    }
    /// The detail of each event of this kind.
    std::vector<std::string> details_of(std::string_view kind) const {
        std::vector<std::string> found;
        for (std::size_t i = 0; i < kinds.size(); ++i)
            if (kinds[i] == kind)
                found.push_back(details[i]);
        return found;
    }
    long count(std::string_view kind) const { return std::count(kinds.begin(), kinds.end(), kind); }

    int flips = 0, samples = 0;
    std::vector<std::string> kinds, details;
    std::vector<SessionTime> times;
    std::vector<int> started;
    std::vector<bool> completed;
    std::vector<TrialOutcome> outcomes;
    std::vector<RecordedConsent> consents;
    std::vector<GazeYield> yields;
    std::vector<RecordedCalibration> calibrations;
    std::vector<RecordedObserverField> fields;
};

struct Sitting {
    explicit Sitting(Protocol sat) : protocol(std::move(sat)) {}
    SessionResult run() {
        const Schedule schedule = make_schedule(protocol, {"P", 1}, 1);
        return Session(protocol, schedule, {960.0, 540.0},
                       {.clock = clock,
                        .presenter = presenter,
                        .tracker = tracker,
                        .panel = panel,
                        .log = log,
                        .listeners = {},
                        .observer = "P1",
                        .can_type = true,
                        .recorder = recorder,
                        .further_trackers = further,
                        .on_beep = [this](Beep beep) { beeps.push_back(beep); },
                        .on_camera = [this](const CameraImage& image) { cameras.push_back(image); },
                        .probe_of = probe_of,
                        .screen_changes = screen_changes,
                        .has_proven_times = has_proven_times},
                       fields)
            .run({});
    }
    Protocol protocol;
    StandingClock clock;
    PlainPresenter presenter{clock};
    BlinkingTracker tracker;
    ScriptedPanel panel{clock};
    NotingLog log;
    FieldValues fields;
    AnswerRecorder* recorder = nullptr;
    std::vector<FurtherTracker> further;
    std::vector<Beep> beeps;          ///< that were heard
    std::vector<CameraImage> cameras; ///< that the session told of
    std::function<std::shared_ptr<const ProbeView>(const PlacedStimulus&, const std::string& point)> probe_of;
    std::function<std::vector<std::string>()> screen_changes;
    bool has_proven_times = true;
};

inline Protocol short_protocol(std::string_view more) {
    const ReadText read(minimal_protocol, "[[material]]\nid = \"clay\"\nkind = \"diffuse\"\n"
                                          "[animation]\nduration_s = 0.1\n" +
                                              std::string(more));
    INFO(read.diagnostics.print());
    REQUIRE(read.protocol);
    return *read.protocol;
}

} // namespace overt::test
