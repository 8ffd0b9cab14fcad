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

/// Why a file's text is not to be had.
struct UnreadFile {
    std::string message;
    std::string hint;
};

/// The text of a file that a protocol names, read where it is not among `included` yet. Null with the reason
/// in `why_not`. `protocol` is the protocol's file.
const IncludedText* text_beside(std::vector<IncludedText>& included, const std::filesystem::path& protocol,
                                const std::filesystem::path& file, const IncludeReader& reader,
                                Diagnostics& diagnostics, UnreadFile& why_not);

/// Reads a text and what it includes: `include = "FILE"`, or a list of files, before the first section; paths
/// count from the folder of the file that names them. Of a [section] in several files the keys are put
/// together, and the including file's hold; two files that are included side by side may not set the same
/// key. Of a [[list]] the entries are put together, those of included files first. A file that is included
/// twice counts once; one that includes itself, over whatever way, is refused. Findings name the file that
/// they are in.
JoinedToml read_joined_toml(std::string_view text, const std::filesystem::path& file,
                            const IncludeReader& reader, Diagnostics& diagnostics);

} // namespace overt
