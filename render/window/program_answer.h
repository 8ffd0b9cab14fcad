/// What another program says.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace overt {

/// Runs a program, found in PATH, without a shell and without input, and gives what it writes to standard
/// output, 64 kB at most. Nothing if there is none, it fails, or takes longer than `limit`; then it is
/// killed. Never throws for these; main thread only.
std::optional<std::string> program_answer(const std::vector<std::string>& arguments,
                                          std::chrono::milliseconds limit = std::chrono::seconds(5));

} // namespace overt
