/// Names of files and folders that are not finished: hidden, and with the machine and the process that makes
/// them, so that the next program knows what a killed one left.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace overt {

/// ".partial-HOST-PID-" of this process: what stands in a hidden name between that of what is made and what
/// tells several of one process apart.
std::string hidden_infix();

/// Whether a name is hidden in this way by a process of this machine that does not run any more. Names by
/// other machines are not: their programs cannot be seen from here.
bool is_abandoned_name(std::string_view name);

/// Removes the folders ".NAME.partial-…" that killed programs of this machine left beside `path`, whose name
/// NAME is, with all that is in them. What cannot be removed stays.
void remove_abandoned_folders(const std::filesystem::path& path) noexcept;

} // namespace overt
