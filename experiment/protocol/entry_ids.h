/// The names of a protocol's tasks, objects, materials, ….
#pragma once

#include <string>
#include <vector>

namespace overt {

/// The `id` of each entry, in their order; as std::string_view while the entries stay where they are.
template <class Text = std::string, class Entry> std::vector<Text> ids_of(const std::vector<Entry>& entries) {
    std::vector<Text> ids;
    for (const Entry& entry : entries)
        ids.push_back(entry.id);
    return ids;
}

} // namespace overt
