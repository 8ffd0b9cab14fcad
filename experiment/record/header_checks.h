/// Numbers of a session's header that readers count on.
#pragma once

#include <filesystem>

#include "experiment/record/session_header.h"

namespace overt {

/// Throws RecordError naming the file if a number is one that no session can have had, or a label one that no
/// file can be named by: the file is damaged.
void check_header(const SessionHeader& header, const std::filesystem::path& file);

} // namespace overt
