/// What is told by ear.
#pragma once

#include <cstdint>

namespace overt {

enum class Beep : std::uint8_t {
    // To who sets up an eye tracker.
    target_appears,
    calibration_good,
    calibration_bad,
    drift_good,
    drift_bad,
    // To the observer, by a step of feedback.
    answered, ///< and nobody says whether correctly
    correct,
    wrong,
    missed
};

} // namespace overt
