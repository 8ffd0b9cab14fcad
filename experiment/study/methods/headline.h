/// What the report says first.
#pragma once

#include "experiment/study/results/study_options.h"
#include "experiment/study/results/study_results.h"

namespace overt {

/// What was asked, what differed, who was left out, and the main result with its interval: of answers the
/// first one's threshold, scale, ratings or share, and of studies without answers the share of fixations on
/// the area of figure 4. Empty sentences where there is nothing to say.
StudyHeadline study_headline(const StudyResults& results, const StudyOptions& options);

} // namespace overt
