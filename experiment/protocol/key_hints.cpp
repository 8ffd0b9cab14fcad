#include "experiment/protocol/key_hints.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/diagnostics.h"
#include "experiment/protocol/protocol_keys.h"

namespace overt {

namespace {

/// The headings of all sections that have a key of this name, but for one.
std::vector<std::string> homes_of(std::string_view key, std::string_view but = {}) {
    std::vector<std::string> homes;
    for_each_section([&](const auto& section) {
        const bool has_it = std::any_of(section.keys.begin(), section.keys.end(),
                                        [&](const auto& row) { return row.rule.name == key; });
        if (has_it && section.name != but)
            homes.push_back(fmt::format(fmt::runtime(section.many ? "[[{}]]" : "[{}]"), section.name));
    });
    return homes;
}

} // namespace

std::string hint_for_stray_key(std::string_view key) {
    constexpr std::size_t most_homes = 4;
    const std::vector<std::string> homes = homes_of(key);
    if (homes.empty() || homes.size() > most_homes)
        return "write it below the heading of its section";
    return fmt::format("write it below the heading {}", fmt::join(homes, " or "));
}

std::string hint_for_unknown_key(std::string_view key, std::string_view section,
                                 std::span<const std::string_view> names) {
    if (key == "include")
        return "\"include\" stands before the first section";
    const std::vector<std::string> homes = homes_of(key, section);
    return homes.empty() || nearest_name(key, names)
               ? suggest_name(key, names)
               : fmt::format("\"{}\" belongs to {}", key, homes.front());
}

} // namespace overt
