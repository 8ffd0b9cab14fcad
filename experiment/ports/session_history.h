/// What an interrupted session had done, as far as it decides what comes next.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "experiment/base/enum_names.h"
#include "experiment/ports/given_answer.h"

namespace overt {

/// What happens to the trial that a session was interrupted in.
enum class ResumePolicy : std::uint8_t {
    redo,         ///< it is attempted again
    skip,         ///< it is skipped
    restart_block ///< its block begins again with its first trial
};
template <>
inline constexpr auto names_of<ResumePolicy> = enum_names<ResumePolicy>("redo", "skip", "restart-block");

/// What became of an attempt at a trial.
enum class AttemptFate : std::uint8_t {
    counted,
    comes_again_now,
    comes_again_at_end, ///< of its block
    skipped,            ///< it failed and does not come again; the table `given_up` of a session file
    interrupted         ///< the session ended in it
};

/// One thing that was done, in the order in which the record tells it.
struct RecordedStep {
    enum class Kind : std::uint8_t {
        practice, ///< was answered, or skipped
        pause,    ///< had begun
        trial,
        resumed
    };
    Kind kind = Kind::trial;
    int trial = -1;                           ///< of a trial, its index
    AttemptFate fate = AttemptFate::counted;  ///< of a trial
    ResumePolicy policy = ResumePolicy::redo; ///< of being resumed
    std::vector<GivenAnswer> given = {};      ///< of a trial
};

/// Everything that was done before a session is taken up again; empty for a new one.
struct SessionHistory {
    std::vector<RecordedStep> steps;
    int counted_trials = 0;
    bool is_opened = false; ///< consent and the form of the beginning are in the record
    std::vector<std::string> forms =
        {}; ///< parts of the form that are in the record, by when they were asked
};

} // namespace overt
