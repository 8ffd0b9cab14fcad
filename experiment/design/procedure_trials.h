/// The stimuli of trials whose level is chosen when they come, from the answers so far.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiment/ports/given_answer.h"
#include "experiment/procedures/interleaved_tracks.h"
#include "experiment/protocol/protocol.h"
#include "experiment/trial.h"

namespace overt {

/// What was chosen for a trial, and where its track stands.
struct ProcedureChoice {
    std::string procedure;        ///< id
    std::string factor;           ///< in which the level is
    double level = 0.0;           ///< of the factor
    int condition = 0;            ///< which of those that the task's trials make, from 0
    TrackState before = {};       ///< of the track, in levels as the procedure reckons with them
    std::string in_words() const; ///< for the record
};

/// All procedures of a session. What is chosen follows from the protocol, the schedule and the answers that
/// were told, in their order: nothing else is kept.
class ProcedureTrials {
  public:
    /// Both must outlive it. The levels that there are in a condition are those of the schedule's trials.
    ProcedureTrials(const Protocol& protocol, const Schedule& schedule);
    ~ProcedureTrials();

    /// Puts the stimulus that comes next into a trial of a task with procedures; nothing for other trials,
    /// and where all tracks of the condition have ended: the trial is then shown as it is.
    std::optional<ProcedureChoice> decide(Trial& trial) const;

    /// What was answered in a trial that decide() gave, and that counts.
    void tell(const Trial& trial, std::span<const GivenAnswer> given);

    /// All tracks of a trial's condition have ended.
    bool has_ended(const Trial& trial) const;
    /// Two trials of which the same tracks choose.
    bool is_same_condition(const Trial& one, const Trial& other) const;

    /// A block begins anew: what was answered in it no longer counts.
    void restart(int block);

  private:
    struct Condition;
    Condition* condition_of(const Trial& trial) const;
    void make_tracks(Condition& condition) const;

    const Protocol& protocol_;
    const Schedule& schedule_;
    std::vector<std::unique_ptr<Condition>> conditions_;
};

/// Lines on the procedures of a task for a person: how each chooses, how long, and what it counts as "yes".
/// Empty where the task has none.
std::string describe_procedures(const Protocol& protocol, const Task& task);

/// Which of a trial's stimuli the procedure chooses: an index into all_shown().
std::size_t chosen_place(const Protocol& protocol, const Trial& trial);

/// What an answer says to a procedure, in a trial that shows the level it chose in the slot `test`.
TrackAnswer track_answer(const ProcedureSettings& settings, bool has_standard, const std::string& test,
                         std::span<const GivenAnswer> given);

} // namespace overt
