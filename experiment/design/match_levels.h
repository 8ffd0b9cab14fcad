/// What a match can be set to in a trial, and what of it stands ready.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiment/answers/answering.h"
#include "experiment/protocol/protocol.h"
#include "experiment/trial.h"

namespace overt {

/// Why a match can be set to nothing, with what would help; empty: it can.
struct MatchProblem {
    std::string message, hint;
};

/// The levels of a match where this stimulus stands: all entries of the lists of its columns that are as the
/// stimulus's entries in their other columns, sorted by number; of two columns all combinations. Starts are
/// 0, references left out. None, with the reason in `problem`, where they cannot be told.
MatchLevels match_levels_of(const Protocol& protocol, const TaskAnswer& answer, const Stimulus& stimulus,
                            MatchProblem& problem);

/// The same in a trial, with its place, its slot, and the numbers of the first other stimulus that has some.
/// No axes where the trial has nothing in the slot, or there are no levels.
MatchLevels match_levels(const Protocol& protocol, const TaskAnswer& answer, const Trial& trial);

/// The index of a value, as it was written; nothing: it is none of them.
std::optional<int> level_at(const std::vector<double>& values, double value);

/// Whether an answer of a task is a match.
bool is_match(const TaskAnswer& answer);

/// Puts into the slots of a trial's matches what they begin as: what the trial has there, or else what it
/// shows first, with the entries that the match says (`shows`), at the lowest level.
void fill_matched_slots(const Protocol& protocol, Trial& trial);

/// What has to be loaded for a trial: what it shows, in its order, and behind that all levels of its matches,
/// each in the match's slot. `first_levels`: of each match of the task in turn, where its levels begin.
std::vector<PlacedStimulus> loaded_for(const Protocol& protocol, const Trial& trial,
                                       std::vector<std::size_t>* first_levels = nullptr);

} // namespace overt
