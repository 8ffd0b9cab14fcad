#include "experiment/maps/coordinate_image_file.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/memory_for.h"
#include "experiment/maps/coordinate_codec.h"
#include "experiment/pictures/picture_file.h"

namespace overt {

namespace {

/// A renderer's mean of full samples may fall short of 1 by its rounding.
constexpr double full_coverage = 0.9999;

void put_text(PictureHeader& header, const char* name, const std::string& text) {
    if (!text.empty())
        header.attributes.emplace_back(name, text);
}

void put_description(PictureHeader& header, const MapDescription& description) {
    put_text(header, "overt:object", description.object);
    put_text(header, "overt:mesh_sha256", description.mesh_sha256);
    put_text(header, "overt:unit", description.unit);
    auto& attributes = header.attributes;
    if (description.bounds) {
        attributes.emplace_back("overt:bounds_min", description.bounds->min);
        attributes.emplace_back("overt:bounds_max", description.bounds->max);
    }
    if (description.camera) {
        attributes.emplace_back("overt:camera_position", description.camera->position);
        attributes.emplace_back("overt:camera_target", description.camera->target);
        attributes.emplace_back("overt:camera_vertical_fov_deg", description.camera->vertical_fov.value);
        if (description.camera->aside != 0.0)
            attributes.emplace_back("overt:camera_aside", description.camera->aside);
    }
    if (description.angle)
        attributes.emplace_back("overt:angle_deg", description.angle->value);
    if (description.frame)
        attributes.emplace_back("overt:frame", *description.frame);
    if (description.glass_index)
        attributes.emplace_back("overt:glass_index", *description.glass_index);
}

MapDescription description_in(const PictureHeader& header) {
    const auto triple = [&](const char* name) { return header.attribute<glm::dvec3>(name); };
    const auto real = [&](const char* name) { return header.attribute<double>(name); };
    MapDescription description;
    description.object = header.text("overt:object");
    if (description.object.empty())
        description.object = header.text("overt:sculpture"); // of maps that earlier versions made
    description.mesh_sha256 = header.text("overt:mesh_sha256");
    description.unit = header.text("overt:unit");
    if (const auto* low = triple("overt:bounds_min"), *high = triple("overt:bounds_max"); low && high)
        description.bounds = Bounds{*low, *high};
    const auto *const position = triple("overt:camera_position"), *const target =
                                                                      triple("overt:camera_target");
    const auto* const field = real("overt:camera_vertical_fov_deg");
    if (position && target && field)
        description.camera = Camera{
            *position, *target, {*field}, real("overt:camera_aside") ? *real("overt:camera_aside") : 0.0};
    if (const auto* const angle = real("overt:angle_deg"))
        description.angle = Degrees{*angle};
    if (const auto* const frame = header.attribute<int>("overt:frame"))
        description.frame = *frame;
    if (const auto* const index = real("overt:glass_index"))
        description.glass_index = *index;
    return description;
}

bool agree(const Bounds& a, const Bounds& b) { return a.min == b.min && a.max == b.max; }
bool agree(int a, int b) { return a == b; }
bool agree(const Camera& a, const Camera& b) { return a == b; }
bool agree(Degrees a, Degrees b) { return a.value == b.value; }
bool agree(glm::ivec2 a, glm::ivec2 b) { return a == b; }

template <class Value>
void merge(const std::filesystem::path& file, const char* what, std::optional<Value>& into,
           const std::optional<Value>& from) {
    if (into && from && !agree(*into, *from)) {
        throw InputError(
            fmt::format("{}: its {} is stated twice, and differently: in the file or its sidecar "
                        "{}, and by the protocol; take one out",
                        file.string(), what, sidecar_of(file).filename().string()));
    }
    if (!into)
        into = from;
}

void merge(const std::filesystem::path& file, MapDescription& into, const MapDescription& from) {
    merge(file, "bounding box", into.bounds, from.bounds);
    merge(file, "scale", into.scale, from.scale);
    merge(file, "camera", into.camera, from.camera);
    merge(file, "angle", into.angle, from.angle);
    merge(file, "frame", into.frame, from.frame);
    merge(file, "size", into.size_px, from.size_px);
    for (auto text : {&MapDescription::object, &MapDescription::unit, &MapDescription::mesh_sha256}) {
        if ((into.*text).empty())
            into.*text = from.*text;
    }
}

/// Which channels of a file hold what, by their names.
struct Channels {
    enum class Kind { coordinates, shares, codes } kind;
    std::array<int, 3> xyz;
    int coverage;  ///< -1 if there is none
    int part = -1; ///< likewise
};

Channels channels_of(const std::filesystem::path& file, const PictureHeader& header) {
    const std::array<int, 3> xyz{header.channel("X"), header.channel("Y"), header.channel("Z")},
        rgb{header.channel("R"), header.channel("G"), header.channel("B")};
    const auto complete = [](const std::array<int, 3>& three) {
        return std::all_of(three.begin(), three.end(), [](int channel) { return channel >= 0; });
    };
    const bool is_float = header.type == PixelType::float32;
    if (is_float && complete(xyz))
        return {Channels::Kind::coordinates, xyz, header.channel("A"), header.channel("part")};
    if (is_float && complete(rgb))
        return {Channels::Kind::shares, rgb, header.channel("A")};
    if (header.type == PixelType::bits16 && complete(rgb))
        return {Channels::Kind::codes, rgb, header.channel("A")};
    throw InputError(fmt::format("{}: is no map of coordinates, which has the channels X, Y, Z or R, G, B of "
                                 "32-bit floats, or red, green and blue of 16 bits; it has {} of type {}",
                                 file.string(), fmt::join(header.channels, ", "), header.type_name));
}

/// The codec of a map of codes or shares. Throws InputError if what it needs is not known.
CoordinateCodec codec_of(const std::filesystem::path& file, Channels::Kind kind,
                         const MapDescription& description) {
    const bool needs_scale = kind == Channels::Kind::codes;
    if (!description.bounds || (needs_scale && !description.scale)) {
        throw InputError(fmt::format(
            "{}: its colours mean nothing without {}: put them into {} beside it, as \"bounds\": {{\"min\": "
            "[x, y, z], \"max\": [x, y, z]}}{}, or give lut_min, lut_max{} with the object",
            file.string(), needs_scale ? "the bounding box and the scale" : "the bounding box",
            sidecar_of(file).filename().string(), needs_scale ? " and \"scale\": 65535" : "",
            needs_scale ? " and lut_scale" : ""));
    }
    try {
        return CoordinateCodec(*description.bounds, description.scale.value_or(CoordinateCodec::usual_scale));
    } catch (const InputError& error) {
        throw InputError(fmt::format("{}: {}", file.string(), error.what()));
    }
}

struct Raw {
    PictureHeader header;
    std::vector<float> values;        ///< of a file of floats
    std::vector<std::uint16_t> codes; ///< of a file of 16 bits
};

Raw read_opened(const std::filesystem::path& file) {
    // Multiplying colours by alpha would move the places.
    PictureFile picture(file, "map", StraightColours::as_they_stand);
    Raw raw{picture.header(), {}, {}};
    const std::size_t count = static_cast<std::size_t>(raw.header.size_px.x) *
                              static_cast<std::size_t>(raw.header.size_px.y) * raw.header.channels.size();
    if (raw.header.type == PixelType::bits16) {
        raw.codes.resize(count);
        picture.read(raw.header.channel_count(), PixelType::bits16, raw.codes.data());
    } else {
        raw.values.resize(count);
        picture.read(raw.header.channel_count(), PixelType::float32, raw.values.data());
    }
    return raw;
}

Raw read_raw(const std::filesystem::path& file) {
    return with_memory_for(file, [&] { return read_opened(file); });
}

[[noreturn]] void refuse_value(const std::filesystem::path& file, const PictureHeader& header, std::size_t i,
                               const char* why) {
    const int index = static_cast<int>(i), width = header.size_px.x;
    throw InputError(
        fmt::format("{}: pixel ({}, {}) holds {}", file.string(), index % width, index / width, why));
}

} // namespace

void write_coordinate_exr(const std::filesystem::path& file, const CoordinateImage& image,
                          const MapDescription& description) {
    PictureHeader header{
        image.size_px, {"X", "Y", "Z", "A"}, PixelType::float32, 3, {{"compression", "zip"}}};
    put_description(header, description);
    if (image.parts.empty()) {
        write_picture(file, header, PixelType::float32, image.pixels.data());
        return;
    }
    OVERT_EXPECTS(image.parts.size() == image.pixels.size());
    header.channels.emplace_back("part");
    std::vector<float> values;
    values.reserve(5 * image.pixels.size());
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const glm::vec4& pixel = image.pixels[i];
        values.insert(values.end(), {pixel.x, pixel.y, pixel.z, pixel.w, static_cast<float>(image.parts[i])});
    }
    write_picture(file, header, PixelType::float32, values.data());
}

