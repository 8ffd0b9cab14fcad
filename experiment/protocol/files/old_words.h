/// Words of protocols of earlier versions, read as those of today.
#pragma once

#include <string>

#include "experiment/base/diagnostics.h"
#include "experiment/keys/toml_tree.h"

namespace overt {

/// The name that a factor has today, such as a column of `--by`.
std::string todays_factor(std::string name);

/// Puts today's words in place of earlier ones throughout a protocol: headings, keys, and the values that are
/// words of overt's own. A note in `diagnostics` says where the first stands and how many there are; a list
/// that is written under both names is an error, since nobody can tell in which order its entries come.
void put_todays_words(TomlFile& toml, const std::string& file, Diagnostics& diagnostics);

/// Takes `library` out of what describes devices, where protocols had it once: who sends a protocol does not
/// say which code this machine runs. A warning stands at each, with what to do instead.
void take_out_libraries(TomlFile& toml, const std::string& file, Diagnostics& diagnostics);

} // namespace overt
