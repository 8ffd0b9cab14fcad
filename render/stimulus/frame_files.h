/// Rendered frames as files for other programs.
#pragma once

#include <cstdint>
#include <span>

#include "render/image/linear_image.h"

namespace overt {

/// A picture of any channels, row by row from the top.
struct ChannelPicture {
    glm::ivec2 size_px{0};
    std::vector<std::string> channels; ///< the last is alpha, "A"
    std::vector<float> values;         ///< all channels of a pixel together
};

/// How an EXR's numbers are kept: floats rounded to 24 bits (16 of precision, so within half a code of 16
/// bits everywhere between black and white; compression PXR24), or half floats (11 bits: of 65,536 codes
/// 7,169; compression ZIP).
enum class ExrNumbers : std::uint8_t { bits24, half };

/// Writes an EXR, whole or not at all. Throws RecordError, and InputError if a value is too large for half
/// floats.
void write_exr(const std::filesystem::path& file, const ChannelPicture& picture, ExrNumbers numbers,
               const ImageAttributes& attributes);

/// Writes a PNG of three channels of 16 bits, likewise. Throws RecordError.
void write_rgb16_png(const std::filesystem::path& file, glm::ivec2 size_px,
                     std::span<const std::uint16_t> values);

/// A text attribute of an EXR; empty if the file is not there, is no picture or has none of that name.
std::string text_attribute(const std::filesystem::path& file, const std::string& name);

} // namespace overt
