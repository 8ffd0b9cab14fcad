#include "experiment/keys/key_table.h"

#include <algorithm>

#include <fmt/format.h>

#include "experiment/base/error.h"

namespace overt {

namespace {

/// A member of another struct would be written beside the object.
void expect_members_of(const void* its_struct, const Section& section) {
    for (const Key& key : section.keys)
        OVERT_EXPECTS(key.place.left_out_struct() == its_struct);
    for (const Section& table : section.tables) {
        OVERT_EXPECTS(!table.home.has_struct() || table.home.left_out_root() == its_struct);
        expect_members_of(table.home.has_struct() ? table.home.left_out_struct() : its_struct, table);
    }
}

} // namespace

std::string Key::default_text() const {
    if (rule.is_required || !rule.if_left_out.empty() || !type->written)
        return {};
    return type->written(rule, place.in_left_out());
}

std::string Section::heading() const {
    return is_list() && alone.empty() ? list_heading() : fmt::format("[{}]", alone.empty() ? name : alone);
}

std::string Section::list_heading() const { return fmt::format("[[{}]]", name); }

const Key* Section::find_key(std::string_view key) const {
    const auto found = std::ranges::find(keys, key, [](const Key& row) { return row.rule.name; });
    return found == keys.end() ? nullptr : &*found;
}

KeyTable::KeyTable(std::vector<Section> all, std::string_view key_above_sections)
    : sections_(std::move(all)), key_above_(key_above_sections) {
    OVERT_EXPECTS(!sections_.empty());
    for (const Section& section : sections_) {
        OVERT_EXPECTS(section.home.left_out_root() == left_out_root());
        expect_members_of(section.home.left_out_struct(), section);
    }
}

const Section& KeyTable::section(std::string_view name) const {
    const auto found = std::ranges::find(sections_, name, &Section::name);
    OVERT_EXPECTS(found != sections_.end());
    return *found;
}

std::string expected_kind(const Key& key) {
    KeyRule rule = key.rule;
    if (!range_text(rule).empty())
        rule.unit = {};
    return expected_text(rule, key.type->noun);
}

} // namespace overt
