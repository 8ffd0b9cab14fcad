/// Files that are read whole, and such that are there whole or not at all.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace overt {

/// More than any text of ours: somebody named a mesh or a recording instead.
inline constexpr std::size_t most_text_bytes = std::size_t{64} << 20;

/// All bytes of a file. Nothing if there are none to be had, with errno's word why: ENOENT, EISDIR and the
/// like, or EFBIG if there are more than `most_bytes`.
std::optional<std::string> read_whole_file(const std::filesystem::path& path, std::size_t most_bytes,
                                           int& error);

/// The same; throws InputError that names the file and the reason.
std::string read_whole_file(const std::filesystem::path& path, std::size_t most_bytes = most_text_bytes);

/// Writes the bytes under a hidden name beside `path`, brings them to the disk, and only then gives them
/// their name; what stood there is replaced. From any thread, also for the same path at once. Throws
/// RecordError, leaving nothing new, if the disk refuses a single one of them.
void write_whole_file(const std::filesystem::path& path, std::span<const std::byte> bytes);
/// The same of a text. `remedy` follows the reason in what is thrown.
void write_whole_file(const std::filesystem::path& path, std::string_view text, std::string_view remedy = {});
/// The same for callers with words of their own: gives errno of what went wrong, or 0.
[[nodiscard]] int replace_file(const std::filesystem::path& path, std::span<const std::byte> bytes);

/// Writes a file in its place, from its beginning, and brings it to the disk: errno of what went wrong, or 0.
[[nodiscard]] int write_through(const std::filesystem::path& path, std::span<const std::byte> bytes);

/// Writes a text to what the path names, which may be a pipe or a terminal, too. Throws RecordError.
void write_to(const std::filesystem::path& path, std::string_view text);

/// Removes what write_whole_file() left hidden directly in a folder when its program was killed on this
/// machine. What a program that runs is writing stays, and so does what another machine has begun, whose
/// programs cannot be seen from here. A folder that is not there has nothing in it; what cannot be removed
/// stays. Gives how many files went.
int remove_abandoned_files(const std::filesystem::path& folder);

} // namespace overt
