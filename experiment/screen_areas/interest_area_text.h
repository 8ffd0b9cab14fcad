/// Interest areas as EyeLink recordings and their files (.ias) have them.
///
/// RECTANGLE id left top right bottom [label], ELLIPSE likewise, FREEHAND id x1,y1 x2,y2 ... [label]. Two
/// whole numbers may stand before it: from when until when, in milliseconds after the message or the trial's
/// onset, which the maker's programs write with a minus sign.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "experiment/screen_areas/screen_area.h"

namespace overt {

/// The area, with its label or else its id as the name; or what is wrong with it, a clause.
using InterestArea = std::variant<ScreenArea, std::string>;

/// Of a line of a file, or of what follows "IAREA" in a message. `after_s`: what the two numbers count from.
InterestArea interest_area(std::string_view text, double after_s = 0.0);

/// What follows "!V IAREA" in a message; nothing of other messages. A whole number may stand before it.
std::optional<std::string_view> interest_area_words(std::string_view message);

/// The file that "FILE name" names; nothing if the text names none.
std::optional<std::string> interest_area_file(std::string_view text);

} // namespace overt
