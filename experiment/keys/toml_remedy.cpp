#include "experiment/keys/toml_remedy.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

namespace overt {

namespace {

/// Far more than the two that a section and its key take.
constexpr int most_parts = 32;

bool is_key_character(char character) {
    return std::isalnum(static_cast<unsigned char>(character)) || character == '_' || character == '-' ||
           character == '"' || character == '\'';
}

/// Where a line has a key of too many parts: its first character.
std::optional<std::size_t> find_deep_key(std::string_view line) {
    int parts = 1;
    std::size_t begin = 0;
    bool in_word = false, after_point = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const char character = line[i];
        if (is_key_character(character)) {
            if (!in_word && !after_point) {
                begin = i;
                parts = 1;
            }
            in_word = true;
            after_point = false;
        } else if (character == '.' && in_word) {
            in_word = false;
            after_point = true;
            if (++parts > most_parts)
                return begin;
        } else if (character != ' ' && character != '\t') {
            in_word = after_point = false;
        } else if (in_word && line.find_first_not_of(" \t", i) < line.size() &&
                   line[line.find_first_not_of(" \t", i)] != '.') {
            in_word = false; // words of a text
        }
    }
    return std::nullopt;
}

/// UTF-16 and UTF-32 by the mark before all, or by the zeros that they have between plain letters.
std::string_view foreign_encoding(std::string_view text) {
    using namespace std::string_view_literals;
    if (text.starts_with("\xff\xfe\0\0"sv) || text.starts_with("\0\0\xfe\xff"sv))
        return "UTF-32";
    if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"))
        return "UTF-16";
    const std::string_view first = text.substr(0, 4);
    const auto zeros = std::count(first.begin(), first.end(), '\0');
    return first.size() < 4 || zeros < 2 ? "" : zeros == 2 ? "UTF-16" : "UTF-32";
}

bool begins_with_any(std::string_view text, std::initializer_list<std::string_view> beginnings) {
    return std::any_of(beginnings.begin(), beginnings.end(),
                       [&](std::string_view beginning) { return text.starts_with(beginning); });
}

/// What stands behind the first = of a line, without blanks before it.
std::string_view value_of(std::string_view line) {
    const std::size_t equals = line.find('=');
    if (equals == line.npos)
        return {};
    line.remove_prefix(equals + 1);
    return line.substr(std::min(line.find_first_not_of(" \t"), line.size()));
}

std::string remedy_of_value(std::string_view value) {
    if (begins_with_any(value, {"“", "”", "„", "‘", "’", "«", "»", "‚"}))
        return "texts stand between straight quotation marks: \"…\"";
    const std::size_t end = std::min(value.find_first_of(" \t\r#,]}"), value.size());
    if (end == 0)
        return "the value is missing";
    return fmt::format("a text stands between quotation marks: \"{}\"", value.substr(0, end));
}

std::size_t characters_in(std::string_view line) {
    return static_cast<std::size_t>(std::count_if(line.begin(), line.end(), [](char byte) {
        return (static_cast<unsigned char>(byte) & 0xC0) != 0x80;
    }));
}

} // namespace

std::optional<UnreadableText> why_unreadable(std::string_view text) {
    if (const std::string_view encoding = foreign_encoding(text); !encoding.empty())
        return UnreadableText{{1, 1}, fmt::format("the file is in {}", encoding), "save it as UTF-8"};
    for (int line = 1; !text.empty(); ++line) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        if (const auto deep = find_deep_key(text.substr(0, end)))
            return UnreadableText{{line, static_cast<int>(*deep) + 1},
                                  fmt::format("a key of more than {} parts", most_parts),
                                  "no key of a protocol has so many points"};
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return std::nullopt;
}

std::string toml_remedy(std::string_view message, std::string_view line, int column) {
    const auto says = [&](std::string_view part) { return message.find(part) != message.npos; };
    if (line.ends_with('\r'))
        line.remove_suffix(1);
    if (says("invalid utf-8"))
        return "save the file as UTF-8";
    const bool at_end = static_cast<std::size_t>(std::max(0, column)) > characters_in(line);
    if (says("control characters") || says("end-of-file"))
        return at_end && line.find_first_of("\"'") != line.npos
                   ? "the text is not closed: a quotation mark is missing, or three around several lines"
                   : "";
    if (says("determine value type") || says("expected 'nan'") || says("expected 'inf'"))
        return remedy_of_value(value_of(line));
    if (says("expected 'true'") || says("expected 'false'"))
        return "true and false are written in small letters, without quotation marks";
    if (says("expected a comment or whitespace, saw ','"))
        return "numbers have a point, not a comma; lists stand between [ and ]";
    if (says("expected decimal digit, saw '.'"))
        return "write a 0 before the point";
    if (says("leading zero"))
        return "leave the first 0 out";
    if (says("expected '=', saw"))
        return "write the key, =, and its value; words of a key are joined by _";
    if (says("expected ']', saw"))
        return "a section is [name] on a line of its own, an entry of a list [[name]]";
    if (says("cannot redefine existing table"))
        return "join the two: all keys of a section stand below one heading";
    if (says("cannot redefine existing array"))
        return "write the heading of each entry with two brackets, as the first";
    if (says("cannot redefine existing"))
        return "a key is set once in a section: leave one of the two lines out";
    return {};
}

} // namespace overt
