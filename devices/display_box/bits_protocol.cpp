#include "devices/display_box/bits_protocol.h"

#include <fmt/format.h>

#include "devices/link/byte_transport.h"
#include "experiment/base/text_number.h"

namespace overt {
namespace {

std::string_view without_blanks(std::string_view text) {
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t'))
        text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t'))
        text.remove_suffix(1);
    return text;
}

} // namespace

std::string bits_command(std::string_view name, std::string_view argument) {
    return argument.empty() ? fmt::format("${}\r", name) : fmt::format("${}=[{}]\r", name, argument);
}

std::optional<std::string_view> bits_reply(std::string_view line, std::string_view name) {
    for (std::size_t hash = line.rfind('#'); hash != std::string_view::npos;
         hash = hash == 0 ? std::string_view::npos : line.rfind('#', hash - 1)) {
        const std::string_view rest = line.substr(hash + 1);
        if (rest.size() > name.size() && rest.starts_with(name) && rest[name.size()] == ';')
            return rest.substr(name.size() + 1);
    }
    return std::nullopt;
}

std::vector<std::string_view> bits_fields(std::string_view text) {
    std::vector<std::string_view> fields;
    while (!text.empty()) {
        const std::size_t end = text.find(';');
        fields.push_back(without_blanks(text.substr(0, end)));
        text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
    }
    return fields;
}

VideoLine parse_video_line(std::string_view text, int pixels) {
    const std::vector<std::string_view> fields = bits_fields(text);
    const std::size_t expected = 3 * static_cast<std::size_t>(pixels);
    if (fields.size() != expected)
        return {{}, fmt::format("{} numbers came for {} pixels, not {}", fields.size(), pixels, expected)};
    VideoLine line;
    line.pixels.resize(static_cast<std::size_t>(pixels));
    for (std::size_t i = 0; i < expected; ++i) {
        const auto value = number_in<std::uint8_t>(fields[i]);
        if (!value)
            return {{},
                    fmt::format("number {} of {} is \"{}\", not 0 to 255", i + 1, expected,
                                printable(fields[i], 16))};
        line.pixels[i / 3][i % 3] = *value;
    }
    return line;
}

} // namespace overt
