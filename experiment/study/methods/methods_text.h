/// A study's methods in whole sentences, for an article.
#pragma once

#include <vector>

#include "experiment/study/results/study_options.h"
#include "experiment/study/results/study_results.h"

namespace overt {

/// A paragraph for each topic that there is something to say of. Each number in it is one of the results or
/// of the options, as study.json has them; what no session knows is said to be unknown, where gaze is of
/// people. Everything but `reporting` and `methods` of the results must be there.
std::vector<MethodsParagraph> methods_text(const StudyResults& results, const StudyOptions& options);

} // namespace overt
