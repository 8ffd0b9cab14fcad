/// Pictures of Radiance (".hdr", ".pic"; Ward, "Real Pixels", Graphics Gems II, 1991; "Radiance File
/// Formats", LBNL). OpenImageIO reads them as they lie in the file: without turning them, without exposure,
/// and the old run lengths wrongly.
#pragma once

#include <memory>
#include <string>

#include "experiment/pictures/picture_library.h"

namespace overt {

/// Opens a picture in 32 bits a pixel (RGBE or XYZE), flat or in old or new run lengths. Its light is that of
/// the scene: divided by the product of all EXPOSURE and of all COLORCORR lines, XYZE also by 179 lm/W; its
/// rows and columns are turned as the resolution line says. Primaries other than Radiance's unsaid ones are
/// told by the header (PictureHeader::primaries). Nothing for a file that does not begin with "#?"; nothing
/// and a fault for one whose header cannot be followed. Any thread.
std::unique_ptr<PictureDecoder> open_radiance(const std::string& file, std::string& fault);

} // namespace overt
