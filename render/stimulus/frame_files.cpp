#include "render/stimulus/frame_files.h"

#include <cmath>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/maps/picture_file.h"

namespace overt {

void write_half_exr(const std::filesystem::path& file, const ChannelPicture& picture,
                    const ImageAttributes& attributes) {
    constexpr float largest_half = 65504.0f;
    for (const float value : picture.values) {
        if (!(std::abs(value) <= largest_half))
            throw InputError(fmt::format(
                "{}: a value of {} does not fit into half floats: lower the exposure", file.string(), value));
    }
    OIIO::ImageSpec spec(picture.size_px.x, picture.size_px.y, static_cast<int>(picture.channels.size()),
                         OIIO::TypeDesc::HALF);
    spec.channelnames = picture.channels;
    spec.alpha_channel = spec.nchannels - 1;
    spec.attribute("compression", "zip");
    for (const auto& [name, value] : attributes)
        spec.attribute(name, value);
    write_picture(file, spec, OIIO::TypeDesc::FLOAT, picture.values.data());
}

void write_rgb16_png(const std::filesystem::path& file, glm::ivec2 size_px,
                     std::span<const std::uint16_t> values) {
    const OIIO::ImageSpec spec(size_px.x, size_px.y, 3, OIIO::TypeDesc::UINT16);
    write_picture(file, spec, OIIO::TypeDesc::UINT16, values.data());
}

std::string text_attribute(const std::filesystem::path& file, const std::string& name) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(file, ignored))
        return {};
    const auto input = OIIO::ImageInput::open(file.string());
    if (!input) {
        OIIO::geterror(); // fetched, so that it is not printed later
        return {};
    }
    return input->spec().get_string_attribute(name);
}

} // namespace overt
