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
#include "experiment/ports/answer_offer.h"
#include "experiment/ports/trial_mark.h"
#include "experiment/ports/turning_offer.h"
#include "experiment/session/session.h"
#include "tests/experiment/protocol/protocol_fixtures.h"

namespace overt::test {

class StandingClock final : public Clock {
  public:
    SessionTime now() const noexcept override { return now_; }
    void wait_until(SessionTime time) noexcept override { now_ = std::max(now_, time); }
    Disturbance disturbance() const noexcept override { return disturbed; }

    Disturbance disturbed;

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
        if (screen.kind == Screen::Kind::target)
            targets.push_back(screen.target_place);
        blanks += screen.kind == Screen::Kind::blank;
        veiled_blanks += screen.kind == Screen::Kind::blank && is_veiled;
        return next();
    }
    void expect_slots(std::span<const PlacedStimulus> shown) noexcept override {
        expected.push_back(shown.front().stimulus);
    }
    void put_beside_stimuli(const AnswerView* answers) override {
        beside.push_back(answers ? std::optional(*answers) : std::nullopt);
    }
    AnswerPlace place_in_answers(double right_px, double down_px) const noexcept override {
        return place_at ? place_at(right_px, down_px) : AnswerPlace{};
    }
    void show_level(const LevelBar& bar) override { bars.push_back(bar); }
    FlipReport flip_slots(std::span<const AnimationFrameIndex> frames) noexcept override {
        for (const AnimationFrameIndex frame : frames)
            (is_veiled ? veiled_frames : seen_frames).push_back(frame.value);
        if (passes)
            refresh_ += passes(flips_++);
        return next();
    }
    void veil(bool is_on) override { is_veiled = is_on; }
    void mark_stimuli(std::span<const StimulusMark> given,
                      std::span<const StimulusMark> of_other_eye) noexcept override {
        marks.assign(given.begin(), given.end());
        others_marks.assign(of_other_eye.begin(), of_other_eye.end());
        all_marks.push_back(marks);
    }
    bool closed() const noexcept override { return is_closed && is_closed(); }

    std::vector<Stimulus> loaded;
    std::vector<std::string> texts;
    std::vector<Screen> screens; ///< of the texts
    std::vector<LevelBar> bars;
    std::vector<std::optional<ScreenPoint>> targets;     ///< where each that was shown stood
    std::vector<Stimulus> expected;                      ///< the first of each time
    std::vector<std::optional<AnswerView>> beside;       ///< what stood beside stimuli; nothing: nothing more
    std::function<AnswerPlace(double, double)> place_at; ///< what of an answer is at a place of the screen
    int blanks = 0, veiled_blanks = 0;                   ///< of the screens
    bool is_veiled = false;
    std::vector<int> seen_frames, veiled_frames; ///< of flips
    std::function<bool()> is_closed;
    std::vector<StimulusMark> others_marks;           ///< of the other eye, given last
    std::vector<std::vector<StimulusMark>> all_marks; ///< that were ever given
    std::vector<StimulusMark> marks;                  ///< that stand over stimuli now
    std::function<int(int flip)> passes; ///< how many refreshes go by before a flip of stimuli, from 0

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
    int flips_ = 0;
};

