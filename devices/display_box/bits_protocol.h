/// The text that a Display++ or Bits# is spoken to with. A command is "$Name" or "$Name=[argument]" and a
/// carriage return; a reply is "#Name;field;field;…" and some mixture of LF, CR and NUL. Known from what
/// PsychoPy, Psychtoolbox and the vendor's example scripts send and expect; the vendor publishes no
/// description.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace overt {

/// "$Name" CR, or "$Name=[argument]" CR.
std::string bits_command(std::string_view name, std::string_view argument = {});

/// Longer than any line that a box says: a video line of 3840 pixels has 46 kB.
inline constexpr std::size_t longest_bits_line = std::size_t{1} << 16;

/// What follows "#Name;" in a line, if it is such a reply. Where noise or a cut line is glued on before it,
/// the last "#Name;" counts.
std::optional<std::string_view> bits_reply(std::string_view line, std::string_view name);

/// The fields between semicolons, blanks around them removed. A semicolon at the end makes no empty field.
std::vector<std::string_view> bits_fields(std::string_view text);

/// The bytes of a pixel as the box received them.
using RgbBytes = std::array<std::uint8_t, 3>;

/// A video line as the box reports it, or why the report cannot be one.
struct VideoLine {
    std::vector<RgbBytes> pixels;
    std::string fault; ///< empty if all is well
};

/// Reads what follows "#GetVideoLine;": three integers 0-255 a pixel, for exactly `pixels` pixels.
VideoLine parse_video_line(std::string_view text, int pixels);

} // namespace overt
