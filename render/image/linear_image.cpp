#include "render/image/linear_image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/error.h"
#include "experiment/base/memory_for.h"
#include "experiment/colour/rgb_primaries.h"
#include "experiment/pictures/picture_file.h"
#include "render/image/stored_values.h"

namespace overt {

namespace {

/// Where in a file's pixel red, green, blue and alpha stand; alpha -1: nowhere.
struct ChannelPlaces {
    int channels = 4; ///< that are read
    std::array<int, 4> of{0, 1, 2, -1};
    bool are_xyz = false; ///< X, Y and Z of CIE 1931 in their place

    bool are_rgba() const { return channels == 4 && of == std::array{0, 1, 2, 3}; }
};

/// Number of the alpha channel, or -1.
int alpha_channel_of(const PictureHeader& header) {
    if (header.alpha_channel >= 0)
        return header.alpha_channel;
    const int channels = header.channel_count();
    return channels == 4 || channels == 2 ? channels - 1 : -1;
}

[[noreturn]] void refuse_channels(const PictureHeader& header, const std::filesystem::path& file,
                                  std::string_view what) {
    throw InputError(fmt::format(
        "{}: {}: it has {} ({}). Save a picture with the channels R, G, B, or X, Y, Z, or Y alone, "
        "perhaps with A",
        file.string(), what, fmt::join(header.channels, ", "), header.type_name));
}

/// By the channels' names, as OpenEXR has them: there what stands first may be depth, or a normal.
ChannelPlaces named_places_in(const PictureHeader& header, const std::filesystem::path& file) {
    // The layers that have colours; a picture without layers has one without a name.
    std::vector<std::string> layers;
    for (const std::string& channel : header.channels) {
        if (channel != "R" && !channel.ends_with(".R"))
            continue;
        const std::string layer = channel.substr(0, channel.size() - 1);
        if (header.channel(layer + "G") >= 0 && header.channel(layer + "B") >= 0)
            layers.push_back(layer);
    }
    ChannelPlaces places;
    const auto take = [&](std::array<std::string, 4> names) {
        for (std::size_t i = 0; i < 4; ++i)
            places.of[i] = header.channel(names[i]);
        places.channels = *std::ranges::max_element(places.of) + 1;
        return places;
    };
    const bool has_plain = std::ranges::find(layers, std::string()) != layers.end();
    if (has_plain || layers.size() == 1) {
        const std::string layer = has_plain ? std::string() : layers.front();
        return take({layer + "R", layer + "G", layer + "B", layer + "A"});
    }
    if (layers.size() > 1)
        refuse_channels(header, file, "holds several layers of colours");
    if (header.channel("X") >= 0 && header.channel("Y") >= 0 && header.channel("Z") >= 0) {
        places.are_xyz = true;
        return take({"X", "Y", "Z", "A"});
    }
    if (header.channel("RY") >= 0 || header.channel("BY") >= 0)
        refuse_channels(header, file, "holds luminance with colour differences");
    if (header.channel("Y") >= 0)
        return take({"Y", "Y", "Y", "A"});
    refuse_channels(header, file,
                    header.channel("Z") >= 0 ? "holds depth and no colours" : "holds no colours");
}

ChannelPlaces places_in(const PictureHeader& header, const std::filesystem::path& file) {
    if (header.format == "openexr")
        return named_places_in(header, file);
    ChannelPlaces places;
    places.channels = std::min(header.channel_count(), 4);
    if (header.channels.size() < 3)
        places.of = {0, 0, 0, -1};
    places.of[3] = alpha_channel_of(header);
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
ValueFacts read_values(PictureFile& picture, const ChannelPlaces& places, std::span<float> into) {
    const PictureHeader& header = picture.header();
    const bool codes = header.type == PixelType::bits16;
    if ((header.type != PixelType::float16 && !codes) || header.channels_differ) {
        picture.read(places.channels, PixelType::float32, into.data());
        return {header.type == PixelType::bits8, all_finite(into)};
    }
    // Kept for the next file that this thread reads.
    thread_local std::vector<std::uint16_t> stored;
    const glm::ivec2 size = header.size_px;
    const int rows_at_once = header.tile_px.x > 0 ? size.y : std::min(rows_in_band, size.y);
    const auto row_values = static_cast<std::size_t>(size.x) * static_cast<std::size_t>(places.channels);
    stored.resize(row_values * static_cast<std::size_t>(rows_at_once));
    ValueFacts facts{codes, true};
    for (int row = 0; row < size.y; row += rows_at_once) {
        const int end = std::min(row + rows_at_once, size.y);
        picture.read_rows(row, end, places.channels, PixelType::other, stored.data());
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

/// Colours as they stand in the file: multiplied by alpha too early, an encoding could not be undone.
PictureFile opened(const std::filesystem::path& file) {
    return PictureFile(file, "picture", StraightColours::as_they_stand);
}

[[noreturn]] void refuse_value(const std::filesystem::path& file, const glm::vec4& pixel, int index,
                               const PictureHeader& header) {
    const bool is_infinite = std::isinf(pixel.x) || std::isinf(pixel.y) || std::isinf(pixel.z);
    const int width = header.size_px.x;
    throw InputError(fmt::format(
        "{}: pixel ({}, {}) holds a value that is not a finite number ({:g}, {:g}, {:g}){}", file.string(),
        index % width, index / width, pixel.x, pixel.y, pixel.z,
        is_infinite
            ? ": light brighter than 65504 does not fit half floats, as which a sun is often saved. Save the "
              "picture with 32-bit floats, or with no value above 65504 (oiiotool IN --clamp:max=65504 -o "
              "OUT)"
            : ": save it without such values (oiiotool IN --fixnan box3 -o OUT)"));
}

/// What turns the file's colours into Rec. 709; nothing if they are that, or nobody said what they are.
std::optional<glm::mat3> to_rec709(const PictureHeader& header, const ChannelPlaces& places,
                                   const std::filesystem::path& file) {
    if (places.are_xyz)
        return glm::mat3(glm::inverse(xyz_from_rgb(rec709_primaries)));
    // Some programs write zeros for what they do not know.
    if (!header.primaries || *header.primaries == std::array<double, 8>{})
        return std::nullopt;
    const auto& p = *header.primaries;
    const RgbPrimaries own{{p[0], p[1]}, {p[2], p[3]}, {p[4], p[5]}, {p[6], p[7]}};
    if (!are_primaries(own))
        throw InputError(
            fmt::format("{}: says of its colours that red, green, blue and white stand at x, y = {}, "
                        "which is no space of colours; correct or remove its chromaticities",
                        file.string(), fmt::join(p, ", ")));
    const auto is_near = [](glm::dvec2 a, glm::dvec2 b) { return glm::distance(a, b) < 2e-4; };
    const RgbPrimaries& rec709 = rec709_primaries;
    if (is_near(own.red, rec709.red) && is_near(own.green, rec709.green) && is_near(own.blue, rec709.blue) &&
        is_near(own.white, rec709.white))
        return std::nullopt;
    return glm::mat3(rec709_from(own));
}

void read_opened(const std::filesystem::path& file, FrameEncoding encoding, FileColours colours,
                 LinearImage& into) {
    PictureFile picture = opened(file);
    const PictureHeader& header = picture.header();
    const ChannelPlaces places = places_in(header, file);
    into.size_px = header.size_px;
    into.pixels.resize(static_cast<std::size_t>(header.size_px.x) *
                       static_cast<std::size_t>(header.size_px.y));
    ValueFacts facts;
    if (places.are_rgba()) {
        facts = read_values(picture, places, values_of(into));
    } else {
        thread_local std::vector<float> values;
        values.resize(into.pixels.size() * static_cast<std::size_t>(places.channels));
        facts = read_values(picture, places, values);
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
        if (bad != into.pixels.end())
            refuse_value(file, *bad, static_cast<int>(bad - into.pixels.begin()), header);
    }
    if (encoding == FrameEncoding::srgb)
        decode_srgb(into, facts.are_codes);
    if (const auto matrix =
            colours == FileColours::as_rec709 ? to_rec709(header, places, file) : std::nullopt) {
        for (glm::vec4& pixel : into.pixels)
            pixel = glm::vec4(*matrix * glm::vec3(pixel), pixel.w);
    }
    const int* const straight = header.attribute<int>("oiio:UnassociatedAlpha");
    if (places.of[3] >= 0 && straight && *straight != 0) {
        for (glm::vec4& pixel : into.pixels)
            pixel = glm::vec4(glm::vec3(pixel) * pixel.w, pixel.w);
    }
}

} // namespace

LinearImage read_linear_image(const std::filesystem::path& file, FrameEncoding encoding,
                              FileColours colours) {
    LinearImage image;
    read_linear_image(file, encoding, colours, image);
    return image;
}

void read_linear_image(const std::filesystem::path& file, FrameEncoding encoding, FileColours colours,
                       LinearImage& into) {
    with_memory_for(file, [&] { read_opened(file, encoding, colours, into); });
}

glm::ivec2 image_size_px(const std::filesystem::path& file) { return opened(file).header().size_px; }

bool has_alpha(const std::filesystem::path& file) {
    return places_in(opened(file).header(), file).of[3] >= 0;
}

bool has_other_primaries(const std::filesystem::path& file) {
    const PictureFile picture = opened(file);
    const PictureHeader& header = picture.header();
    return to_rec709(header, places_in(header, file), file).has_value();
}

void write_linear_exr(const std::filesystem::path& file, const LinearImage& image,
                      const ImageAttributes& attributes) {
    PictureHeader header{
        image.size_px, {"R", "G", "B", "A"}, PixelType::float32, 3, {{"compression", "pxr24"}}};
    header.attributes.insert(header.attributes.end(), attributes.begin(), attributes.end());
    write_picture(file, header, PixelType::float32, image.pixels.data());
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
    const PictureHeader header{
        image.size_px, {"R", "G", "B"}, PixelType::bits8, -1, {{"oiio:ColorSpace", "sRGB"}}};
    write_picture(file, header, PixelType::bits8, bytes.data());
}

} // namespace overt
