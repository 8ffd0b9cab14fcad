#include "experiment/base/diagnostics.h"

#include <algorithm>
#include <cstdint>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "experiment/base/counted.h"

namespace overt {

namespace {

/// Length in bytes of the character that starts at `begin`; 1 for a byte that starts none.
std::size_t character_length(std::string_view text, std::size_t begin) {
    const auto lead = static_cast<unsigned char>(text[begin]);
    const std::size_t length = lead < 0xC2 ? 1 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : lead < 0xF5 ? 4 : 1;
    if (begin + length > text.size())
        return 1;
    for (std::size_t i = 1; i < length; ++i) {
        if ((static_cast<unsigned char>(text[begin + i]) & 0xC0) != 0x80)
            return 1;
    }
    return length;
}

std::uint32_t code_point(std::string_view character) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(character[i]); };
    switch (character.size()) {
    case 2:
        return (byte(0) & 0x1Fu) << 6 | (byte(1) & 0x3Fu);
    case 3:
        return (byte(0) & 0x0Fu) << 12 | (byte(1) & 0x3Fu) << 6 | (byte(2) & 0x3Fu);
    case 4:
        return (byte(0) & 0x07u) << 18 | (byte(1) & 0x3Fu) << 12 | (byte(2) & 0x3Fu) << 6 | (byte(3) & 0x3Fu);
    default:
        return byte(0);
    }
}

/// Columns of a terminal that a character takes: none for combining marks, two for the wide scripts of East
/// Asia (the blocks of Unicode's EastAsianWidth.txt that are wide throughout).
int terminal_width(std::uint32_t code) {
    if ((code >= 0x0300 && code <= 0x036F) || code == 0x200B || (code >= 0xFE00 && code <= 0xFE0F))
        return 0;
    const bool wide = (code >= 0x1100 && code <= 0x115F) || (code >= 0x2E80 && code <= 0xA4CF) ||
                      (code >= 0xAC00 && code <= 0xD7A3) || (code >= 0xF900 && code <= 0xFAFF) ||
                      (code >= 0xFF00 && code <= 0xFF60) || (code >= 0x1F300 && code <= 0x1FAFF) ||
                      (code >= 0x20000 && code <= 0x3FFFD);
    return wide ? 2 : 1;
}

/// The line as it may be sent to a terminal: control characters and stray bytes become '?', tabs stay.
std::string printable(std::string_view line) {
    std::string text;
    for (std::size_t i = 0; i < line.size();) {
        const std::size_t length = character_length(line, i);
        const auto lead = static_cast<unsigned char>(line[i]);
        const bool stray = length == 1 && (lead >= 0x80 || (lead < 0x20 && lead != '\t') || lead == 0x7F);
        if (lead == '\n')
            text += ' '; // of a message that a library gave in several lines
        else
            text += stray ? std::string("?") : std::string(line.substr(i, length));
        i += length;
    }
    return text;
}

/// White space that reaches to the character `column`, with tabs where the line has tabs.
std::string indent_to(std::string_view line, int column) {
    std::string indent;
    std::size_t i = 0;
    for (int passed = 1; passed < column; ++passed) {
        if (i >= line.size()) {
            indent += ' ';
            break;
        }
        const std::size_t length = character_length(line, i);
        if (line[i] == '\t')
            indent += '\t';
        else
            indent.append(static_cast<std::size_t>(terminal_width(code_point(line.substr(i, length)))), ' ');
        i += length;
    }
    return indent;
}

std::string_view name_of(Severity severity) {
    switch (severity) {
    case Severity::error:
        return "error";
    case Severity::warning:
        return "warning";
    case Severity::note:
        break;
    }
    return "note";
}

std::string lower_case(std::string_view text) {
    std::string lower(text);
    for (char& letter : lower) {
        if (letter >= 'A' && letter <= 'Z')
            letter = static_cast<char>(letter - 'A' + 'a');
    }
    return lower;
}

/// Letters inserted, left out, replaced, or swapped with their neighbour to make b of a (the optimal string
/// alignment form of Damerau's distance).
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::vector<std::size_t>> distance(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i) {
        for (std::size_t j = 0; j <= b.size(); ++j) {
            if (i == 0 || j == 0) {
                distance[i][j] = i + j;
                continue;
            }
            std::size_t least = std::min(distance[i - 1][j], distance[i][j - 1]) + 1;
            least = std::min(least, distance[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0u : 1u));
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                least = std::min(least, distance[i - 2][j - 2] + 1);
            distance[i][j] = least;
        }
    }
    return distance[a.size()][b.size()];
}

} // namespace

void Diagnostics::quote_from(const std::string& file, std::string_view text) {
    std::vector<std::string>& lines = lines_of_[file];
    lines.clear();
    while (true) {
        const std::size_t end = text.find('\n');
        std::string_view line = text.substr(0, end);
        if (line.ends_with('\r'))
            line.remove_suffix(1);
        lines.emplace_back(line);
        if (end == std::string_view::npos)
            break;
        text.remove_prefix(end + 1);
    }
}

