/// A mesh file in memory, and the words to say where in it something is wrong.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string_view>

namespace overt {

/// The bytes of a regular file, read once, without the mark of UTF-8 that some programs write in front. Not
/// copyable; views of its bytes live as long as it does.
class MeshSource {
  public:
    /// Reads the whole file. Throws InputError if it does not exist, is no regular file, is empty or cannot
    /// be read.
    explicit MeshSource(std::filesystem::path path);

    const std::filesystem::path& path() const { return path_; }
    std::string_view bytes() const { return {bytes_.get() + mark_, size_ - mark_}; }

    /// Throws InputError "PATH: MESSAGE".
    [[noreturn]] void fail(std::string_view message) const;
    /// Throws InputError "PATH:LINE:COLUMN: MESSAGE"; line and column (in bytes) count from 1.
    [[noreturn]] void fail_at(std::size_t line, std::size_t column, std::string_view message) const;
    /// Throws InputError "PATH: byte OFFSET: MESSAGE" for an offset in bytes(); the file's first byte is byte
    /// 0.
    [[noreturn]] void fail_at_byte(std::size_t offset, std::string_view message) const;

  private:
    std::filesystem::path path_;
    std::unique_ptr<char[]> bytes_;
    std::size_t size_ = 0;
    std::size_t mark_ = 0; ///< bytes of the mark
};

/// The number of type T stored at `bytes` in the given byte order; needs no alignment.
template <class T> T stored_value(const char* bytes, std::endian order) {
    std::array<char, sizeof(T)> copy;
    std::memcpy(copy.data(), bytes, sizeof(T));
    if (order != std::endian::native)
        std::reverse(copy.begin(), copy.end());
    return std::bit_cast<T>(copy);
}

/// Whether nothing but blanks, line ends and zero bytes is left: what some programs append to a file.
bool is_padding(std::string_view bytes);

} // namespace overt
