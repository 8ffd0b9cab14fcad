/// A recorded session as its readers see it.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "experiment/analysis/flip_history.h"
#include "experiment/clock_map.h"
#include "experiment/events/event_thresholds.h"
#include "experiment/events/gaze_angles.h"
#include "experiment/gaze_event.h"
#include "experiment/ports/observer_field.h"
#include "experiment/ports/recorded_answer.h"
#include "experiment/ports/recorded_button.h"
#include "experiment/ports/recorded_calibration.h"
#include "experiment/ports/recorded_consent.h"
#include "experiment/ports/recorded_key_press.h"
#include "experiment/ports/recorded_marker.h"
#include "experiment/ports/session_history.h"
#include "experiment/ports/trial_outcome.h"
#include "experiment/record/recorded_box.h"
#include "experiment/record/resumption.h"
#include "experiment/record/session_header.h"
#include "experiment/timing/ledger_fit.h"

namespace SQLite {
class Database;
}

namespace overt {

/// Of what one presentation's slot showed: refreshes that were lit, and that went by with an old picture
/// while it was.
struct PresentedRefreshes {
    int shown = 0, missed = 0;
};

/// One attempt at a trial. The rows of interrupted attempts are kept beside those of the repetition.
struct TrialRecord {
    enum class Status : std::uint8_t {
        open, ///< running, or cut off when the program was killed
        completed,
        aborted,
        interrupted, ///< cut off, as a later sitting found
    };
    std::int64_t id = 0; ///< key of its flips and samples
    int sitting = 1;
    Trial trial;
    int attempt = 1; ///< counts from 1
    Status status = Status::open;
    bool is_superseded = false; ///< its block was restarted later
    bool counts = false;        ///< completed, and not superseded
    bool gives_results() const { return counts && trial.role == TrialRole::trial; }
    SessionTime started;
    TrialOutcome outcome; ///< meaningless while open, or interrupted; its times: see reached()
    std::int64_t lost_flips = 0;
    std::int64_t lost_samples = 0;
    /// The response box at which the observer answered, and how exactly the time of the answer is known;
    /// empty and nothing of a keyboard, and of sessions of earlier programs.
    std::string response_box = {};
    std::optional<SessionDuration> response_uncertainty = {};
    /// What was pressed to end the response screen; empty if time ended it, and of sessions of earlier
    /// programs.
    std::string response_key = {};

    /// By what the trial showed (Trial::shown), of a trial that showed several; else empty.
    std::vector<PresentedRefreshes> refreshes = {};

    /// Which of what the trial showed this is about; the others are in trial.beside. See seen_in().
    int place = 0;

    /// The attempt as the presentation of one stimulus in its slot, 0 <= i < trial.shown_count(): that
    /// stimulus is the trial's, in its slot, and the others are beside it. Its flips and the numbers of its
    /// refreshes are that slot's, and its onset and end those of the steps that lit the slot: before the
    /// attempt's begin, where none did.
    TrialRecord seen_in(std::size_t i) const;
    /// From when to when each step lit it, of steps that ended; none of sessions whose trials have no steps.
    std::vector<std::pair<SessionTime, SessionTime>> lit_spans() const;
    /// It came to its end, in order or not.
    bool has_outcome() const { return status == Status::completed || status == Status::aborted; }
    /// It got to the screen, or the answer, that its outcome has at this time: those that it did not get to,
    /// or that an imported recording does not tell of, are before its begin.
    bool reached(SessionTime screen) const { return has_outcome() && screen >= started; }
};
std::string_view name_of(TrialRecord::Status status);

/// The flips of a trial as they were written down, at least one, and as the line through all time stamps has
/// them.
struct TrialLedger {
    std::vector<FlipRecord> recorded;
    LedgerFit fit;
};

/// The steps of an attempt that its outcome does not tell by a time of its own: fixations, blanks, masks,
/// feedback, texts and shows after the first, and drift checks but that of the task without steps.
std::vector<const AttemptStep*> further_steps(const TrialRecord& trial);

/// A step `show` of an attempt, as its flips tell it of the stimulus in one slot.
struct RecordedShow {
    std::size_t begin = 0, end = 0; ///< its flips: the first, and the one after the last
    int first_refresh = 0;          ///< FlipRecord::refresh_in_trial of its onset, from which its plan counts
    bool is_lit = true;             ///< it lights this slot
    PageCycle plan;                 ///< the motion, cut to what the step said
};

/// The shows of a presentation (TrialRecord::seen_in) by the flips of its attempt, in their order.
std::vector<RecordedShow> shows_of(const SessionHeader& header, const TrialRecord& trial,
                                   std::span<const FlipRecord> flips);

/// A SessionEvent that owns its words.
struct RecordedEvent {
    int sitting = 1;
    SessionTime at;
    int trial = -1; ///< -1: outside of trials
    std::string kind;
    std::string detail;
};

/// Reads a session and changes nothing in it, whether it was closed, is running, or was killed. Holds the
/// header and the list of trials; flips and samples are read one trial at a time, so memory does not grow
/// with the session. One thread at a time; each thread may open its own.
///
/// All functions throw RecordError if the file turns out to be damaged.
class SessionRecord {
  public:
    /// A session's directory, or the session file itself.
    explicit SessionRecord(const std::filesystem::path& session);
    ~SessionRecord();
    SessionRecord(SessionRecord&&) noexcept;
    SessionRecord& operator=(SessionRecord&&) noexcept;

