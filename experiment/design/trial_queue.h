/// What comes next in a session: trials in their order, practice before them, texts and breaks between them,
/// and trials that failed once more.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "experiment/design/procedure_trials.h"
#include "experiment/ports/session_history.h"
#include "experiment/protocol/protocol.h"
#include "experiment/trial.h"

namespace overt {

struct SessionStep {
    enum class Kind : std::uint8_t {
        instructions, ///< the text of a block that begins
        practice,     ///< a trial that does not count, with feedback
        trial,
        pause,
        feedback ///< on a block that is over
    };
    Kind kind = Kind::trial;
    Trial trial;     ///< of practice, its index is that of the entry in the protocol's practice
    int attempt = 1; ///< at the trial
    int block = 0;   ///< that begins or is over, or that the trial is of
    std::optional<ProcedureChoice> choice = {}; ///< by which the trial has its stimulus
};

/// What decides whether an attempt counts.
struct AttemptResult {
    int missed_refreshes = 0;
    double gaze_lost_share = 0.0; ///< of the samples that the presentation should have given, 0 … 1
    std::vector<GivenAnswer> given = {};
    // By the operator.
    bool is_rejected = false;
    bool is_repeated = false;   ///< to come again at once, however often it was attempted
    bool is_skipped = false;    ///< not to come again
    bool is_broken_off = false; ///< the animation, by a key
    // By the eye tracker.
    bool is_tracker_lost = false;
    bool has_clock_jumped = false; ///< so that nothing tells when its samples were taken

    /// It does not go on, and never counts.
    bool is_over() const { return is_rejected || is_broken_off || is_tracker_lost || has_clock_jumped; }
};

/// Those from `rejected` on never count.
enum class TrialFailure : std::uint8_t {
    none,
    missed_refreshes,
    gaze_lost,
    rejected,
    repeated,
    skipped,
    broken_off,
    tracker_lost,
    clock_jumped
};
template <>
inline constexpr auto
    names_of<TrialFailure> = enum_names<TrialFailure>("none", "missed refreshes", "gaze lost", "rejected",
                                                      "repeated", "skipped", "broken off", "eye tracker lost",
                                                      "eye tracker's clock jumped");

/// With a larger share of its gaze lost an attempt is said to have none, whatever the protocol repeats for.
inline constexpr double hardly_any_gaze = 0.95;

/// What is made of an attempt.
struct AttemptVerdict {
    TrialFailure failure = TrialFailure::none;
    RepeatWhen comes_again = RepeatWhen::never;
    /// The attempt counts: it did not fail, or fails by nothing that it would be repeated for, or all
    /// attempts are used up. An attempt that the operator broke off never counts.
    bool counts = true;
};

/// What taking up a session again made of the trial that it was interrupted in.
struct ResumeEffect {
    std::optional<int> skipped;         ///< index of the trial that does not come again
    std::optional<int> restarted_block; ///< whose attempts no longer count
};

/// Plans a session step by step. It ends for any outcomes: no trial is attempted more than
/// repeat.most_attempts times, but for what the operator repeats by hand.
class TrialQueue {
  public:
    /// Both must outlive the queue.
    TrialQueue(const Protocol& protocol, const Schedule& schedule);

    /// Nothing when the session is over. After a trial, tell() must come first; practice needs no telling.
    std::optional<SessionStep> next();

    /// How the trial went that next() gave last, and what was answered in it.
    AttemptVerdict tell(const AttemptResult& result);

    /// Goes through what an interrupted session had done; what is next then is what would have been next, but
    /// for the trial that was interrupted: resume() decides about that. Practice and breaks that were done do
    /// not come again. Only before the first next(). Throws RecordError for steps that this queue would not
    /// have gone.
    void go_through(std::span<const RecordedStep> steps);

    /// Takes up the interrupted trial. Having been interrupted uses up none of repeat.most_attempts. Without
    /// such a trial redo and skip do nothing.
    ResumeEffect resume(ResumePolicy policy);

    /// Trials that do not come, since their block's criterion is met; each once.
    std::vector<int> take_left_out() { return std::exchange(left_out_, {}); }

    /// No trial is waiting, and none was interrupted.
    bool is_done() const { return waiting_.empty() && !interrupted_; }

    /// The trial that will come next if nothing fails.
    std::optional<Trial> expected() const;

  private:
    struct Attempt {
        Trial trial;
        int number = 1;
    };
    AttemptVerdict judge(const AttemptResult& result) const;
    void put_back(const Attempt& attempt, RepeatWhen when);
    void look_ahead();
    void leave_out_to_practice();
    void go_on_to_trial(int trial);
    void take_fate(AttemptFate fate, const std::vector<GivenAnswer>& given);
    void restart_block();
    void begin_block(int block);
    void count(const Trial& trial, const std::vector<GivenAnswer>& given);
    bool needs_pause(bool is_new_block) const;
    void add_feedback();

    const Protocol& protocol_;
    const Schedule& schedule_;
    ProcedureTrials procedures_;
    std::deque<Attempt> waiting_;
    std::deque<SessionStep> before_; ///< what comes before the next trial
    std::optional<Attempt> running_, interrupted_;
    int block_ = -1; ///< of the last trial
    int attempts_since_pause_ = 0;
    std::vector<bool> correct_; ///< of the trials of the block that count so far
    int counted_ = 0;           ///< in the block
    std::vector<int> left_out_;
    bool is_last_over_ = false; ///< and feedback on it was given
};

} // namespace overt
