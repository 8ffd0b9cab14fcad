/// OpenEXR files as overt itself writes them, read without the 260 libraries behind OpenImageIO: a session
/// whose stimuli are ready needs no other pictures, and begins a quarter of a second of a processor sooner.
#pragma once

#include <memory>
#include <string>

#include "experiment/pictures/picture_library.h"

namespace overt {

/// Opens a file of one part in scanlines, without an offset, that holds one channel of whole numbers, or in
/// floats red, green, blue and perhaps alpha, or luminance and alpha. Nothing for any other file, and for one
/// that is damaged or not there: OpenImageIO then says what it is. Attributes that the format itself has are
/// left out, but for "compression". What is asked for and cannot be given as it stands goes through
/// OpenImageIO, too. Any thread.
std::unique_ptr<PictureDecoder> open_plain_exr(const std::string& file);

} // namespace overt
