/// From a protocol file to a Protocol, with everything that is wrong with the file found in one go.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string_view>

#include "experiment/base/diagnostics.h"
#include "experiment/protocol/protocol.h"

namespace overt {

/// Reads and checks a protocol. All findings go to `diagnostics`; the protocol is returned if none of them is
/// an error. Relative paths in it are resolved against the file's folder, and looked up: meshes, probe,
/// frames. `shipped_sculptures` are the names that `shipped = "…"` may have. Throws nothing for bad input.
std::optional<Protocol> read_protocol(const std::filesystem::path& file,
                                      std::span<const std::string_view> shipped_sculptures,
                                      Diagnostics& diagnostics);

/// Texts of included files, by IncludedText::name.
using IncludedTexts = std::map<std::string, std::string>;

/// Whether the files that a protocol names are looked up.
enum class FilesNamed : std::uint8_t { left_alone, looked_up };

/// The same from a text, as a recorded session holds it: `file` says where it was, and is not looked at; what
/// it includes is taken from `included`.
std::optional<Protocol> read_protocol_text(std::string_view text, const std::filesystem::path& file,
                                           std::span<const std::string_view> shipped_sculptures,
                                           Diagnostics& diagnostics, const IncludedTexts& included = {},
                                           FilesNamed files = FilesNamed::left_alone);

} // namespace overt
