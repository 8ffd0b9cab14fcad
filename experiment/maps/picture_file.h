/// Reading and writing pictures of any format, for those who know OpenImageIO.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string_view>

#include <OpenImageIO/imageio.h>

namespace overt {

/// Largest picture that is read: as many bytes as its values take as 32-bit numbers.
inline constexpr std::uint64_t most_picture_bytes = std::uint64_t{1} << 30;
inline constexpr int most_picture_side_px = 32768;

/// Opens a picture and looks at what its header claims before a single value is read: a header of a few bytes
/// can ask for more memory than there is. `kind` is what it should be, for messages ("picture", "map");
/// `wish` is passed on. Throws InputError that names the file: what is no picture, has no pixels, is deep, or
/// claims more than the two limits.
std::unique_ptr<OIIO::ImageInput> open_picture(const std::filesystem::path& file, std::string_view kind,
                                               const OIIO::ImageSpec* wish = nullptr);

/// Writes a picture, whole or not at all, in the format of the name's ending. `pixels` are of `type`, row by
/// row. Throws RecordError.
void write_picture(const std::filesystem::path& file, const OIIO::ImageSpec& spec, OIIO::TypeDesc type,
                   const void* pixels);

} // namespace overt
