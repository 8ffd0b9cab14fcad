#include "experiment/protocol/toml_tree.h"

#include <algorithm>
#include <optional>

#include <toml++/toml.h>

namespace overt {

namespace {

Place place_of(const toml::source_position& position) {
    return {static_cast<int>(position.line), static_cast<int>(position.column)};
}

TomlTable copy_table(const toml::table& table);

TomlValue copy_value(const toml::node& node) {
    TomlValue value{place_of(node.source().begin), TomlDate{}};
    if (const auto* table = node.as_table()) {
        value.content = copy_table(*table);
    } else if (const auto* list = node.as_array()) {
        TomlList items;
        for (const toml::node& item : *list)
            items.push_back(copy_value(item));
        value.content = std::move(items);
    } else if (const auto* text = node.as_string()) {
        value.content = text->get();
    } else if (const auto* whole = node.as_integer()) {
        value.content = whole->get();
    } else if (const auto* number = node.as_floating_point()) {
        value.content = number->get();
    } else if (const auto* truth = node.as_boolean()) {
        value.content = truth->get();
    }
    return value;
}

TomlTable copy_table(const toml::table& table) {
    TomlTable entries;
    for (auto&& [key, node] : table)
        entries.push_back({std::string(key.str()), place_of(key.source().begin), copy_value(node)});
    return entries;
}

/// First and last byte of a line, the line end excluded.
struct LineSpan {
    std::size_t begin = 0, end = 0;
};

std::optional<LineSpan> find_line(std::string_view text, int line) {
    std::size_t begin = 0;
    for (int passed = 1; passed < line; ++passed) {
        begin = text.find('\n', begin);
        if (begin == std::string_view::npos)
            return std::nullopt;
        ++begin;
    }
    return LineSpan{begin, std::min(text.find('\n', begin), text.size())};
}

/// Turns a line into blanks. False where going on would only raise false alarms: there is no such line, it is
/// a heading (its keys would fall to the section before), or it was blanked already.
bool pass_over(std::string& text, int line) {
    const auto span = find_line(text, line);
    if (!span)
        return false;
    const std::size_t first = text.find_first_not_of(" \t\r", span->begin);
    if (first >= span->end || text[first] == '[')
        return false;
    std::fill(text.begin() + static_cast<std::ptrdiff_t>(span->begin),
              text.begin() + static_cast<std::ptrdiff_t>(span->end), ' ');
    return true;
}

/// toml++ opens with «Error while parsing …: », which the place says already.
std::string without_preamble(std::string_view description) {
    const std::size_t end = description.find(": ");
    return std::string(end == std::string_view::npos ? description : description.substr(end + 2));
}

} // namespace

std::string_view TomlValue::kind() const {
    constexpr std::string_view kinds[] = {"a truth value",  "a whole number", "a number", "a text",
                                          "a date or time", "a list",         "a table"};
    return kinds[content.index()];
}

TomlFile parse_toml(std::string_view text, const std::string& file, Diagnostics& diagnostics) {
    TomlFile result;
    std::string remaining(text);
    int last_line = 0;
    while (true) {
        try {
            result.root = copy_table(toml::parse(std::string_view(remaining), std::string_view(file)));
            return result;
        } catch (const toml::parse_error& error) {
            result.is_whole = false;
            const Place place = place_of(error.source().begin);
            // After a line was passed over, an error before it is a consequence and none of the user's.
            if (place.line <= last_line)
                return result;
            diagnostics.error(file, place, without_preamble(error.description()));
            last_line = place.line;
            if (!pass_over(remaining, place.line))
                return result;
        }
    }
}

} // namespace overt