    const std::filesystem::path& directory() const { return directory_; }
    const SessionHeader& header() const { return header_; }

    /// All attempts, in the order in which they were made.
    const std::vector<TrialRecord>& trials() const { return trials_; }

    /// All presentations of stimuli, a row for each slot of an attempt, in the order of trials().
    std::vector<TrialRecord> presentations() const;

    /// In the order in which they were written. Which refreshes were missed is told by ledger(): the record's
    /// rows of them are what the presenting program knew at once.
    std::vector<FlipRecord> flips(const TrialRecord& trial) const;
    /// What the observer had moved the slot of a presentation to, by the number of the refresh in the trial;
    /// none where the observer moved nothing.
    std::vector<SteeredFlip> steered_flips(const TrialRecord& trial) const;
    std::vector<GazeSample> samples(const TrialRecord& trial) const;
    /// The same in pieces of at most `most` samples, so that memory does not grow with the trial.
    void read_samples(const TrialRecord& trial, std::size_t most,
                      const std::function<void(std::span<const GazeSample>)>& take) const;

    /// The same of samples between a trial's result and the next trial, which belong to no trial: only
    /// imported recordings have such.
    void read_samples_after(const TrialRecord& trial, std::size_t most,
                            const std::function<void(std::span<const GazeSample>)>& take) const;

    /// Times of the earliest and the latest sample of a trial; nothing if it has none.
    std::optional<std::pair<TrackerTime, TrackerTime>> sample_span(const TrialRecord& trial) const;

    /// What the tracker itself said during a trial, and its fixations, saccades and blinks by whoever
    /// event_origin() names; those that are found now come last, in the order of their ends.
    void read_gaze_events(const TrialRecord& trial, const std::function<void(const GazeEvent&)>& take) const;
    /// The same before the first trial.
    void read_gaze_events_before(const std::function<void(const GazeEvent&)>& take) const;
    /// The same between a trial's result and the next trial.
    void read_gaze_events_after(const TrialRecord& trial,
                                const std::function<void(const GazeEvent&)>& take) const;
    /// The same outside of trials: before the first and between them.
    void read_gaze_events_outside(const std::function<void(const GazeEvent&)>& take) const;
    /// Where a sitting's fixations, saccades and blinks come from.
    struct EventOrigin {
        enum class From : std::uint8_t {
            nobody,    ///< there are none
            tracker,   ///< it told them, in the file that was imported
            recording, ///< the program found them while it recorded
            reading,   ///< they are found now, from the samples
            no_angles  ///< they would be found now, but that nothing tells what an angle is on the screen
        };
        From from = From::nobody;
        EventDetection detection = {}; ///< the program's
        EventSettings settings = {};   ///< of those that are found now
    };
    /// Sessions of earlier programs have no events: they are found now, over a sitting as a whole, by the
    /// thresholds that go with its rate and noise. So are those of imports that were to have them found
    /// (with what was noted then), and after detect_events_of_imports() or detect_events(). An import is
    /// otherwise given as its file has it. The first question after a sitting that is found now reads its
    /// samples.
    EventOrigin event_origin(int sitting) const;
    /// Also where a recording was imported without any fixation, saccade and blink.
    void detect_events_of_imports();
    /// In all sittings, in place of those that are on record, which stay there.
    void detect_events(const ChosenThresholds& chosen);
    /// Does as `other`, a reader of the same session, and finds together with it what both need; then each
    /// may be on a thread of its own.
    void detect_events_as(const SessionRecord& other);
    /// The origins of all sittings as sentences, for who reads an export; empty if there are no events.
    std::string event_origins() const;

    /// By the session's screen, else by the imported recording's resolution; nothing if neither is known.
    std::optional<GazeAngles> gaze_angles(int sitting) const;

    /// The file that a sitting's gaze came from; nothing if it came from the tracker itself.
    std::optional<GazeSource> gaze_source(int sitting) const;
    /// Which eyes the samples of a sitting are of. Reads them all.
    struct Eyes {
        bool left = false, right = false;
        bool both() const { return left && right; }
        bool none() const { return !left && !right; }
    };
    Eyes eyes(int sitting) const;

    std::vector<RecordedEvent> events() const;
    /// The same one by one, so that memory does not grow with the session.
    void read_events(const std::function<void(const RecordedEvent&)>& take) const;

    /// What buttons of response boxes did, and what became of markers at their outputs, in the order in which
    /// they were written. Sessions of earlier programs have none.
    std::vector<RecordedButton> button_changes() const;
    std::vector<RecordedMarker> markers() const;

    /// Keys and buttons that were pressed in trials, and on the screens between them, likewise.
    std::vector<RecordedKeyPress> key_presses() const;

