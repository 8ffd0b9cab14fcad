/// From a characterisation file (TOML, with tables in CSV beside it) to a DisplayCharacterisation. The format
/// is described in docs/characterisation.md.
#pragma once

#include <filesystem>
#include <optional>

#include "experiment/base/diagnostics.h"
#include "experiment/colour/display_characterisation.h"

namespace overt {

/// Reads and checks a characterisation with the tables that it names, which are looked for beside it. All
/// findings go to `diagnostics`, each with its place in the file or table it is about; that there is no such
/// file, at `place` of `named_in`. Nothing if one of them is an error. Throws nothing for bad input.
std::optional<DisplayCharacterisation> read_characterisation(const std::filesystem::path& file,
                                                             const std::string& named_in, Place place,
                                                             Diagnostics& diagnostics);

} // namespace overt
