/// SHA-256 of what a session is made of: protocol, meshes, frames, maps, the program itself.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace overt {

/// 64 lower-case hexadecimal digits.
using ContentHash = std::string;

/// Takes bytes piece by piece. Numbers are hashed in this machine's byte order (little-endian on all
/// supported machines).
class ContentHasher {
  public:
    ContentHasher();
    ~ContentHasher();
    ContentHasher(ContentHasher&&) noexcept;
    ContentHasher& operator=(ContentHasher&&) noexcept;

    ContentHasher& add_bytes(std::span<const std::byte> bytes);

    /// The text with its length, so that ("ab", "c") and ("a", "bc") differ.
    ContentHasher& add(std::string_view text);

    template <class T>
    requires std::is_arithmetic_v<T> ContentHasher& add(T number) {
        return add_bytes(std::as_bytes(std::span(&number, 1)));
    }
    template <class T>
    requires std::is_trivially_copyable_v<T> ContentHasher& add(const std::vector<T>& items) {
        add(items.size());
        return add_bytes(std::as_bytes(std::span(items)));
    }

    /// The hash of all that was added. Ends the hasher: nothing may be added afterwards.
    ContentHash finish();

  private:
    struct State;
    std::unique_ptr<State> state_;
};

ContentHash hash_of_text(std::string_view text);

/// Throws InputError if the file cannot be read.
ContentHash hash_of_file(const std::filesystem::path& file);

} // namespace overt
