/// Texts of other programs made safe for UTF-8 files, and for files of plain ASCII.
#pragma once

#include <string>
#include <string_view>

namespace overt {

/// Well-formed UTF-8: no overlong forms, no surrogates, nothing beyond U+10FFFF.
bool is_utf8(std::string_view text);

/// Adds a character, which is none of the surrogates and not beyond U+10FFFF.
void append_utf8(std::string& text, char32_t character);

/// Each byte as the character of its number.
std::string utf8_of_latin1(std::string_view text);

/// Characters beyond ASCII become \uXXXX or \UXXXXXXXX; control characters become blanks. What is not UTF-8
/// becomes \ufffd.
std::string ascii_of(std::string_view text);

} // namespace overt
