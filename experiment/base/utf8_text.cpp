#include "experiment/base/utf8_text.h"

#include <cstdint>

#include <fmt/format.h>

namespace overt {
namespace {

/// Takes one character from the front; -1 if the bytes are none, of which one is taken.
std::int32_t next_character(std::string_view& text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned first = byte(0);
    const std::size_t length = first < 0x80 ? 1 : first < 0xc2 ? 0 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
    std::uint32_t character = length == 1 ? first : first & (0xffu >> (length + 1));
    bool is_valid = length > 0 && length <= text.size() && first <= 0xf4;
    for (std::size_t i = 1; is_valid && i < length; ++i) {
        is_valid = (byte(i) & 0xc0u) == 0x80u;
        character = (character << 6) | (byte(i) & 0x3fu);
    }
    is_valid = is_valid && !(length == 3 && character < 0x800) && !(length == 4 && character < 0x10000) &&
               !(character >= 0xd800 && character < 0xe000) && character <= 0x10ffff;
    text.remove_prefix(is_valid ? length : 1);
    return is_valid ? static_cast<std::int32_t>(character) : -1;
}

} // namespace

bool is_utf8(std::string_view text) {
    while (!text.empty())
        if (next_character(text) < 0)
            return false;
    return true;
}

void append_utf8(std::string& text, char32_t character) {
    const auto byte = [&](char32_t value) { text += static_cast<char>(static_cast<unsigned char>(value)); };
    if (character < 0x80) {
        byte(character);
    } else if (character < 0x800) {
        byte(0xC0 | (character >> 6));
        byte(0x80 | (character & 0x3F));
    } else if (character < 0x10000) {
        byte(0xE0 | (character >> 12));
        byte(0x80 | ((character >> 6) & 0x3F));
        byte(0x80 | (character & 0x3F));
    } else {
        byte(0xF0 | (character >> 18));
        byte(0x80 | ((character >> 12) & 0x3F));
        byte(0x80 | ((character >> 6) & 0x3F));
        byte(0x80 | (character & 0x3F));
    }
}

std::string utf8_of_latin1(std::string_view text) {
    std::string utf8;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x80) {
            utf8 += c;
        } else {
            utf8 += static_cast<char>(0xc0u | (byte >> 6));
            utf8 += static_cast<char>(0x80u | (byte & 0x3fu));
        }
    }
    return utf8;
}

std::string ascii_of(std::string_view text) {
    std::string ascii;
    while (!text.empty()) {
        const std::int32_t character = next_character(text);
        if (character < 0)
            ascii += "\\ufffd";
        else if (character < 0x20 || character == 0x7f)
            ascii += ' ';
        else if (character < 0x7f)
            ascii += static_cast<char>(character);
        else if (character < 0x10000)
            ascii += fmt::format("\\u{:04x}", character);
        else
            ascii += fmt::format("\\U{:08x}", character);
    }
    return ascii;
}

} // namespace overt