void write_coordinate_png(const std::filesystem::path& file, const CoordinateImage& image,
                          const MapDescription& description) {
    OVERT_EXPECTS(description.bounds && description.scale);
    const CoordinateCodec codec(*description.bounds, *description.scale);
    std::vector<glm::vec<4, std::uint16_t>> codes(image.pixels.size(), glm::vec<4, std::uint16_t>(0));
    for (std::size_t i = 0; i < codes.size(); ++i) {
        if (image.pixels[i].w != 0.0f)
            codes[i] = {codec.encode(glm::dvec3(image.pixels[i])), std::uint16_t{65535}};
    }
    const PictureHeader header{image.size_px,
                               {"R", "G", "B", "A"},
                               PixelType::bits16,
                               3,
                               {{"oiio:UnassociatedAlpha", 1}, {"png:compressionLevel", 3}}};
    MapDescription beside = description;
    beside.size_px = image.size_px;
    write_sidecar(sidecar_of(file), beside);
    write_picture(file, header, PixelType::bits16, codes.data());
}

MapDescription read_map_description(const std::filesystem::path& file) {
    return description_in(PictureFile(file, "map").header());
}

CoordinateImageFile read_coordinate_image(const std::filesystem::path& file, const MapDescription& known) {
    const Raw raw = read_raw(file);
    const Channels channels = channels_of(file, raw.header);
    CoordinateImageFile map{CoordinateImage(raw.header.size_px), description_in(raw.header), 0};
    if (const auto beside = read_sidecar(sidecar_of(file)))
        merge(file, map.description, *beside);
    merge(file, map.description, known);
    merge(file, "size", map.description.size_px, std::optional(map.image.size_px));
    std::optional<CoordinateCodec> codec;
    if (channels.kind != Channels::Kind::coordinates)
        codec.emplace(codec_of(file, channels.kind, map.description));

    const std::size_t stride = raw.header.channels.size();
    std::size_t covered = 0;
    if (channels.part >= 0)
        map.image.parts.assign(map.image.pixels.size(), PartIndex{0});
    for (std::size_t i = 0; i < map.image.pixels.size(); ++i) {
        const auto code = [&](int channel) {
            return raw.codes[i * stride + static_cast<std::size_t>(channel)];
        };
        const auto value = [&](int channel) {
            return raw.values[i * stride + static_cast<std::size_t>(channel)];
        };
        const auto& [x, y, z] = channels.xyz;
        glm::dvec3 place(0.0);
        double coverage = 1.0;
        if (channels.kind == Channels::Kind::codes) {
            const CoordinateCode triple(code(x), code(y), code(z));
            place = codec->decode(triple);
            coverage =
                channels.coverage >= 0 ? code(channels.coverage) / 65535.0 : triple != CoordinateCode(0);
        } else {
            const glm::dvec3 triple(value(x), value(y), value(z));
            coverage = channels.coverage >= 0 ? double{value(channels.coverage)} : triple != glm::dvec3(0.0);
            if (!std::isfinite(triple.x + triple.y + triple.z + coverage))
                refuse_value(file, raw.header, i, "a value that is not a finite number");
            place = triple;
            if (codec && coverage >= full_coverage) {
                // Rounding may go beyond the box by the last bits of a float.
                if (glm::any(glm::lessThan(triple, glm::dvec3(-1e-5))) ||
                    glm::any(glm::greaterThan(triple, glm::dvec3(1.0 + 1e-5))))
                    refuse_value(file, raw.header, i, "a share of the bounding box that is not within 0 … 1");
                place = codec->bounds().min + glm::clamp(triple, 0.0, 1.0) * codec->bounds().extent();
            }
        }
        if (coverage >= full_coverage) {
            map.image.pixels[i] = glm::vec4(place, 1.0f);
            ++covered;
            if (channels.part >= 0)
                map.image.parts[i] = static_cast<PartIndex>(std::clamp(value(channels.part), 0.0f, 255.0f));
        } else {
            map.mixed_px += coverage > 0.0;
        }
    }
    if (covered == 0)
        throw InputError(fmt::format("{}: the map shows no surface: no pixel is covered", file.string()));
    return map;
}

} // namespace overt
