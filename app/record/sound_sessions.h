/// Whether what is read of sessions is what was recorded, said before numbers are made of it.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace overt {

/// A sentence for each session whose seals are broken, with the first thing that is not as it was sealed.
/// Reads all rows of all sessions, several at a time. An Interruption ends it as an Error.
std::vector<std::string> sessions_with_broken_seals(std::span<const std::filesystem::path> sessions);

/// The same, on standard error.
std::vector<std::string> say_broken_seals(std::span<const std::filesystem::path> sessions);

} // namespace overt
