/// Protocol texts for tests, and what the reader finds in them.
#pragma once

#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "experiment/checks/checked_protocol.h"

namespace overt::test {

inline constexpr std::string_view shipped_names[] = {"muse", "runner", "scholar"};

/// A sound protocol of eleven lines; what a test adds begins in line 12.
inline constexpr std::string_view minimal_protocol = R"([protocol]
name = "minimal"
[[object]]
id = "a"
shipped = "muse"
[[material]]
id = "gold"
kind = "smooth-conductor"
[[task]]
id = "free"
question = "Look."
)";

/// Reads a text as the file p.toml, without looking at other files.
struct ReadText {
    explicit ReadText(std::string_view text)
        : protocol(read_protocol_text(text, "p.toml", shipped_names, diagnostics)) {}
    explicit ReadText(std::string_view text, std::string_view more)
        : ReadText(std::string(text) + std::string(more)) {}

    /// "line:column: message" of each finding.
    std::vector<std::string> lines() const {
        std::vector<std::string> lines;
        for (const Finding& finding : diagnostics.findings())
            lines.push_back(
                fmt::format("{}:{}: {}", finding.place.line, finding.place.column, finding.message));
        return lines;
    }

    Diagnostics diagnostics;
    std::optional<Protocol> protocol;
};

inline std::string text_of_file(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

inline std::filesystem::path source_path(std::string_view path) {
    return std::filesystem::path(OVERT_SOURCE_DIR) / path;
}

inline Protocol paper_protocol() {
    Diagnostics diagnostics;
    auto protocol = read_protocol(source_path("protocols/overt_2019.toml"), shipped_names, diagnostics);
    if (!protocol)
        throw std::runtime_error(diagnostics.print());
    return *std::move(protocol);
}

} // namespace overt::test
