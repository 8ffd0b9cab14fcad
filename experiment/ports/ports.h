/// What a session needs from the outside world. render/ and devices/ implement these; experiment/ only calls
/// them. Unless a function says otherwise, all of one session's ports are used from the session's thread.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiment/flip_report.h"
#include "experiment/gaze.h"
#include "experiment/ports/observer_field.h"
#include "experiment/ports/session_phase.h"
#include "experiment/ports/sitting_rows.h"
#include "experiment/session_time.h"
#include "experiment/trial.h"
#include "experiment/units.h"

namespace overt {

/// The session clock. Real: steady time since the session began. Virtual: stands still until somebody waits.
/// now() may be called from any thread.
class Clock {
  public:
    virtual ~Clock() = default;
    virtual SessionTime now() const noexcept = 0;
    /// Returns at `time` or, if that is past, at once.
    virtual void wait_until(SessionTime time) noexcept = 0;

    /// What other clocks of the machine say of this one's past.
    struct Disturbance {
        SessionDuration slept{};      ///< the machine was suspended so long; session time stood still then
        SessionDuration wall_moved{}; ///< the wall clock was set forward by this much, sleep not counted
    };
    /// Since the session began. Any thread; nothing is allocated.
    virtual Disturbance disturbance() const noexcept { return {}; }
};

/// A screen that is not a stimulus.
struct Screen {
    enum class Kind : std::uint8_t {
        blank,
        text,
        form, ///< a text whose lines begin below each other instead of being centred
        drift_target
    };
    Kind kind = Kind::blank;
    std::string text; ///< UTF-8, for text and form; paragraphs split by newlines
};

/// How the display shows things: known once the presenter is open.
struct DisplayTiming {
    double refresh_hz = 0.0; ///< nominal
    VblankSource source = VblankSource::virtual_display;
};

/// A level meter for who speaks, or watches who speaks: lengths are shares of the whole bar.
struct LevelBar {
    double mean = 0.0, peak = 0.0;
    std::string warning; ///< UTF-8; empty: nothing is wrong
    bool operator==(const LevelBar&) const = default;
};

/// Shows pictures at refreshes of the display. Loading may take long and throw; flipping does neither.
class Presenter {
  public:
    virtual ~Presenter() = default;

    virtual DisplayTiming timing() const = 0;

    /// Puts the frames of a stimulus into the frame store, replacing those loaded before. Throws
    /// GraphicsError or InputError.
    virtual void load_frames(const Condition& condition) = 0;

    /// The stimulus that will be loaded next: a presenter may begin with it now, in the background.
    virtual void expect_frames(const Condition& /*condition*/) noexcept {}
    /// The screen stands still and a few milliseconds matter to nobody. Called again and again.
    virtual void use_spare_time() noexcept {}

    /// Draws a screen and shows it at the next refresh; it stays until the next call. Lays out text, so not
    /// for use between a presentation's first and last flip.
    virtual FlipReport show(const Screen& screen) = 0;

    /// Draws a level meter below the middle of the screen that is shown, at the next refresh. Not for use
    /// between a presentation's first and last flip.
    virtual void show_level(const LevelBar& /*bar*/) {}

    /// Shows a frame of the loaded stimulus at the next refresh and returns when that refresh has begun.
    /// Allocates, opens and throws nothing.
    virtual FlipReport flip(AnimationFrameIndex frame) noexcept = 0;

    /// The window was closed or the display went away. The session ends the trial and then itself.
    virtual bool closed() const noexcept = 0;

    /// Why, once closed(): what follows «the session ended early: ».
    virtual std::string why_closed() const { return "the display was closed"; }
};

/// Sees what the observer sees: a simulated observer, or the operator's view. Called at each flip, on the
/// session's thread, between a presentation's first and last flip too: allocates and throws nothing.
class DisplayWitness {
  public:
    virtual ~DisplayWitness() = default;
    /// A presentation of this trial begins with the next flip.
    virtual void presentation_begins(const Trial& trial) noexcept = 0;
    virtual void saw(const FlipRecord& flip) noexcept = 0;
    virtual void saw_screen(const Screen& screen, SessionTime onset) noexcept = 0;
};

struct TrackerDescription {
    std::string name;
    double sample_rate_hz = 0.0;
    Eye eye = Eye::right;
};

/// Accuracy reached by a calibration, from its validation.
struct ValidationResult {
    Degrees mean_error;
    Degrees max_error;
};

class EyeTracker {
  public:
    virtual ~EyeTracker() = default;
    virtual TrackerDescription description() const = 0;

    /// Calibrates and validates. Throws DeviceError if the tracker is lost.
    virtual ValidationResult calibrate() = 0;

    /// Measured distance between the gaze and a target that is shown now, or nothing if no eye was found
    /// within the tracker's own time limit.
    virtual std::optional<Degrees> drift_check(ScreenPoint target) = 0;

    /// Reads both clocks at once, as tightly as the link allows.
    virtual ClockPair read_clocks() noexcept = 0;

    virtual void start_recording() = 0;
    virtual void stop_recording() = 0;

