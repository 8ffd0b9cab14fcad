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
    LinearImage image;
    read_linear_image(file, encoding, image);
    return image;
}

void read_linear_image(const std::filesystem::path& file, FrameEncoding encoding, LinearImage& into) {
    const auto input = open_image(file);
    const OIIO::ImageSpec spec = input->spec();
    const bool grey = spec.nchannels < 3;
    const int alpha = spec.alpha_channel >= 0 ? spec.alpha_channel
                                              : (spec.nchannels == 4   ? 3
                                                 : spec.nchannels == 2 ? 1
                                                                       : -1);
    // Its channels go to where the pixels will be, as many as have room there.
    const int read = std::min(spec.nchannels, 4);
    if (alpha >= read) {
        throw InputError(fmt::format("{}: alpha is its channel {}; it has to be among the first four",
                                     file.string(), alpha + 1));
    }
    into.size_px = {spec.width, spec.height};
    into.pixels.resize(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height));
    // Each file is read by one thread: several are read at once.
    input->threads(1);
    if (!input->read_image(0, 0, 0, read, OIIO::TypeDesc::FLOAT, into.pixels.data(), sizeof(glm::vec4))) {
        throw InputError(fmt::format("{}: reading the picture failed: {}", file.string(), input->geterror()));
    }
    for (std::size_t i = 0; i < into.pixels.size(); ++i) {
        const glm::vec4 value = into.pixels[i];
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
        into.pixels[i] = pixel;
    }
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
