/// Lines of text out of a stream of bytes, and numbers in them: what devices that speak in text have in
/// common.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace overt {

/// Cuts a stream of bytes into lines, however it was split on the way. CR, LF and NUL all end a line and
/// empty lines are passed over, so any mixture of them is one end. Allocates only when made.
class LineSplitter {
  public:
    /// What grows beyond `longest` is noise: its beginning is dropped.
    explicit LineSplitter(std::size_t longest) : longest_(longest) { partial_.reserve(longest); }

    /// Calls on_line(std::string_view) for each line that is now complete.
    template <class OnLine> void feed(std::string_view bytes, OnLine&& on_line);

    /// What has come of a line that is not complete yet.
    std::string_view partial() const { return partial_; }

    void forget() { partial_.clear(); }

  private:
    std::size_t longest_;
    std::string partial_;
};

/// A finite decimal number without exponent, and nothing else.
std::optional<double> decimal_number(std::string_view text);

template <class OnLine> void LineSplitter::feed(std::string_view bytes, OnLine&& on_line) {
    constexpr std::string_view line_ends("\r\n\0", 3);
    while (!bytes.empty()) {
        const std::size_t end = bytes.find_first_of(line_ends);
        const std::string_view piece = bytes.substr(0, end);
        if (partial_.size() + piece.size() > longest_)
            partial_.clear();
        if (piece.size() <= longest_)
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
