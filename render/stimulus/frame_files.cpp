#include "render/stimulus/frame_files.h"

#include <cmath>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/pictures/picture_file.h"

namespace overt {

void write_exr(const std::filesystem::path& file, const ChannelPicture& picture, ExrNumbers numbers,
               const ImageAttributes& attributes) {
    const bool half = numbers == ExrNumbers::half;
    constexpr float largest_half = 65504.0f;
    for (const float value : picture.values) {
        if (half && !(std::abs(value) <= largest_half))
            throw InputError(fmt::format("{}: a value of {} does not fit into half floats: lower the "
                                         "exposure, or leave out --half",
                                         file.string(), value));
    }
    PictureHeader header{picture.size_px,
                         picture.channels,
                         half ? PixelType::float16 : PixelType::float32,
                         static_cast<int>(picture.channels.size()) - 1,
                         {{"compression", half ? "zip" : "pxr24"}}};
    header.attributes.insert(header.attributes.end(), attributes.begin(), attributes.end());
    write_picture(file, header, PixelType::float32, picture.values.data());
}

void write_rgb16_png(const std::filesystem::path& file, glm::ivec2 size_px,
                     std::span<const std::uint16_t> values) {
    write_picture(file, {size_px, {"R", "G", "B"}, PixelType::bits16}, PixelType::bits16, values.data());
}

std::string text_attribute(const std::filesystem::path& file, const std::string& name) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(file, ignored))
        return {};
    try {
        return PictureFile(file, "picture").header().text(name);
    } catch (const InputError&) {
        return {};
    }
}

} // namespace overt
