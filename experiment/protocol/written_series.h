/// `series = { roughness = [0.05, 0.1] }` of an entry, as the entries that it stands for.
#pragma once

#include <string>

#include "experiment/base/diagnostics.h"
#include "experiment/keys/toml_tree.h"

namespace overt {

/// Puts several entries in place of each that has a series, in all lists that stimuli are made of: with the
/// key's value, an id that ends with it, and a column of the key's name. Values keep their places, so that
/// what is found wrong in one is found where it is written. Faults of the series itself go to `diagnostics`.
void write_out_series(TomlFile& toml, const std::string& file, Diagnostics& diagnostics);

} // namespace overt
