/// What an article on a study of gaze has to report, as far as the sessions know it.
#pragma once

#include <vector>

#include "experiment/study/results/study_options.h"

namespace overt {

/// The aspects that Holmqvist et al. (2022, Behavior Research Methods 55, 364-416, table 7) strongly
/// recommend to report of every study, on which the minimum reporting guideline rests (Dunn et al. 2023), in
/// its order, and beside them calibration and participants. What differs between sessions has all its values;
/// what no session knows is not recorded, and the row says what to add.
std::vector<ReportingItem> reporting_items(const StudyResults& results, const StudyOptions& options);

} // namespace overt
