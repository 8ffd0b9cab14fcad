/// The settings of a detector of events in words.
#pragma once

#include <string>

namespace overt {

/// Of a JSON object of settings, as the record has it (EventDetection::parameters): "velocity 30 deg/s,
/// acceleration 8000 deg/s2, …", with the unit that the end of each name says. What is no JSON object is
/// given as it is.
std::string settings_in_words(const std::string& json);

} // namespace overt