    /// Takes samples that have arrived, oldest first; gives their number. Call until it gives less than the
    /// span holds. Allocates and throws nothing.
    virtual std::size_t poll(std::span<GazeSample> into) noexcept = 0;

    virtual bool lost() const noexcept = 0;
};

/// A key or button with which the observer or the operator answers.
struct ResponsePress {
    enum class Key : std::uint8_t {
        next,
        back,
        // Of a decision.
        yes,
        no,
        // Of an entry; digits of a decision, too, are characters.
        character,
        erase,
        up,
        down,
        left,
        right,
        // The operator's.
        pause,
        recalibrate,
        repeat, ///< the trial that is running, at once
        reject, ///< the same, when the protocol says
        skip,   ///< it for good
        abort,  ///< the session
    };
    Key key = Key::next;
    SessionTime pressed_at;
    char32_t character = 0;
};
constexpr bool is_operators(ResponsePress::Key key) { return key >= ResponsePress::Key::pause; }

/// Keys that the operator pressed are never forgotten, whatever is waited for.
class ResponsePanel {
  public:
    virtual ~ResponsePanel() = default;
    /// A text is being read, to be gone on from with a key. Forgets earlier presses.
    virtual void await_key(SessionTime since) = 0;
    /// The question of a trial is to be answered from now on. Forgets earlier presses.
    virtual void await_response(const Trial& trial, SessionTime since) = 0;
    /// Yes or no, or a digit. `is_consent`: the observer decides whether to take part, else the operator.
    /// Forgets earlier presses.
    virtual void await_decision(bool is_consent, SessionTime since) = 0;
    /// A form is being filled in: keys of letters are letters. Forgets earlier presses.
    virtual void await_entry(SessionTime since) = 0;
    /// The next press, if there was one. Allocates and throws nothing: it is called during presentations.
    virtual std::optional<ResponsePress> poll() noexcept = 0;
    /// What was said or typed in answer, once the press has come; empty if the panel takes none.
    virtual std::string answer() = 0;
    /// The session has come to this phase; `trial` is -1 outside of trials.
    virtual void entered(SessionPhase /*phase*/, int /*trial*/) noexcept {}
};

/// A spoken answer that is being recorded, with all that belongs to it: nothing is shared with the one before
/// or after. No call waits for the sound device or the disk.
class AnswerRecording {
  public:
    virtual ~AnswerRecording() = default;
    /// The response screen was lit; to be told once, after the recording has begun.
    virtual void response_screen_lit(SessionTime onset) noexcept = 0;
    virtual AudioLevel level() const noexcept = 0;
    /// What is said up to then belongs to it.
    virtual void end(SessionTime at) noexcept = 0;
    /// What became of it, once its file is complete; some time after end().
    virtual std::optional<RecordedAnswer> result() = 0;
};

/// Where spoken answers go.
class AnswerRecorder {
  public:
    virtual ~AnswerRecorder() = default;
    /// Begins now. One at a time.
    virtual std::unique_ptr<AnswerRecording> begin(const Trial& trial) = 0;
};

/// What happened, besides flips and samples.
struct SessionEvent {
    SessionTime at;
    int trial = -1; ///< -1: outside of trials
    std::string_view kind;
    std::string detail;
};

/// How a trial went.
struct TrialOutcome {
    enum class Status : std::uint8_t { completed, aborted };
    /// Whether the trial is attempted again, as far as that is decided.
    enum class Afterwards : std::uint8_t { undecided, never, now, end_of_block };
    Status status = Status::completed;
    std::string failure;                           ///< by which it does not count, or would not; empty: none
    Afterwards afterwards = Afterwards::undecided; ///< undecided: the session ended in it
    SessionTime task_screen_onset, presentation_onset, presentation_end, response_screen_onset, responded_at;
    int shown_refreshes = 0;
    int missed_refreshes = 0;
    std::optional<Degrees> drift;
    std::string answer;
};

/// Where a session writes itself down. flip(), missed() and sample() allocate, open and throw nothing and may
/// wait for the disk only where time is virtual; the others may throw RecordError.
class SessionLog {
  public:
    virtual ~SessionLog() = default;
    virtual void flip(const FlipRecord& flip) noexcept = 0;
    /// Comes before the flip that ended it.
    virtual void missed(const MissedRefresh& refresh) noexcept = 0;
    virtual void sample(int trial, const GazeSample& sample) noexcept = 0;
    virtual void clock_pair(const ClockPair& pair) noexcept = 0;
    virtual void event(const SessionEvent& event) = 0;
    /// What the observer filled in; replaces what was noted before.
    virtual void observer_fields(const std::vector<RecordedObserverField>& /*fields*/) {}
    virtual void consent(const RecordedConsent& /*consent*/) {}
    /// Of the attempt that was started last.
    virtual void answer_recorded(const RecordedAnswer& /*answer*/) {}
    virtual void trial_started(const Trial& trial, SessionTime at) = 0;
    /// All of the trial's rows are on disk when this returns.
    virtual void trial_finished(const Trial& trial, const TrialOutcome& outcome) = 0;
};

} // namespace overt
