/// OpenEXR files of overt's own, read and written without the 260 libraries behind OpenImageIO: a session and
/// a replay need no other pictures, and begin a quarter of a second of a processor sooner.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiment/pictures/picture_library.h"

namespace overt {

/// Opens a file of one part in scanlines, without an offset, that holds one channel of whole numbers, or in
/// floats red, green, blue and perhaps alpha, or luminance and alpha. Nothing for any other file, and for one
/// that is damaged or not there: OpenImageIO then says what it is. Attributes that the format itself has are
/// left out, but for "compression". What is asked for and cannot be given as it stands goes through
/// OpenImageIO, too. Any thread.
std::unique_ptr<PictureDecoder> open_plain_exr(const std::string& file);

/// The bytes of a file, the same to the last as OpenImageIO writes them: of whole numbers from such, of
/// floats or half floats from either; `type`: of `pixels`, as in write_picture(). Nothing for other types,
/// other compressions than ZIP and PXR24, and attributes other than "compression" and those that begin with
/// "overt:", and if something fails: OpenImageIO then says what it is. Any thread.
std::optional<std::vector<unsigned char>> encode_plain_exr(const PictureHeader& header, PixelType type,
                                                           const void* pixels);

} // namespace overt
