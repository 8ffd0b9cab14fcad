/// What a validation of a calibration found: gaze against targets whose place is known.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "experiment/gaze.h"
#include "experiment/units.h"

namespace overt {

/// One target of a validation, and where the eye was measured to look at it.
struct ValidatedTarget {
    Eye eye = Eye::right;
    ScreenPoint target;
    std::optional<ScreenPoint> gaze; ///< median of the fixation; nothing: no eye, or none that rested
    Degrees error{};                 ///< between the two
    std::optional<Degrees> rms_s2s;  ///< root mean square of the angles between successive samples
    std::optional<Degrees> sd;       ///< standard deviation of the samples about their mean, over both axes
};

/// Accuracy reached by a calibration. Of two eyes, over the targets of both.
struct ValidationResult {
    Degrees mean_error;
    Degrees max_error;
    std::vector<ValidatedTarget> targets = {}; ///< in the order shown; empty: the tracker tells sums only

    /// Makes both errors of the targets at which gaze was measured, and gives their number; without any the
    /// errors are 0.
    int sum_up() {
        int measured = 0;
        double sum = 0.0;
        max_error = {};
        for (const ValidatedTarget& target : targets) {
            if (!target.gaze)
                continue;
            ++measured;
            sum += target.error.value;
            max_error = std::max(max_error, target.error);
        }
        mean_error = {measured > 0 ? sum / measured : 0.0};
        return measured;
    }
};

} // namespace overt
