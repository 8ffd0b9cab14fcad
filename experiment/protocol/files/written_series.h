/// `series = { roughness = [0.05, 0.1] }` of an entry, as the entries that it stands for.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiment/base/diagnostics.h"
#include "experiment/keys/toml_tree.h"

namespace overt {

/// Whether a path stands for all files of a folder whose names fit: `*` in its name is any letters, `?` one.
bool is_pattern(const std::filesystem::path& file);
/// Whether a name fits a pattern's.
bool fits_pattern(std::string_view name, std::string_view pattern);

/// Gives the names of the files that a pattern stands for, in their order, or nothing once it has reported
/// why there are none. `place`: where the pattern is written.
using FilesOfPattern =
    std::function<std::optional<std::vector<std::string>>(const std::string& pattern, Place place)>;

/// Puts several entries in place of each that has a series, in all lists that stimuli are made of: with the
/// key's value, an id that ends with it (or is it, of an entry without an id whose series is of a key by
/// which entries are called, and then has no column), and a column of the key's name. Values keep their places, so that what is found
/// wrong in one is found where it is written. A pattern in place of a list is the list of its files. Faults
/// of the series itself go to `diagnostics`.
void write_out_series(TomlFile& toml, const std::string& file, const FilesOfPattern& files_of,
                      Diagnostics& diagnostics);

/// Gives entries of these lists that have no id the one that they are called by: the value of the first of
/// StimulusList::named_by that they have, else the list's name. The only entry of a list that is never empty
/// stays without. Tasks are "task", or with several "task-1", "task-2", …. To be called once series are
/// written out.
void name_entries(TomlFile& toml);

} // namespace overt
