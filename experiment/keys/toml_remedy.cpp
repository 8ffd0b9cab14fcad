#include "experiment/keys/toml_remedy.h"

#include <algorithm>
#include <cctype>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "experiment/base/utf8_text.h"

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

constexpr std::string_view blanks = " \t\r";
constexpr std::string_view not_closed =
    "the text is not closed: a quotation mark is missing, or three around several lines";

std::string_view without_blanks_before(std::string_view text) {
    return text.substr(std::min(text.find_first_not_of(blanks), text.size()));
}

/// Where a text that begins with a quotation mark ends in its line: behind its last mark, or npos.
std::size_t end_of_text(std::string_view text) {
    for (std::size_t i = 1; i < text.size(); ++i) {
        if (text[i] == '\\' && text[0] == '"')
            ++i;
        else if (text[i] == text[0])
            return i + 1;
    }
    return std::string_view::npos;
}

/// What is still open where a line begins.
struct OpenAbove {
    char marks = 0; ///< the three quotation marks of a text of several lines, or 0
    int lists = 0;  ///< how many lists (and tables in braces) are open
};

void pass(std::string_view line, OpenAbove& open) {
    while (!line.empty()) {
        const char first = line[0];
        const bool are_three = (first == '"' || first == '\'') && line.starts_with(std::string(3, first));
        std::size_t length = 1;
        if (open.marks != 0) {
            if (first == '\\' && open.marks == '"')
                length = 2;
            else if (are_three && first == open.marks) {
                open.marks = 0;
                length = 3;
            }
        } else if (are_three) {
            open.marks = first;
            length = 3;
        } else if (first == '"' || first == '\'') {
            length = end_of_text(line);
        } else if (first == '#') {
            return;
        } else {
            open.lists += (first == '[' || first == '{') - (first == ']' || first == '}');
        }
        line.remove_prefix(std::min(length, line.size()));
    }
}

/// The key of a line, and what stands behind it.
struct KeyAndRest {
    std::string_view key, rest;
};

KeyAndRest split_at_key(std::string_view line) {
    std::size_t end = 0;
    while (end < line.size() && (is_key_character(line[end]) || line[end] == '.'))
        end = line[end] == '"' || line[end] == '\''
                  ? std::min(end_of_text(line.substr(end)), line.size() - end) + end
                  : end + 1;
    return {line.substr(0, end), without_blanks_before(line.substr(end))};
}

/// The lines of a text above a line, the nearest last.
std::vector<std::string_view> lines_above(std::string_view text, int line) {
    std::vector<std::string_view> lines;
    for (int number = 1; number < line && !text.empty(); ++number) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        lines.push_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return lines;
}

/// "name" of "[name]" and "[[name]]"; empty if a line is neither.
std::string_view name_of_heading(std::string_view line) {
    if (!line.starts_with('['))
        return {};
    const bool is_entry = line.starts_with("[[");
    const auto [name, rest] = split_at_key(without_blanks_before(line.substr(is_entry ? 2 : 1)));
    const bool is_closed = rest.starts_with(is_entry ? "]]" : "]");
    const std::string_view behind =
        is_closed ? without_blanks_before(rest.substr(is_entry ? 2 : 1)) : std::string_view();
    return is_closed && (behind.empty() || behind[0] == '#') ? name : std::string_view();
}

std::string remedy_of_heading(std::string_view heading, std::span<const std::string_view> above) {
    const std::string_view name = name_of_heading(heading);
    if (name.empty())
        return "a section is [name] on a line of its own, an entry of a list [[name]]";
    for (const std::string_view line : above) {
        const std::string_view earlier = without_blanks_before(line);
        if (name_of_heading(earlier) != name)
            continue;
        return earlier.starts_with("[[") && !heading.starts_with("[[")
                   ? "write the heading of each entry with two brackets, as the first"
                   : "join the two: all keys of a section stand below one heading";
    }
    return {};
}

/// Whether a key was set before in the same section.
bool is_set_above(std::string_view key, std::span<const std::string_view> above) {
    for (std::size_t i = above.size(); i-- > 0;) {
        const std::string_view line = without_blanks_before(above[i]);
        if (!name_of_heading(line).empty())
            return false;
        const auto [earlier, rest] = split_at_key(line);
        if (!key.empty() && earlier == key && rest.starts_with('='))
            return true;
    }
    return false;
}

