#include "render/image/linear_image.h"

#include <algorithm>
#include <array>
#include <span>

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/memory_for.h"
#include "experiment/maps/picture_file.h"
#include "render/image/stored_values.h"

namespace overt {

namespace {

/// Where in a file's pixel red, green, blue and alpha stand; alpha -1: nowhere.
struct ChannelPlaces {
    int channels = 4; ///< that are read
    std::array<int, 4> of{0, 1, 2, -1};

    bool are_rgba() const { return channels == 4 && of[3] == 3; }
};

/// Number of the alpha channel, or -1.
int alpha_channel_of(const OIIO::ImageSpec& spec) {
    if (spec.alpha_channel >= 0)
        return spec.alpha_channel;
    return spec.nchannels == 4 || spec.nchannels == 2 ? spec.nchannels - 1 : -1;
}

ChannelPlaces places_in(const OIIO::ImageSpec& spec, const std::filesystem::path& file) {
    ChannelPlaces places;
    places.channels = std::min(spec.nchannels, 4);
    if (spec.nchannels < 3)
        places.of = {0, 0, 0, -1};
    places.of[3] = alpha_channel_of(spec);
    if (places.of[3] >= places.channels) {
        throw InputError(fmt::format("{}: alpha is its channel {}; it has to be among the first four",
                                     file.string(), places.of[3] + 1));
    }
    return places;
}

std::span<float> values_of(LinearImage& image) { return {&image.pixels.data()->x, 4 * image.pixels.size()}; }

/// What is known of a file's values.
struct ValueFacts {
    bool are_codes = false; ///< of 8 or 16 bits
    bool are_finite = true;
};

/// Rows that are read at once: few enough to be still in the processor's cache when they are made floats, and
/// a multiple of what the usual compressions of EXR join.
constexpr int rows_in_band = 64;

/// Reads the channels of all pixels as floats.
ValueFacts read_values(OIIO::ImageInput& input, const ChannelPlaces& places, std::span<float> into,
                       const std::filesystem::path& file) {
    const OIIO::ImageSpec& spec = input.spec();
    const auto check = [&](bool was_read) {
        if (!was_read)
            throw InputError(
                fmt::format("{}: reading the picture failed: {}", file.string(), input.geterror()));
    };
    const bool halves = spec.format == OIIO::TypeDesc::HALF, codes = spec.format == OIIO::TypeDesc::UINT16;
    if ((!halves && !codes) || !spec.channelformats.empty()) {
        check(input.read_image(0, 0, 0, places.channels, OIIO::TypeDesc::FLOAT, into.data()));
        return {spec.format == OIIO::TypeDesc::UINT8, all_finite(into)};
    }
    // Kept for the next file that this thread reads.
    thread_local std::vector<std::uint16_t> stored;
    const bool in_tiles = spec.tile_width > 0;
    const int rows_at_once = in_tiles ? spec.height : std::min(rows_in_band, spec.height);
    const auto row_values = static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(places.channels);
    stored.resize(row_values * static_cast<std::size_t>(rows_at_once));
    ValueFacts facts{codes, true};
    for (int row = 0; row < spec.height; row += rows_at_once) {
        const int end = std::min(row + rows_at_once, spec.height);
        const OIIO::TypeDesc as_they_are = OIIO::TypeDesc::UNKNOWN;
        check(in_tiles ? input.read_image(0, 0, 0, places.channels, as_they_are, stored.data())
                       : input.read_scanlines(0, 0, spec.y + row, spec.y + end, spec.z, 0, places.channels,
                                              as_they_are, stored.data()));
        const auto count = row_values * static_cast<std::size_t>(end - row);
        const std::span from(stored.data(), count);
        const auto floats = into.subspan(row_values * static_cast<std::size_t>(row), count);
        if (codes)
            floats_of_codes(from, floats);
        else
            facts.are_finite = floats_of_halves(from, floats) && facts.are_finite;
    }
    return facts;
}

void decode_srgb(LinearImage& image, bool of_codes) {
    for (glm::vec4& pixel : image.pixels) {
        for (int channel = 0; channel < 3; ++channel)
            pixel[channel] =
                of_codes ? linear_from_srgb_code(pixel[channel]) : linear_from_srgb(pixel[channel]);
    }
}

std::unique_ptr<OIIO::ImageInput> open_image(const std::filesystem::path& file) {
    // Colours as they stand in the file: multiplied by alpha too early, an encoding could not be undone.
    OIIO::ImageSpec wish;
    wish.attribute("oiio:UnassociatedAlpha", 1);
    return open_picture(file, "picture", &wish);
}

void read_opened(const std::filesystem::path& file, FrameEncoding encoding, LinearImage& into) {
    const auto input = open_image(file);
    const OIIO::ImageSpec spec = input->spec();
    const ChannelPlaces places = places_in(spec, file);
    into.size_px = {spec.width, spec.height};
    into.pixels.resize(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height));
    // Each file is read by one thread: several are read at once.
    input->threads(1);
    ValueFacts facts;
    if (places.are_rgba()) {
        facts = read_values(*input, places, values_of(into), file);
    } else {
        thread_local std::vector<float> values;
        values.resize(into.pixels.size() * static_cast<std::size_t>(places.channels));
        facts = read_values(*input, places, values, file);
        const auto [r, g, b, a] = places.of;
        const float* stored = values.data();
        for (glm::vec4& pixel : into.pixels) {
            pixel = {stored[r], stored[g], stored[b], a >= 0 ? stored[a] : 1.0f};
            stored += places.channels;
        }
    }
    if (!facts.are_finite) {
        const auto bad = std::ranges::find_if(into.pixels, [](const glm::vec4& pixel) {
            return !all_finite({&pixel.x, 4});
        });
        // The value may stand in a channel that is not used.
        if (bad != into.pixels.end()) {
            const auto index = static_cast<int>(bad - into.pixels.begin());
            throw InputError(fmt::format("{}: pixel ({}, {}) holds a value that is not a finite number",
                                         file.string(), index % spec.width, index / spec.width));
        }
    }
    if (encoding == FrameEncoding::srgb)
        decode_srgb(into, facts.are_codes);
    if (places.of[3] >= 0 && spec.get_int_attribute("oiio:UnassociatedAlpha") != 0) {
        for (glm::vec4& pixel : into.pixels)
            pixel = glm::vec4(glm::vec3(pixel) * pixel.w, pixel.w);
    }
}

} // namespace

LinearImage read_linear_image(const std::filesystem::path& file, FrameEncoding encoding) {
    LinearImage image;
    read_linear_image(file, encoding, image);
    return image;
}

void read_linear_image(const std::filesystem::path& file, FrameEncoding encoding, LinearImage& into) {
    with_memory_for(file, [&] { read_opened(file, encoding, into); });
}

glm::ivec2 image_size_px(const std::filesystem::path& file) {
    const auto input = open_image(file);
    return {input->spec().width, input->spec().height};
}

bool has_alpha(const std::filesystem::path& file) { return alpha_channel_of(open_image(file)->spec()) >= 0; }

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