int Diagnostics::number_of_file(const std::string& file) {
    const auto known = std::find(files_.begin(), files_.end(), file);
    if (known != files_.end())
        return static_cast<int>(known - files_.begin()) + 1;
    files_.push_back(file);
    return static_cast<int>(files_.size());
}

void Diagnostics::add(Severity severity, std::string file, Place place, std::string message,
                      std::string hint) {
    if (place.file > 0 && place.file <= static_cast<int>(files_.size()))
        file = files_[static_cast<std::size_t>(place.file) - 1];
    // What a file says once may be read several times, as an entry that stands for a series.
    const bool is_known = std::ranges::any_of(findings_, [&](const Finding& known) {
        return known.severity == severity && known.file == file && known.place.line == place.line &&
               known.place.column == place.column && known.message == message;
    });
    if (is_known)
        return;
    findings_.push_back(
        {severity, std::move(file), {place.line, place.column}, std::move(message), std::move(hint)});
}

void Diagnostics::error(std::string file, Place place, std::string message, std::string hint) {
    add(Severity::error, std::move(file), place, std::move(message), std::move(hint));
}

void Diagnostics::warning(std::string file, Place place, std::string message, std::string hint) {
    add(Severity::warning, std::move(file), place, std::move(message), std::move(hint));
}

void Diagnostics::note(std::string file, Place place, std::string message, std::string hint) {
    add(Severity::note, std::move(file), place, std::move(message), std::move(hint));
}

void Diagnostics::take(const Diagnostics& other) {
    findings_.insert(findings_.end(), other.findings_.begin(), other.findings_.end());
    lines_of_.insert(other.lines_of_.begin(), other.lines_of_.end());
}

std::vector<Finding> Diagnostics::findings() const {
    std::vector<Finding> sorted = findings_;
    std::stable_sort(sorted.begin(), sorted.end(), [](const Finding& a, const Finding& b) {
        return std::tie(a.file, a.place) < std::tie(b.file, b.place);
    });
    return sorted;
}

int Diagnostics::count_of(Severity severity) const {
    return static_cast<int>(std::ranges::count(findings_, severity, &Finding::severity));
}

int Diagnostics::error_count() const { return count_of(Severity::error); }
int Diagnostics::warning_count() const { return count_of(Severity::warning); }

std::string Diagnostics::quoted_line(const Finding& finding) const {
    const auto known = lines_of_.find(finding.file);
    const auto index = static_cast<std::size_t>(finding.place.line) - 1;
    if (finding.place.line < 1 || known == lines_of_.end() || index >= known->second.size())
        return {};
    // A line beyond any terminal's width would bury the message.
    constexpr std::size_t longest_quoted = 400;
    const std::string& line = known->second[index];
    if (line.size() > longest_quoted)
        return {};
    return fmt::format("{:5} | {}\n      | {}^\n", finding.place.line, printable(line),
                       indent_to(line, finding.place.column));
}

std::string Diagnostics::print() const {
    std::string text;
    for (const Finding& finding : findings()) {
        std::string place = finding.file;
        if (finding.place.line > 0)
            place += fmt::format(":{}:{}", finding.place.line, finding.place.column);
        text += fmt::format("{}: {}: {}\n", place, name_of(finding.severity), printable(finding.message));
        text += quoted_line(finding);
        if (!finding.hint.empty())
            text += fmt::format("      = {}\n", printable(finding.hint));
    }
    if (error_count() + warning_count() > 0)
        text += fmt::format("{}, {}\n", counted(error_count(), "error"), counted(warning_count(), "warning"));
    return text;
}

nlohmann::ordered_json Diagnostics::to_json() const {
    nlohmann::ordered_json json{{"errors", error_count()},
                                {"warnings", warning_count()},
                                {"findings", nlohmann::ordered_json::array()}};
    for (const Finding& finding : findings()) {
        json["findings"].push_back({{"severity", name_of(finding.severity)},
                                    {"file", printable(finding.file)},
                                    {"line", finding.place.line},
                                    {"column", finding.place.column},
                                    {"message", printable(finding.message)},
                                    {"hint", printable(finding.hint)}});
    }
    return json;
}

std::optional<std::string_view> nearest_name(std::string_view word, std::span<const std::string_view> known) {
    // Longer words are no slips of the finger, and the distance takes length squared.
    constexpr std::size_t longest_compared = 64;
    if (word.empty() || word.size() > longest_compared)
        return std::nullopt;
    const std::string wanted = lower_case(word);
    std::optional<std::string_view> nearest;
    std::size_t least = std::max<std::size_t>(1, word.size() / 3) + 1;
    for (const std::string_view name : known) {
        const bool lacks_unit = name.size() > word.size() && name.starts_with(wanted + "_");
        const std::size_t distance = lacks_unit ? 1 : edit_distance(wanted, lower_case(name));
        if (distance < least && distance < name.size()) {
            least = distance;
            nearest = name;
        }
    }
    return nearest;
}

std::string suggest_name(std::string_view word, std::span<const std::string_view> known) {
    if (known.empty())
        return {};
    if (const auto nearest = nearest_name(word, known))
        return fmt::format("did you mean \"{}\"?", *nearest);
    return fmt::format("known: {}", fmt::join(known, ", "));
}

} // namespace overt
