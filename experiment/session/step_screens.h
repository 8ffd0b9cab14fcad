/// What stands on the screen in a step that shows no moving stimulus.
#pragma once

#include <optional>

#include "experiment/design/trial_plan.h"
#include "experiment/ports/beep.h"
#include "experiment/ports/presenter.h"

namespace overt {

/// What a step's words and noise depend on.
struct StepCircumstances {
    const Protocol& protocol;
    const Trial& trial;
    std::uint64_t seed = 0;              ///< of the session
    std::size_t number = 0;              ///< of the step in its plan, from 0
    bool is_answered = false;            ///< an answer was given in time
    std::optional<bool> is_correct = {}; ///< nothing: missed, or nothing is correct
};

/// Of a step with settings that is neither `show`, nor `answer`, nor `drift_check`. In a text, {question},
/// {object} and {material} stand for the trial's. Noise is drawn from a stream of its own by the session's
/// seed, the trial and the step.
Screen screen_of(const PlannedStep& step, const StepCircumstances& of);

/// What is heard when a step of feedback comes up; nothing: it has no tone.
std::optional<Beep> tone_of(const StepSettings& step, const StepCircumstances& of);

/// Where the target of a step `fixation` stands; of other steps the middle of the screen.
ScreenPoint target_of(const StepSettings& step, const ScreenGeometry& screen);

} // namespace overt
