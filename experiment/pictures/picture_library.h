/// OpenImageIO behind a door. It brings some 260 libraries, which take the system half a second to link and
/// 100 MB to hold; they are loaded when the first picture is read or written that is not one of overt's own
/// (plain_exr.h, plain_png.h), and not at all by a command without such.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "experiment/pictures/picture_header.h"

namespace overt {

/// A picture that is open. Faults are returned, as text; empty: none. One thread at a time.
class PictureDecoder {
  public:
    virtual ~PictureDecoder() = default;
    virtual const PictureHeader& header() const = 0;
    /// The first channels of rows begin … end-1 into memory of `as`; `other` means as they are stored. A
    /// picture in tiles is read whole.
    virtual std::string read(int begin_row, int end_row, int channels, PixelType as, void* into) = 0;
};

/// What the module gives. Any thread.
class PictureLibrary {
  public:
    virtual ~PictureLibrary() = default;
    /// `straight`: colours as they stand, not multiplied by alpha. Nothing and a fault if it is no picture.
    virtual std::unique_ptr<PictureDecoder> open(const std::string& file, bool straight,
                                                 std::string& fault) const = 0;
    /// The same of a file in memory, which must outlive the decoder, by the reader of the format "png" or
    /// "jpeg" alone, whatever the bytes are. Rows are as they are stored, whichever way a camera was held.
    virtual std::unique_ptr<PictureDecoder> open_bytes(std::string_view bytes, const std::string& format,
                                                       bool straight, std::string& fault) const = 0;
    /// The bytes of a file of the format that the name's ending tells. Returns the fault.
    virtual std::string encode(const std::string& name, const PictureHeader& header, PixelType type,
                               const void* pixels, std::vector<unsigned char>& bytes) const = 0;
};

/// Loads the module at the first call, which takes half a second: before a trial, not in it. Throws Error
/// that names the module's file if it cannot be loaded. Any thread.
const PictureLibrary& picture_library();

} // namespace overt
