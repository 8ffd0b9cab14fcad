/// PNG files of eight bits in sRGB, as overt shows pictures to people, written without the 260 libraries
/// behind OpenImageIO.
#pragma once

#include <optional>
#include <vector>

#include "experiment/pictures/picture_header.h"

namespace overt {

/// The bytes of a file, the same to the last as OpenImageIO writes them. `rgb`: rows from the top, three
/// bytes a pixel. Nothing if the header says anything else than red, green and blue in eight bits with the
/// attribute "oiio:ColorSpace" "sRGB", and if something fails: OpenImageIO then says what it is. Any thread.
std::optional<std::vector<unsigned char>> encode_srgb_png(const PictureHeader& header, PixelType type,
                                                          const void* rgb);

} // namespace overt