/// Sees no eye during the presentations that it is told of, by their number from 0.
class BlinkingTracker final : public EyeTracker {
  public:
    TrackerDescription description() const override { return {"blinking", sample_rate_hz, Eye::left}; }
    bool measures_gaze() const noexcept override { return is_there; }
    bool calibrates_itself() const noexcept override { return calibrates; }
    enum class Step { set_up, drift_check, start };
    SetupOutcome set_up(SetupScreen& setup_screen) override {
        ++calibrations;
        fail(Step::set_up);
        if (camera)
            setup_screen.show_camera(*camera);
        if (sets_up)
            sets_up(setup_screen);
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
        if (!has_clock)
            return std::nullopt;
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
                item = GazeSample{.sampled_at = time_of(++samples_), .eye = Eye::left, .gaze = {}};
            held_ -= count;
            arrived += static_cast<int>(count);
            return count;
        }
        ++arrived;
        if (arrived == one_double)
            --samples_;
        GazeSample sample{.sampled_at = doubles ? time_of(samples_ += arrived % 2) : time_of(++samples_),
                          .eye = Eye::left,
                          .gaze = {}};
        if (std::find(blind.begin(), blind.end(), recording_) == blind.end())
            sample.gaze = looks ? looks(recording_) : ScreenPoint{1.0, 2.0};
        if (stamps)
            sample.sampled_at = stamps();
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
    /// Where gaze is, in the other recordings, by their number from 0.
    std::function<std::optional<ScreenPoint>(int recording)> looks;
    std::function<void(SetupScreen&)> sets_up;         ///< what each calibration does besides
    bool calibrates = true;                            ///< by itself
    std::optional<CameraImage> camera;                 ///< shown in each calibration
    std::vector<SetupOutcome> set_ups;                 ///< what each calibration gives; then all is well
    std::function<RecordingState(int recording)> says; ///< of the recording under way, by its number from 0
    std::vector<std::pair<SessionTime, std::string>> marks;
    std::optional<Step> fails_at;        ///< once, as a tracker that is gone
    int one_double = 0;                  ///< this one that it hands over has the time of the one before
    std::function<TrackerTime()> stamps; ///< when a sample is taken
    bool doubles = false;                ///< gives every other sample twice
    std::function<ClockPair(int reading)> reads; ///< what each reading of the clocks gives
    int set_ups_wanted = 0;                      ///< by so many drift checks
    int reconnections = 0, refused_reconnections = 0;
    std::vector<std::optional<Degrees>> first_drifts; ///< that the first drift checks find
    std::optional<Degrees> drift = Degrees{0.1};      ///< that each later one finds
    std::size_t late = 0; ///< samples that arrive only when the recording has ended
    int calibrations = 0, drift_checks = 0, clock_readings = 0;
    int arrived = 0; ///< samples handed over
    double sample_rate_hz = 1000.0;
    bool is_there = true;
    bool has_clock = true; ///< that can be read

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
    void await(Awaited what, SessionTime since, const Trial* of) override {
        awaited.push_back({what, since, of ? of->index : -1});
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
    void offer(const std::vector<AnswerOffer>& answers) override {
        opened.reset();
        offered.push_back(answers);
    }
    void offer_turning(const TurningOffer& turning) override { turnings.push_back(turning); }
    void window_opened(SessionTime at) noexcept override {
        opened = at;
        openings.push_back(at);
    }
    std::optional<ObserverInput> next_input() noexcept override {
        return does ? does(*this, clock_.now()) : std::nullopt;
    }
    std::string answer() override { return "yes"; }
    void write_down(SessionLog&) override {
        written_in = phases.empty() ? SessionPhase::set_up : phases.back();
    }
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
    struct Await {
        Awaited what;
        SessionTime since;
        int trial;
    };
    std::vector<Await> awaited;
    std::vector<std::vector<AnswerOffer>> offered;
    SessionPhase written_in = SessionPhase::set_up; ///< what its devices did was recorded last
    std::vector<TurningOffer> turnings;
    std::vector<SessionTime> openings; ///< of windows of answers
    int trial = -1;
    int looks = 0; ///< in this phase

  private:
    StandingClock& clock_;
    SessionTime last_{};
    Key awaited_ = Key::next;
};

class NotingLog final : public SessionLog {
  public:
    void flip(const FlipRecord& flip) noexcept override {
        ++flips;
        lit.push_back(flip);
    }
    void missed(const MissedRefresh&) noexcept override { ++missed_refreshes; }
    void sample(int, const GazeSample&) noexcept override { ++samples; }
    void clock_pair(const ClockPair&) noexcept override {}
    void calibration(const RecordedCalibration& calibration) override { calibrations.push_back(calibration); }
    void event(const SessionEvent& event) override {
        kinds.emplace_back(event.kind);
        details.push_back(event.detail);
        times.push_back(event.at);
    }
    void answer_recorded(const RecordedAnswer& answer) override { answers.push_back(answer); }
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

