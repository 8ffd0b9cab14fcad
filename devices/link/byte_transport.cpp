#include "devices/link/byte_transport.h"

#include <fmt/format.h>

namespace overt {

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
