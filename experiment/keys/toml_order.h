/// The order in which a TOML table was written.
#pragma once

#include <vector>

#include "experiment/keys/toml_tree.h"

namespace overt {

/// The entries of a table as they stand in the file; parse_toml() has them by their keys.
std::vector<const TomlEntry*> in_order_of_file(const TomlTable& table);

} // namespace overt
