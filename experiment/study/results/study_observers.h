/// Who counts in N, and why somebody does not.
#pragma once

#include <string>
#include <vector>

#include "experiment/study/results/study_results.h"

namespace overt {

/// Of the sessions' observers, in the order of the sessions. Takes sessions, trials and fixations.
std::vector<StudyObserver> study_observers(const StudyResults& results);

/// Whole sentences: who does not count and why, and whose labels are so alike that they are probably one
/// person's, with what to do about it.
std::vector<std::string> remarks_on_observers(const std::vector<StudyObserver>& observers);

} // namespace overt
