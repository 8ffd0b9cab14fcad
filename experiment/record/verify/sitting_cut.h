/// A session as it was before one of its sittings.
#pragma once

#include <filesystem>

namespace overt {

/// Takes out of a session file what this sitting and those after it recorded, so that it can be resumed as it
/// was then. The file must be a copy: its seals are lost. What a restarted block took back is not put back.
/// Maps that were drawn live stay. Throws RecordError.
void forget_sittings_from(const std::filesystem::path& session_file, int sitting);

} // namespace overt
