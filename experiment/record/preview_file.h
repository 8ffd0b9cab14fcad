/// A stimulus of a session, and where the session keeps pictures of it.
#pragma once

#include <string>

#include "experiment/record/session_header.h"

namespace overt {

/// Where in a session's folder animation frame 0 of a stimulus lies, as an 8-bit sRGB PNG to look at.
std::string preview_file(const SessionHeader& header, const Stimulus& stimulus);

/// Where it keeps how bright the stimulus is in each pose (light_pictures.h), if it knows.
std::string light_file(const SessionHeader& header, const Stimulus& stimulus);

/// What the header says of it; null in recordings that were made elsewhere, which have no stimuli.
const RecordedStimulus* stimulus_of(const SessionHeader& header, const Stimulus& stimulus);

} // namespace overt
