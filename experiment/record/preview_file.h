/// Where a session keeps a picture of each stimulus.
#pragma once

#include <string>

#include "experiment/record/session_header.h"

namespace overt {

/// Where in a session's folder animation frame 0 of a stimulus lies, as an 8-bit sRGB PNG to look at.
std::string preview_file(const SessionHeader& header, const Condition& condition);

} // namespace overt
