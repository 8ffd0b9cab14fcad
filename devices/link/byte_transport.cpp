#include "devices/link/byte_transport.h"

#include <array>

#include <fmt/format.h>

namespace overt {

void read_away(ByteTransport& line, SessionTime now) noexcept {
    constexpr int most_readings = 1000;
    std::array<char, 256> stale;
    int readings = 0;
    while (readings < most_readings && line.read(stale, now) > 0)
        ++readings;
}

std::string printable(std::string_view bytes, std::size_t longest) {
    std::string text;
    if (bytes.size() > longest) {
        text = "…";
        bytes.remove_prefix(bytes.size() - longest);
    }
    for (const char byte : bytes) {
        if (byte >= ' ' && byte <= '~')
            text += byte;
        else
            text += fmt::format("\\x{:02x}", static_cast<unsigned>(static_cast<unsigned char>(byte)));
    }
    return text;
}

} // namespace overt
