/// What was answered in the trials of a study's sessions.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "experiment/study/results/answer_rows.h"

namespace overt {

/// Of all trials that give results, in the order of the sessions and their attempts; sessions without answers
/// of
/// [[task.answer]] have none. `same_observer`: labels that stand for another. Throws as SessionRecord does.
std::vector<StudyAnswer> read_answers(std::span<const std::filesystem::path> sessions,
                                      std::span<const std::pair<std::string, std::string>> same_observer);

} // namespace overt
