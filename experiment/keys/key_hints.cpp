#include "experiment/keys/key_hints.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/diagnostics.h"

namespace overt {

namespace {

/// The headings of all sections that have a key of this name, but for one.
std::vector<std::string> homes_of(const KeyTable& table, std::string_view key, std::string_view but = {}) {
    std::vector<std::string> homes;
    for (const Section& section : table) {
        const bool has_it = std::any_of(section.keys.begin(), section.keys.end(),
                                        [&](const Key& row) { return row.rule.name == key; });
        if (has_it && section.name != but)
            homes.push_back(section.heading());
    }
    return homes;
}

} // namespace

std::string hint_for_stray_key(const KeyTable& table, std::string_view key) {
    constexpr std::size_t most_homes = 4;
    const std::vector<std::string> homes = homes_of(table, key);
    if (homes.empty() || homes.size() > most_homes)
        return "write it below the heading of its section";
    return fmt::format("write it below the heading {}", fmt::join(homes, " or "));
}

std::string hint_for_unknown_key(const KeyTable& table, std::string_view key, const Section& section) {
    if (!key.empty() && key == table.key_above_sections())
        return fmt::format("\"{}\" stands before the first section", key);
    std::vector<std::string_view> names;
    for (const Key& row : section.keys)
        names.push_back(row.rule.name);
    for (const Section& inner : section.tables)
        names.push_back(inner.name);
    const std::vector<std::string> homes = homes_of(table, key, section.name);
    return homes.empty() || nearest_name(key, names)
               ? suggest_name(key, names)
               : fmt::format("\"{}\" belongs to {}", key, homes.front());
}

} // namespace overt