    int flips = 0, samples = 0, missed_refreshes = 0;
    std::vector<FlipRecord> lit; ///< each of the flips
    std::vector<std::string> kinds, details;
    std::vector<SessionTime> times;
    std::vector<int> started;
    std::vector<bool> completed;
    std::vector<TrialOutcome> outcomes;
    std::vector<RecordedAnswer> answers;
    std::vector<RecordedConsent> consents;
    std::vector<GazeYield> yields;
    std::vector<RecordedCalibration> calibrations;
    std::vector<RecordedObserverField> fields;
};

/// What holds of an attempt at a trial, whatever happened in it: its steps follow one another, and its times
/// are theirs.
inline void check_attempt(const TrialOutcome& outcome, const BlinkingTracker& tracker) {
    constexpr double refresh_s = 8'333'333e-9;
    const auto told = [&](SessionTime at, const std::string& text) {
        return std::ranges::count(tracker.marks, std::pair(at, text));
    };
    const AttemptStep *text = nullptr, *first_show = nullptr, *last_show = nullptr, *answer = nullptr;
    int answers = 0;
    std::optional<SessionTime> before;
    for (const AttemptStep& step : outcome.steps) {
        INFO(step.kind << " " << step.id);
        CHECK(step.ended_by);
        if (!step.begin)
            continue;
        REQUIRE(step.end);
        CHECK(*step.end >= *step.begin);
        CHECK(*step.begin > SessionTime());
        if (before)
            CHECK(*step.begin >= *before);
        before = step.end;
        if (step.ended_by == StepEnd::time && step.planned_refreshes && step.kind != "answer")
            CHECK(std::abs(to_seconds(*step.end - *step.begin) / refresh_s - *step.planned_refreshes) < 0.6);
        if (step.kind == "fixation" || step.kind == "blank" || step.kind == "mask" || step.kind == "feedback")
            CHECK(told(*step.begin, "STEP " + step.kind + (step.id.empty() ? "" : " " + step.id)) == 1);
        if (step.kind == "text" && !step.planned_refreshes && !text)
            text = &step;
        if (step.kind == "show") {
            first_show = first_show ? first_show : &step;
            last_show = &step;
        }
        if (step.kind == "answer" && answers++ == 0)
            answer = &step;
    }
    if (text)
        CHECK(outcome.task_screen_onset == *text->begin);
    if (first_show) {
        CHECK(outcome.presentation_onset == *first_show->begin);
        CHECK(told(*first_show->begin, "SYNCTIME") == 1);
        CHECK(outcome.presentation_end == *last_show->end);
        CHECK(told(*last_show->end, std::string(presentation_end_mark)) == 1);
    }
    if (answer)
        CHECK(outcome.response_screen_onset == *answer->begin);
    if (answers == 1 && outcome.given.empty())
        CHECK(outcome.responded_at == *answer->end);
    const GivenAnswer* last = nullptr;
    for (const GivenAnswer& given : outcome.given)
        if (!given.is_missed && (!last || *given.answered_at > *last->answered_at))
            last = &given;
    if (last) {
        CHECK(outcome.responded_at == *last->answered_at);
        CHECK(outcome.responded_uncertainty == last->uncertainty);
    }
}

struct Sitting {
    explicit Sitting(Protocol sat) : protocol(std::move(sat)) {}
    SessionResult run(const SessionHistory& history = {}) {
        const SessionResult result = run_unchecked(history);
        check(result, history);
        return result;
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
    std::vector<PresentationListener*> listeners;
    std::vector<MarkerSink*> markers;
    std::vector<Beep> beeps;          ///< that were heard
    std::vector<CameraImage> cameras; ///< that the session told of
    std::function<std::shared_ptr<const ProbeView>(const PlacedStimulus&, const std::string& point)> probe_of;
    std::function<std::shared_ptr<const AreaView>(const PlacedStimulus&, const std::string& area)> area_of;
    std::function<std::vector<std::string>()> screen_changes;
    bool has_proven_times = true;

  private:
    SessionResult run_unchecked(const SessionHistory& history) {
        const Schedule schedule = make_schedule(protocol, {"P", 1}, 1);
        return Session(protocol, schedule, {960.0, 540.0},
                       {.clock = clock,
                        .presenter = presenter,
                        .tracker = tracker,
                        .panel = panel,
                        .log = log,
                        .listeners = listeners,
                        .observer = "P1",
                        .can_type = true,
                        .recorder = recorder,
                        .markers = markers,
                        .further_trackers = further,
                        .on_beep = [this](Beep beep) { beeps.push_back(beep); },
                        .on_camera = [this](const CameraImage& image) { cameras.push_back(image); },
                        .area_of = area_of,
                        .probe_of = probe_of,
                        .screen_changes = screen_changes,
                        .has_proven_times = has_proven_times},
                       fields)
            .run({}, history);
    }
    /// What is waited for is waited for from the screen on that asks for it.
    void check_waits() const {
        SessionTime last;
        for (const ScriptedPanel::Await& wait : panel.awaited) {
            CHECK(wait.since >= last);
            last = wait.since;
            CHECK((wait.trial >= 0) == (wait.what == Awaited::response || wait.what == Awaited::answer));
        }
        for (const TrialOutcome& outcome : log.outcomes)
            for (const SessionTime onset : {outcome.task_screen_onset, outcome.response_screen_onset})
                if (onset != SessionTime())
                    CHECK(std::ranges::any_of(panel.awaited, [&](const ScriptedPanel::Await& wait) {
                        return wait.since == onset || wait.what == Awaited::answer;
                    }));
    }
    /// What holds of every session, whatever happened in it: sums, and what is said of the same thing twice.
    void check(const SessionResult& result, const SessionHistory& history) const {
        int shown = 0, missed = 0;
        for (const TrialOutcome& outcome : log.outcomes) {
            check_attempt(outcome, tracker);
            shown += outcome.shown_refreshes;
            missed += outcome.missed_refreshes;
        }
        CHECK(log.flips == shown);
        CHECK(log.missed_refreshes == missed);
        CHECK(result.missed_refreshes == missed);
        CHECK(result.completed_trials - history.counted_trials == std::ranges::count(log.completed, true));
        CHECK(log.started.size() == log.outcomes.size());
        std::vector<std::string> entered;
        for (const SessionPhase phase : panel.phases)
            entered.emplace_back(name_of(phase));
        std::vector<std::string> noted = log.details_of("phase");
        for (std::string& name : noted)
            name = name.substr(0, name.find(", in practice"));
        CHECK(noted == entered);
        CHECK(log.count("operator asked") == log.count("operator answered"));
        check_waits();
        CHECK(panel.written_in == SessionPhase::end);
        CHECK((std::ranges::count(panel.awaited, Awaited::setup, &ScriptedPanel::Await::what) > 0) ==
              (tracker.calibrations > 0));
        CHECK(log.kinds.back() == (result.aborted ? "session aborted" : "session completed"));
        // Each attempt, practice too, is told when it begins and how it ended.
        const auto told = [&](std::string_view beginning) {
            return std::ranges::count_if(tracker.marks, [&](const auto& mark) {
                return std::string_view(mark.second).starts_with(beginning);
            });
        };
        CHECK(told("TRIALID ") == told("TRIAL_RESULT "));
        CHECK(told("TRIALID ") - told("TRIALID practice ") == std::ssize(log.started));
        for (std::size_t i = 0; i < log.lit.size(); ++i) {
            const FlipRecord& flip = log.lit[i];
            if (flip.shown == no_frame) // the first of the trial's stimuli is not lit
                continue;
            const bool is_new = i == 0 || flip.trial != log.lit[i - 1].trial ||
                                flip.shown != log.lit[i - 1].shown || flip.step != log.lit[i - 1].step ||
                                flip.refresh_in_trial == 0;
            const auto mark =
                std::pair(flip.report.vertical_blank, "FRAME " + std::to_string(flip.shown.value));
            CHECK((std::ranges::count(tracker.marks, mark) == 1) == is_new);
        }
    }
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
