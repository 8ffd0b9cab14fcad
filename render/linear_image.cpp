#include "render/linear_image.h"

#include <algorithm>
#include <cmath>

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include "experiment/error.h"

namespace overt {

namespace {

/// IEC 61966-2-1, equations of the encoding and its inverse.
float linear_from_srgb(float v) { return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f); }
float srgb_from_linear(float v) {
    return v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1.0f / 2.4f) - 0.055f;
}

std::unique_ptr<OIIO::ImageInput> open_image(const std::filesystem::path& file) {
    auto input = OIIO::ImageInput::open(file.string());
    if (!input)
        throw InputError(fmt::format("{}: cannot be read as a picture: {}", file.string(), OIIO::geterror()));
    return input;
}

/// Opens a writer for `file` under a temporary name and gives that name.
std::filesystem::path temporary_name_of(const std::filesystem::path& file) {
    std::filesystem::path temporary = file;
    temporary.replace_filename("." + file.stem().string() + ".partial" + file.extension().string());
    return temporary;
}

void write_picture(const std::filesystem::path& file, const OIIO::ImageSpec& spec, OIIO::TypeDesc type,
                   const void* pixels) {
    const std::filesystem::path temporary = temporary_name_of(file);
    auto output = OIIO::ImageOutput::create(temporary.string());
    const bool written = output && output->open(temporary.string(), spec) &&
                         output->write_image(type, pixels) && output->close();
    if (!written) {
        const std::string reason = output ? output->geterror() : OIIO::geterror();
        std::error_code ignored;
        std::filesystem::remove(temporary, ignored);
        throw RecordError(fmt::format("{}: cannot be written: {}", file.string(), reason));
    }
    std::filesystem::rename(temporary, file);
}

} // namespace

LinearImage read_linear_image(const std::filesystem::path& file, FrameEncoding encoding) {
    const auto input = open_image(file);
    const OIIO::ImageSpec spec = input->spec();
    const std::size_t channels = static_cast<std::size_t>(spec.nchannels);
    std::vector<float> raw(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height) *
                           channels);
    // Each file is read by one thread: several are read at once.
    input->threads(1);
    if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, raw.data())) {
        throw InputError(fmt::format("{}: reading the picture failed: {}", file.string(), input->geterror()));
    }
    const bool grey = spec.nchannels < 3;
    const int alpha = spec.alpha_channel >= 0 ? spec.alpha_channel
                                              : (spec.nchannels == 4   ? 3
                                                 : spec.nchannels == 2 ? 1
                                                                       : -1);
    LinearImage image({spec.width, spec.height});
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const float* value = &raw[i * channels];
        glm::vec4 pixel(value[0], value[grey ? 0 : 1], value[grey ? 0 : 2], alpha >= 0 ? value[alpha] : 1.0f);
        if (encoding == FrameEncoding::srgb) {
            for (int channel = 0; channel < 3; ++channel)
                pixel[channel] = linear_from_srgb(pixel[channel]);
        }
        if (!std::isfinite(pixel.x + pixel.y + pixel.z + pixel.w)) {
            throw InputError(fmt::format("{}: pixel ({}, {}) holds a value that is not a finite number",
                                         file.string(), static_cast<int>(i) % spec.width,
                                         static_cast<int>(i) / spec.width));
        }
        image.pixels[i] = pixel;
    }
    return image;
}

glm::ivec2 image_size_px(const std::filesystem::path& file) {
    const auto input = open_image(file);
    return {input->spec().width, input->spec().height};
}

void write_linear_exr(const std::filesystem::path& file, const LinearImage& image,
                      const ImageAttributes& attributes) {
    OIIO::ImageSpec spec(image.size_px.x, image.size_px.y, 4, OIIO::TypeDesc::FLOAT);
    spec.channelnames = {"R", "G", "B", "A"};
    spec.alpha_channel = 3;
    spec.attribute("compression", "pxr24");
    for (const auto& [name, value] : attributes)
        spec.attribute(name, value);
    write_picture(file, spec, OIIO::TypeDesc::FLOAT, image.pixels.data());
}

void write_srgb_png(const std::filesystem::path& file, const LinearImage& image) {
    std::vector<unsigned char> bytes;
    bytes.reserve(image.pixels.size() * 3);
    for (const glm::vec4& pixel : image.pixels) {
        for (int channel = 0; channel < 3; ++channel) {
            const float encoded = srgb_from_linear(std::clamp(pixel[channel], 0.0f, 1.0f));
            bytes.push_back(static_cast<unsigned char>(encoded * 255.0f + 0.5f));
        }
    }
    OIIO::ImageSpec spec(image.size_px.x, image.size_px.y, 3, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    write_picture(file, spec, OIIO::TypeDesc::UINT8, bytes.data());
}

} // namespace overt
