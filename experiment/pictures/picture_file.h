/// Reading and writing pictures of any format.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "experiment/pictures/picture_header.h"

namespace overt {

class PictureDecoder;

/// Largest picture that is read: as many bytes as its values take as 32-bit numbers.
inline constexpr std::uint64_t most_picture_bytes = std::uint64_t{1} << 30;
inline constexpr int most_picture_side_px = 32768;

/// What becomes of colours where a file has them straight, not multiplied by alpha, as PNG has.
enum class StraightColours : std::uint8_t { multiplied, as_they_stand };

/// A picture that is open for reading. Used by one thread at a time; several read several files at once.
class PictureFile {
  public:
    /// Looks at what the header claims before a single value is read: a header of a few bytes can ask for
    /// more memory than there is. `kind` is what it should be, for messages ("picture", "map"). Throws
    /// InputError that names the file: what is no picture, has no pixels, is deep, or claims more than the
    /// two limits.
    PictureFile(std::filesystem::path file, std::string_view kind,
                StraightColours straight = StraightColours::multiplied);
    /// The same of the bytes of a PNG, JPEG or WebP file in memory, which must outlive it; `format` is "png",
    /// "jpeg" or "webp". Rows are as they are stored, whichever way a camera was held. `name`: for messages.
    PictureFile(std::string_view bytes, const std::string& format, std::string name, std::string_view kind,
                StraightColours straight);
    ~PictureFile();

    const PictureHeader& header() const;
    /// Reads the first `channels` channels of all rows, or of rows begin … end-1 of a picture that is not in
    /// tiles, as values of a type, row by row; `other`: as they are stored. Throws InputError.
    void read(int channels, PixelType as, void* into) {
        read_rows(0, header().size_px.y, channels, as, into);
    }
    void read_rows(int begin, int end, int channels, PixelType as, void* into);

  private:
    std::filesystem::path file_;
    std::string kind_;
    std::unique_ptr<PictureDecoder> decoder_;
};

/// Writes a picture, whole or not at all, in the format of the name's ending. `pixels` are of `type`, row by
/// row. Throws RecordError.
void write_picture(const std::filesystem::path& file, const PictureHeader& header, PixelType type,
                   const void* pixels);

} // namespace overt
