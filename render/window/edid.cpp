#include "render/window/edid.h"

#include <algorithm>
#include <array>

namespace overt {
namespace {

// Section 3.10: four descriptors of 18 bytes from byte 54. One that begins with three zeros is no timing but
// a display descriptor, whose byte 3 is its tag and whose text begins at byte 5 and ends with a line feed.
constexpr std::size_t first_descriptor = 54, descriptor_bytes = 18, descriptor_count = 4, text_offset = 5;
constexpr auto name_tag = std::byte{0xfc};
constexpr std::array header = {std::byte{0x00}, std::byte{0xff}, std::byte{0xff}, std::byte{0xff},
                               std::byte{0xff}, std::byte{0xff}, std::byte{0xff}, std::byte{0x00}};

std::string text_of(std::span<const std::byte> descriptor) {
    std::string text;
    for (const std::byte byte : descriptor.subspan(text_offset)) {
        const auto character = static_cast<unsigned char>(byte);
        if (character < 0x20 || character > 0x7e)
            break;
        text += static_cast<char>(character);
    }
    text.erase(text.find_last_not_of(' ') + 1);
    return text;
}

} // namespace

std::string product_name_of(std::span<const std::byte> edid) {
    if (edid.size() < edid_block_bytes || !std::ranges::equal(edid.first(header.size()), header))
        return {};
    for (std::size_t i = 0; i < descriptor_count; ++i) {
        const auto descriptor = edid.subspan(first_descriptor + i * descriptor_bytes, descriptor_bytes);
        if (std::ranges::all_of(descriptor.first(3), [](std::byte byte) { return byte == std::byte{0}; }) &&
            descriptor[3] == name_tag)
            return text_of(descriptor);
    }
    return {};
}

} // namespace overt
