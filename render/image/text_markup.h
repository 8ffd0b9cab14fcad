/// The emphasis that texts of a protocol may have.
#pragma once

#include <string>
#include <string_view>

namespace overt {

/// A text with <b>, <i>, <u>, <big> and <small> as Pango's markup. All else stands for itself, so that "a <
/// b" and "R&D" need nothing; &lt;, &gt; and &amp; are the characters they name. Throws InputError for a mark
/// that is not closed, or closed without having been opened.
std::string pango_markup_of(std::string_view text);

/// A text and its title: a first line that begins with "# ".
struct TitledText {
    std::string title, body;
};
TitledText split_title(const std::string& text);

} // namespace overt