    /// Each time that somebody agreed to take part, or did not.
    std::vector<RecordedConsent> consents() const;

    /// The spoken answer of an attempt, if one was recorded. Its `trial` is the attempt's.
    std::optional<RecordedAnswer> answer_recording(const TrialRecord& trial) const;

    /// What the observer filled in, in the order of the form. Sessions of earlier programs have nothing.
    std::vector<RecordedObserverField> observer_fields() const;

    /// When a sitting began, by the wall clock, ISO 8601; empty if there is no such sitting.
    std::string started_utc(int sitting) const;

    /// Readings of both clocks in one sitting: between sittings the tracker may have been restarted.
    std::vector<ClockPair> clock_pairs(int sitting) const;
    /// Set-ups of the eye tracker; none in sessions of programs that did not record them.
    std::vector<RecordedCalibration> calibrations(int sitting) const;

    /// Nothing if that sitting read the clocks never.
    std::optional<ClockMap> clock_map(int sitting) const;
    /// The same for a trial's samples: of the run of the tracker's clock that its presentation was in.
    std::optional<ClockMap> clock_map(const TrialRecord& trial) const;

    /// What each sitting's display was sent through, by sitting. Sessions of earlier programs say nothing.
    std::vector<std::pair<int, RecordedBox>> display_boxes() const;

    /// Readings of the display box's clock in one sitting, in the order in which they were made.
    std::vector<BoxClockPair> box_clock_readings(int sitting) const;

    /// The flips of a trial, with the line through their time stamps by the refresh interval that all trials
    /// of its sitting have together; nothing of a trial without flips. Reads them: keep it while it is
    /// needed.
    std::optional<TrialLedger> ledger(const TrialRecord& trial) const;

    /// A trial's frames as they were lit on this session's display, at the times of the ledger's line.
    FlipHistory flip_history(const TrialRecord& trial, const std::optional<TrialLedger>& ledger) const;

    /// The latest session time that any row names: from here on a resumed session's clock may go on.
    SessionTime last_time() const;

    /// The last sitting was closed in order: nothing was killed or failed since. False before the first.
    bool closed_in_order() const;
    /// The same of one sitting.
    bool closed_in_order(int sitting) const;

    /// How each sitting after the first took the session up, by the word of its resume policy; empty for
    /// sessions of earlier programs.
    std::vector<std::pair<int, std::string>> resumptions() const;

    /// The options of the command that a sitting was run with. None of sittings of programs that did not
    /// record them, and of imported sessions.
    std::vector<RecordedOption> run_options(int sitting) const;

    /// Indices of trials that were skipped when the session was taken up again.
    std::vector<int> skipped_trials() const;

    /// Each trial has an attempt that counts or will not be attempted any more, and the session was closed in
    /// order.
    bool is_complete() const;

    /// What was done, for a session that is taken up again, or to see whether it is complete.
    SessionHistory history() const;

    /// Reads the whole file and gives a sentence for each thing that is wrong with it; empty if it is sound.
    std::vector<std::string> damages() const;

    /// Lets go of the file until something is read again: each session that is open holds descriptors, of
    /// which a program has some hundred. No read may be under way.
    void rest() const noexcept;

  private:
    const SQLite::Database& database() const;
    std::optional<KnownInterval> refresh_interval(int sitting) const;
    EventOrigin find_event_origin(int sitting) const;
    struct FindingEvents;
    struct FoundEvents;
    void make_ready_to_find();
    /// Of a sitting whose events are found now: by what, and if `with_events` the events themselves.
    const FoundEvents& found_events(int sitting, bool with_events) const;
    /// All samples of a sitting in their order. `begin` is told the trial_id of those that follow and the
    /// time of the first; `take` as TakeGaze.
    void read_sitting(int sitting, const std::function<void(std::int64_t trial_id, TrackerTime first)>& begin,
                      const std::function<void(std::span<const GazeSample>, bool begins)>& take) const;
    bool is_found_now(int sitting) const;
    void read_gaze_events_in(int sitting, std::int64_t trial_id,
                             const std::function<void(const GazeEvent&)>& take) const;
    void read_samples_of(std::int64_t trial_id, std::size_t most,
                         const std::function<void(std::span<const GazeSample>)>& take) const;
    void read_gaze_events_of(std::int64_t trial_id, const std::function<void(const GazeEvent&)>& take) const;

    std::filesystem::path directory_;
    std::filesystem::path file_;
    mutable std::unique_ptr<SQLite::Database> database_; ///< null while nothing is read: see rest()
    SessionHeader header_;
    std::vector<TrialRecord> trials_;
    mutable std::map<int, std::optional<KnownInterval>> intervals_; ///< by sitting, once asked for
    mutable std::map<int, EventOrigin> event_origins_;              ///< the same
    std::shared_ptr<FindingEvents> finding_;                        ///< together with other readers
};

/// A whole sentence; empty if nobody found any.
std::string sentence_on(const SessionRecord::EventOrigin& origin);

} // namespace overt
