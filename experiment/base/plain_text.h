/// Texts of a protocol without the marks that they have on the screen.
#pragma once

#include <string>
#include <string_view>

namespace overt {

/// Without <b>, <i>, <u>, <big> and <small> and without the "# " before a title; &lt;, &gt; and &amp; are the
/// characters that they name, as on the screen (render/image/text_markup.h). All else stays, so that "a < b"
/// does too.
std::string plain_text_of(std::string_view marked);

/// The same on one line: each stretch of white space is one blank, and there is none at its ends.
std::string plain_line_of(std::string_view marked);

} // namespace overt
