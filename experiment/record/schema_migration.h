/// Sessions of earlier programs, made ready to go on with.
#pragma once

#include <filesystem>
#include <optional>

namespace overt {

/// Whether the file as it was stays, as "session.version-N.sqlite".
enum class KeptCopy { beside_it, none };

/// Brings a session file of an earlier version to session_schema_version, in place and in one transaction; a
/// program that is killed meanwhile leaves it as it was. Gives the path of the copy that is kept; nothing if
/// none is, or if there was nothing to do. To read a session no migration is needed.
///
/// The caller holds the session's lock, and nobody else has the file open. Throws RecordError, also for a
/// file of a newer version.
std::optional<std::filesystem::path> migrate_session_file(const std::filesystem::path& file,
                                                          KeptCopy kept = KeptCopy::beside_it);

} // namespace overt
