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

/// Cuts a stream of bytes into lines, however it was split on the way. CR, LF and NUL all end a line and
/// empty lines are passed over, so any mixture of them is one end. Allocates only when made.
class BitsLineSplitter {
  public:
    /// Longer than any reply: a video line of 3840 pixels has 46 kB. What grows beyond is noise and dropped.
    static constexpr std::size_t longest_line = std::size_t{1} << 16;

    BitsLineSplitter() { partial_.reserve(longest_line); }

    /// Calls on_line(std::string_view) for each line that is now complete.
    template <class OnLine> void feed(std::string_view bytes, OnLine&& on_line);

    /// What has come of a line that is not complete yet.
    std::string_view partial() const { return partial_; }

    void forget() { partial_.clear(); }

  private:
    std::string partial_;
};

/// What follows "#Name;" in a line, if it is such a reply. Where noise or a cut line is glued on before it,
/// the last "#Name;" counts.
std::optional<std::string_view> bits_reply(std::string_view line, std::string_view name);

/// The fields between semicolons, blanks around them removed. A semicolon at the end makes no empty field.
std::vector<std::string_view> bits_fields(std::string_view text);

/// A finite decimal number and nothing else.
std::optional<double> decimal_number(std::string_view text);

/// The bytes of a pixel as the box received them.
using RgbBytes = std::array<std::uint8_t, 3>;

/// A video line as the box reports it, or why the report cannot be one.
struct VideoLine {
    std::vector<RgbBytes> pixels;
    std::string fault; ///< empty if all is well
};

/// Reads what follows "#GetVideoLine;": three integers 0-255 a pixel, for exactly `pixels` pixels.
VideoLine parse_video_line(std::string_view text, int pixels);

template <class OnLine> void BitsLineSplitter::feed(std::string_view bytes, OnLine&& on_line) {
    constexpr std::string_view line_ends("\r\n\0", 3);
    while (!bytes.empty()) {
        const std::size_t end = bytes.find_first_of(line_ends);
        const std::string_view piece = bytes.substr(0, end);
        if (partial_.size() + piece.size() > longest_line)
            partial_.clear();
        if (piece.size() <= longest_line)
            partial_.append(piece);
        if (end == std::string_view::npos)
            return;
        if (!partial_.empty())
            on_line(std::string_view(partial_));
        partial_.clear();
        bytes.remove_prefix(end + 1);
    }
}

} // namespace overt
