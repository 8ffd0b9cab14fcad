/// One value after the other of a PLY file's body, from text or from either byte order. PlyText and PlyBinary
/// have the same members, so that the reader is written once, as a template over them.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "experiment/scene/files/mesh_text.h"
#include "experiment/scene/files/ply_header.h"

namespace overt {

/// A PLY body in text: each element begins a line and ends with a line; it may go on over several, and blank
/// lines are passed over.
class PlyText {
  public:
    PlyText(const MeshSource& source, const PlyHeader& header);

    /// Says which element's rows come next. Throws InputError if the file is too short for all of them
    /// whatever they hold, so that nothing is allocated on the word of a damaged header.
    void begin_element(const PlyElement& element);
    void begin_row(std::uint64_t row);
    /// The next value of the row as a number, finite or not; throws InputError at its place if it is none.
    double coordinate(PlyType type, char axis);
    /// The next value of the row as an integer; throws InputError at its place if it is none.
    std::int64_t integer(PlyType type);
    /// Passes over the next values of the row.
    void skip(PlyType type, std::int64_t count = 1);
    /// Throws InputError if the row holds more values than its element has.
    void end_row();
    /// Throws InputError if the file goes on after its last element.
    void end();

    /// Throws InputError at the value read last.
    [[noreturn]] void fail(std::string_view message) const { text_.fail(message); }
    /// At most this many more values of that type can follow in the file.
    std::uint64_t room_for(PlyType) const { return (text_.remaining_bytes() + 1) / 2; }

  private:
    std::string_view next_word();
    [[noreturn]] void fail_lacking(TextPlace place) const;

    MeshText text_;
    const PlyElement* element_ = nullptr;
    std::uint64_t row_ = 0;
    bool row_begins_ = true;
    std::optional<TextPlace> broken_at_; ///< where the row's line ended before the row did
};

/// A PLY body in binary. Members as in PlyText.
class PlyBinary {
  public:
    PlyBinary(const MeshSource& source, const PlyHeader& header);

    void begin_element(const PlyElement& element);
    void begin_row(std::uint64_t row) { row_ = row; }
    double coordinate(PlyType type, char axis);
    std::int64_t integer(PlyType type);
    void skip(PlyType type, std::int64_t count = 1);
    void end_row() {}
    void end();

    [[noreturn]] void fail(std::string_view message) const;
    std::uint64_t room_for(PlyType type) const { return remaining() / size_of(type); }

  private:
    std::uint64_t remaining() const { return static_cast<std::uint64_t>(end_ - at_); }
    const char* take(std::uint64_t size);

    const MeshSource& source_;
    const char* at_;
    const char* end_;
    const char* last_; ///< where the value read last began
    std::endian order_;
    const PlyElement* element_ = nullptr;
    std::uint64_t row_ = 0;
};

} // namespace overt
