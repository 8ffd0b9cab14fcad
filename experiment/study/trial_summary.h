/// What a trial's counted fixations come to.
#pragma once

#include <optional>
#include <vector>

#include "experiment/study/results/study_results.h"

namespace overt {

/// A trial with what its counted fixations come to: for models that take trials as they are.
struct TrialSummaryRow {
    struct OnArea {
        int fixations = 0;
        double seconds = 0.0;
    };
    const StudyTrial& trial;
    int counted = 0;
    double counted_s = 0.0;
    std::vector<std::optional<OnArea>> areas; ///< by StudyResults::areas; nothing: its object has it not
    std::optional<double> wss_mm2;            ///< of its counted fixations, two at least; divided by N - 1
};

TrialSummaryRow trial_summary(const StudyResults& results, const StudyTrial& trial);

} // namespace overt
