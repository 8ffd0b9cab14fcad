/// The protocols that come with the program, to begin from.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace overt {

struct ShippedProtocol {
    std::string_view name; ///< of its file, without .toml
    std::string_view what; ///< what it is an experiment on, a line
    std::string_view text; ///< the file
    struct Picture {
        std::string_view file;  ///< from the protocol's folder, as the text has it
        std::string_view bytes; ///< PNG
    };
    std::span<const Picture> pictures = {}; ///< that it shows
};

/// In the order in which they are listed.
std::span<const ShippedProtocol> shipped_protocols();

/// Its text as the file of a study of one's own: [protocol] name is `name`, and the commands in its comments
/// are about `file`.
std::string begun_from(const ShippedProtocol& shipped, const std::string& name, const std::string& file);

} // namespace overt
