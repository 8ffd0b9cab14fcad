/// Eye trackers in words.
#pragma once

#include <string>

#include "experiment/study/results/session_setup.h"

namespace overt {

/// The eye tracker as people know it, with the model in brackets: "EyeLink (EYELINK CL 5.15)". Of gaze that
/// no tracker measured, what it is instead.
std::string tracker_words(const GazeSetup& gaze);

/// "the right eye", or "both eyes, of which the left is analysed".
std::string eyes_words(const GazeSetup& gaze);

} // namespace overt
