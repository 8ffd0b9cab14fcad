/// Words and numbers of a text mesh file, with the line and column of each.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "experiment/scene/files/mesh_source.h"
#include "experiment/scene/making/raw_mesh.h"

namespace overt {

/// Line and column (in bytes), both from 1.
struct TextPlace {
    std::size_t line = 1;
    std::size_t column = 1;
};

/// Whether a backslash at the end of a line joins it with the next (OBJ does, PLY and STL do not).
enum class LineJoining : std::uint8_t { none, backslash };

/// Goes through a text word by word. Lines end in LF or CR LF. The source must outlive it.
class MeshText {
  public:
    /// Starts at a byte of the source, which is the first of the given line.
    explicit MeshText(const MeshSource& source, std::size_t from_byte = 0, std::size_t line = 1,
                      LineJoining joining = LineJoining::none);

    /// The next word of this line; empty at its end.
    std::string_view next_in_line();
    /// The next word, on this line or a later one; empty at the end of the file.
    std::string_view next();
    /// All that is left of this line, without the line end; a single blank in front is left out.
    std::string_view rest_of_line();
    /// Goes to the beginning of the next line; false at the end of the file.
    bool to_next_line();

    /// Byte offset of what comes next.
    std::size_t offset() const;
    std::size_t remaining_bytes() const { return static_cast<std::size_t>(end_ - at_); }
    /// Line of what comes next.
    std::size_t line() const { return line_; }
    /// Where the last word began, or where one was missing.
    TextPlace place() const { return place_; }
    const MeshSource& source() const { return source_; }
    /// Throws InputError at place().
    [[noreturn]] void fail(std::string_view message) const;

    /// Takes the next word of this line as a number; throws InputError at its place if it is missing or none.
    /// `owner` says whose coordinate it is ("vertex 7"), and is called only for the message.
    template <class Owner> double number(char axis, const Owner& owner) {
        last_ = next_in_line();
        const std::optional<double> value = number_in(last_);
        if (!value)
            refuse_coordinate(axis, owner());
        return *value;
    }
    /// The same; throws InputError also if it can be no coordinate (is_coordinate).
    template <class Owner> double coordinate(char axis, const Owner& owner) {
        const double value = number(axis, owner);
        if (!is_coordinate(value))
            refuse_coordinate(axis, owner());
        return value;
    }
    /// Throws InputError at the number taken last, saying what is wrong with it as a coordinate.
    [[noreturn]] void refuse_coordinate(char axis, std::string_view owner) const;

    /// The whole word as a number; nullopt if it is none. Too large a number becomes infinite, too small a
    /// one zero. "nan", "inf" and what Microsoft's library writes for them ("-1.#IND") are numbers.
    static std::optional<double> number_in(std::string_view word);
    /// The whole word as an integer; nullopt if it is none or does not fit.
    static std::optional<std::int64_t> integer_in(std::string_view word);

    /// The word for a message: in quotes, cut when long, with a ? for each byte that does not print.
    static std::string quoted(std::string_view word);

    /// A sentence for who looks at what a mesh makes the program read.
    static std::string files_beside(std::span<const std::string> files);

  private:
    std::size_t joint_length() const;
    void skip_blanks();
    void begin_line();

    const MeshSource& source_;
    const char* at_;
    const char* end_;
    const char* line_begin_;
    std::size_t line_;
    TextPlace place_;
    LineJoining joining_;
    std::string_view last_; ///< taken as a number
};

} // namespace overt
