/// Writing pictures of any format, for those who write them.
#pragma once

#include <filesystem>

#include <OpenImageIO/imageio.h>

namespace overt {

/// Writes a picture, whole or not at all, in the format of the name's ending. `pixels` are of `type`, row by
/// row. Throws RecordError.
void write_picture(const std::filesystem::path& file, const OIIO::ImageSpec& spec, OIIO::TypeDesc type,
                   const void* pixels);

} // namespace overt
