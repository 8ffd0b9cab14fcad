/// What a trial's counted fixations come to.
#pragma once

#include <optional>

#include "experiment/study/results/study_results.h"

namespace overt {

/// A trial with what its counted fixations come to: for models that take trials as they are.
struct TrialSummaryRow {
    const StudyTrial& trial;
    int counted = 0, on_head = 0;
    std::optional<bool> has_head; ///< whether its object has a head
    double counted_s = 0.0, head_s = 0.0;
    std::optional<double> wss_mm2; ///< of its counted fixations, two at least
};

TrialSummaryRow trial_summary(const StudyResults& results, const StudyTrial& trial);

} // namespace overt
