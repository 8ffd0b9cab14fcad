/// A picture in linear light, and pictures as files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "experiment/protocol/protocol.h"

namespace overt {

/// RGBA, linear display light: 0 is the display's black, 1 its white; alpha is the object's coverage. Top row
/// first.
struct LinearImage {
    glm::ivec2 size_px{0};
    std::vector<glm::vec4> pixels;

    LinearImage() = default;
    explicit LinearImage(glm::ivec2 size)
        : size_px(size), pixels(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y)) {}
    glm::vec4& at(int x, int y) {
        return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(size_px.x) +
                      static_cast<std::size_t>(x)];
    }
    const glm::vec4& at(int x, int y) const { return const_cast<LinearImage*>(this)->at(x, y); }
};

/// Named attributes of an EXR file.
using ImageAttributes = std::vector<std::pair<std::string, std::string>>;

/// What becomes of colours of a file that says in which space they are (OpenEXR's chromaticities, Radiance's
/// PRIMARIES): they stay numbers, or become Rec. 709 with white as white. What says nothing is left.
enum class FileColours : std::uint8_t { as_they_stand, as_rec709 };

/// Reads EXR, PNG, TIFF, HDR … of 8, 16 or 32 bits. Grey is spread over the three channels; without an alpha
/// channel alpha is 1. `srgb` encoding is undone after IEC 61966-2-1; then straight colours (PNG) are
/// multiplied by alpha. OpenEXR's whole numbers mean themselves. Throws InputError if the file cannot be
/// read, holds no picture, no colours or a value that is not finite.
LinearImage read_linear_image(const std::filesystem::path& file,
                              FrameEncoding encoding = FrameEncoding::linear,
                              FileColours colours = FileColours::as_they_stand);

/// The same into a picture whose memory is used again.
void read_linear_image(const std::filesystem::path& file, FrameEncoding encoding, FileColours colours,
                       LinearImage& into);

/// Size of a picture without reading its pixels. Throws InputError as read_linear_image does.
glm::ivec2 image_size_px(const std::filesystem::path& file);

/// Whether a picture says that its colours are of a space other than linear Rec. 709. Throws likewise, and if
/// what it says is no space.
bool has_other_primaries(const std::filesystem::path& file);

/// Whether a picture has an alpha channel. Throws likewise.
bool has_alpha(const std::filesystem::path& file);

/// Writes an EXR of floats rounded to 24 bits (relative error below 2^-16, compression PXR24), at once or not
/// at all: under another name first, then renamed. Throws RecordError.
void write_linear_exr(const std::filesystem::path& file, const LinearImage& image,
                      const ImageAttributes& attributes);

/// Writes an 8-bit sRGB PNG for looking at: colours clipped to 0 … 1, composed over black. Throws
/// RecordError.
void write_srgb_png(const std::filesystem::path& file, const LinearImage& image);

} // namespace overt
