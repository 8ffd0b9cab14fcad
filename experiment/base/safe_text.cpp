#include "experiment/base/safe_text.h"

#include <charconv>

#include <fmt/format.h>

namespace overt {
namespace {

/// Length of a character of UTF-8 at the beginning that must not reach a terminal, and its number; 0: it may.
struct Control {
    std::size_t length = 0;
    unsigned number = 0;
};

Control control_at_begin(std::string_view rest) {
    const auto byte = [&](std::size_t i) {
        return i < rest.size() ? static_cast<unsigned char>(rest[i]) : 0u;
    };
    const unsigned first = byte(0);
    if ((first < 0x20 && first != '\n' && first != '\t') || first == 0x7f)
        return {1, first};
    if (first == 0xc2 && byte(1) >= 0x80 && byte(1) <= 0x9f) // C1: CSI and its like in one character
        return {2, byte(1)};
    // Embeddings, overrides and isolates of direction: U+202A … U+202E, U+2066 … U+2069.
    if (first == 0xe2 && (byte(1) == 0x80 || byte(1) == 0x81)) {
        const unsigned number = 0x2000 + ((byte(1) & 1u) << 6) + (byte(2) & 0x3fu);
        if ((number >= 0x202a && number <= 0x202e) || (number >= 0x2066 && number <= 0x2069))
            return {3, number};
    }
    return {};
}

bool is_number(std::string_view text) {
    if (text.starts_with('+'))
        text.remove_prefix(1);
    double number = 0.0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
    return read.ptr == text.data() + text.size() && !text.empty() && read.ec != std::errc::invalid_argument;
}

/// As places have them: "-12.5 3.25".
bool is_numbers(std::string_view text) {
    for (;;) {
        const std::size_t end = text.find(' ');
        if (!is_number(text.substr(0, end)))
            return false;
        if (end == text.npos)
            return true;
        text.remove_prefix(end + 1);
    }
}

} // namespace

std::string printable_text(std::string_view text) {
    std::string printable;
    printable.reserve(text.size());
    while (!text.empty()) {
        const Control control = control_at_begin(text);
        if (control.length == 0)
            printable += text.front();
        else
            printable += control.number < 0x100 ? fmt::format("\\x{:02x}", control.number)
                                                : fmt::format("\\u{:04x}", control.number);
        text.remove_prefix(control.length == 0 ? 1 : control.length);
    }
    return printable;
}

std::string without_formula(std::string_view cell) {
    constexpr std::string_view begins = "=+-@\t\r";
    const bool may_be_formula =
        cell.size() > 1 && begins.find(cell.front()) != std::string_view::npos && !is_numbers(cell);
    std::string text(may_be_formula ? "'" : "");
    text += cell;
    return text;
}

std::string csv_cell(std::string_view text) {
    const std::string cell = without_formula(text);
    if (cell.empty() ||
        (cell.find_first_of(",\"\r\n") == std::string::npos && cell.front() != ' ' && cell.back() != ' '))
        return cell;
    std::string quoted = "\"";
    for (const char c : cell) {
        if (c == '"')
            quoted += '"';
        quoted += c;
    }
    return quoted + '"';
}

} // namespace overt
