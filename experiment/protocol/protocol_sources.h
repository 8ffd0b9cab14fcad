/// A protocol of several files: one that includes others is read as one tree, in which each value knows its
/// file.
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

/// A file that a protocol includes, directly or not.
struct IncludedText {
    std::string name;           ///< its path as seen from the protocol's folder
    std::filesystem::path file; ///< with the protocol's folder
    std::string text;           ///< byte for byte
    int number = 0;             ///< Place::file of what stands in it
};

/// Gives the text of an included file, or nothing with the reason in `why_not`.
using IncludeReader =
    std::function<std::optional<std::string>(const std::filesystem::path& file, std::string& why_not)>;

struct JoinedToml {
    TomlFile toml; ///< without the `include`s
    std::vector<IncludedText> included;
};

/// Reads a text and what it includes: `include = "FILE"`, or a list of files, before the first section; paths
/// count from the folder of the file that names them. Of a [section] in several files the keys are put
/// together, and the including file's hold; two files that are included side by side may not set the same
/// key. Of a [[list]] the entries are put together, those of included files first. A file that is included
/// twice counts once; one that includes itself, over whatever way, is refused. Findings name the file that
/// they are in.
JoinedToml read_joined_toml(std::string_view text, const std::filesystem::path& file,
                            const IncludeReader& reader, Diagnostics& diagnostics);

} // namespace overt