bool is_written_as(std::string_view word, std::string_view lower) {
    return std::equal(word.begin(), word.end(), lower.begin(), lower.end(), [](char one, char other) {
        return std::tolower(static_cast<unsigned char>(one)) == other;
    });
}

/// Of a value that stands alone, or in a list.
std::string remedy_of_value(std::string_view value, bool is_in_list) {
    if (begins_with_any(value, {"“", "”", "„", "‘", "’", "«", "»", "‚"}))
        return "texts stand between straight quotation marks: \"…\"";
    if (begins_with_any(value, {"\"", "'"}))
        return std::string(end_of_text(value) == std::string_view::npos ? not_closed : "");
    const std::size_t end = std::min(value.find_first_of(" \t\r#,]}"), value.size());
    if (end == 0)
        return "the value is missing";
    if (begins_with_any(value, {"[", "{"}))
        return {}; // a list or a table as a whole
    const std::string_view word = value.substr(0, end);
    const std::string_view digits = word.substr(word[0] == '-' || word[0] == '+' ? 1 : 0);
    if (digits.starts_with('.'))
        return "write a 0 before the point";
    if (!digits.empty() && std::isdigit(static_cast<unsigned char>(digits[0]))) {
        if (!is_in_list && value.substr(end).starts_with(','))
            return "numbers have a point, not a comma; lists stand between [ and ]";
        return digits.size() > 1 && digits[0] == '0' && std::isdigit(static_cast<unsigned char>(digits[1]))
                   ? "leave the first 0 out"
                   : "";
    }
    for (const std::string_view truth : {"true", "false"}) {
        if (word != truth && is_written_as(word, truth))
            return "true and false are written in small letters, without quotation marks";
    }
    for (const std::string_view sound : {"true", "false", "inf", "nan"}) {
        if (digits == sound)
            return {};
    }
    return fmt::format("a text stands between quotation marks: \"{}\"", word);
}

/// The item of a list, or table in braces, that stands at a place of it, counted in bytes.
std::string_view item_at(std::string_view list, std::size_t place) {
    std::size_t begin = 0;
    for (std::size_t i = 0; i < std::min(place, list.size());) {
        const bool is_mark = list[i] == '"' || list[i] == '\'';
        if (std::string_view("[,{=").find(list[i]) != std::string_view::npos)
            begin = i + 1;
        i += is_mark ? std::min(end_of_text(list.substr(i)), list.size()) : 1;
    }
    return without_blanks_before(list.substr(begin));
}

/// How many bytes so many characters take.
std::size_t bytes_of(std::string_view line, int characters) {
    std::size_t bytes = 0;
    for (; bytes < line.size(); ++bytes) {
        if ((static_cast<unsigned char>(line[bytes]) & 0xC0) != 0x80 && characters-- <= 0)
            break;
    }
    return bytes;
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

std::string toml_remedy(std::string_view text, Place place) {
    const std::vector<std::string_view> above = lines_above(text, place.line);
    OpenAbove open;
    for (const std::string_view line : above) {
        text.remove_prefix(std::min(line.size() + 1, text.size()));
        pass(line, open);
    }
    std::string_view whole = text.substr(0, text.find('\n'));
    if (whole.ends_with('\r'))
        whole.remove_suffix(1);
    if (!is_utf8(whole))
        return "save the file as UTF-8";
    if (open.marks != 0)
        return std::string(not_closed);
    const std::string_view line = without_blanks_before(whole);
    const std::size_t at = bytes_of(whole, place.column - 1) - (whole.size() - line.size());
    if (open.lists > 0) {
        const bool is_next = !name_of_heading(line).empty() || split_at_key(line).rest.starts_with('=');
        return is_next ? "a list above is not closed: its ] is missing"
                       : remedy_of_value(item_at(line, at), true);
    }
    if (line.starts_with('['))
        return remedy_of_heading(line, above);
    const auto [key, rest] = split_at_key(line);
    if (!rest.starts_with('='))
        return "write the key, =, and its value; words of a key are joined by _";
    const std::string_view value = without_blanks_before(rest.substr(1));
    const bool is_list = begins_with_any(value, {"[", "{"});
    const std::size_t begin = line.size() - value.size();
    std::string remedy = is_list ? remedy_of_value(item_at(value, at > begin ? at - begin : 0), true)
                                 : remedy_of_value(value, false);
    if (remedy.empty() && is_set_above(key, above))
        return "a key is set once in a section: leave one of the two lines out";
    return remedy;
}

} // namespace overt
