#include "experiment/maps/coordinate_image_file.h"

#include <algorithm>
#include <cmath>

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/memory_for.h"
#include "experiment/maps/coordinate_codec.h"
#include "experiment/maps/picture_file.h"

namespace overt {

namespace {

/// A renderer's mean of full samples may fall short of 1 by its rounding.
constexpr double full_coverage = 0.9999;

constexpr OIIO::TypeDesc double_triple(OIIO::TypeDesc::DOUBLE, OIIO::TypeDesc::VEC3);

void put_triple(OIIO::ImageSpec& spec, const char* name, const glm::dvec3& vector) {
    const double values[] = {vector.x, vector.y, vector.z};
    spec.attribute(name, double_triple, values);
}

void put_double(OIIO::ImageSpec& spec, const char* name, double value) {
    spec.attribute(name, OIIO::TypeDesc::DOUBLE, &value);
}

void put_text(OIIO::ImageSpec& spec, const char* name, const std::string& text) {
    if (!text.empty())
        spec.attribute(name, text);
}

void put_description(OIIO::ImageSpec& spec, const MapDescription& description) {
    put_text(spec, "overt:sculpture", description.sculpture);
    put_text(spec, "overt:mesh_sha256", description.mesh_sha256);
    put_text(spec, "overt:unit", description.unit);
    if (description.bounds) {
        put_triple(spec, "overt:bounds_min", description.bounds->min);
        put_triple(spec, "overt:bounds_max", description.bounds->max);
    }
    if (description.camera) {
        put_triple(spec, "overt:camera_position", description.camera->position);
        put_triple(spec, "overt:camera_target", description.camera->target);
        put_double(spec, "overt:camera_vertical_fov_deg", description.camera->vertical_fov.value);
    }
    if (description.angle)
        put_double(spec, "overt:angle_deg", description.angle->value);
    if (description.frame)
        spec.attribute("overt:frame", *description.frame);
}

std::optional<glm::dvec3> triple(const OIIO::ImageSpec& spec, const char* name) {
    const OIIO::ParamValue* found = spec.find_attribute(name);
    // Whether it calls itself a vector or three numbers does not matter.
    if (!found || found->type().basetype != OIIO::TypeDesc::DOUBLE || found->type().basevalues() != 3)
        return std::nullopt;
    const auto* values = static_cast<const double*>(found->data());
    return glm::dvec3(values[0], values[1], values[2]);
}

std::optional<double> real(const OIIO::ImageSpec& spec, const char* name) {
    const OIIO::ParamValue* found = spec.find_attribute(name, OIIO::TypeDesc::DOUBLE);
    return found ? std::optional(*static_cast<const double*>(found->data())) : std::nullopt;
}

MapDescription description_in(const OIIO::ImageSpec& spec) {
    MapDescription description;
    description.sculpture = spec.get_string_attribute("overt:sculpture");
    description.mesh_sha256 = spec.get_string_attribute("overt:mesh_sha256");
    description.unit = spec.get_string_attribute("overt:unit");
    const auto low = triple(spec, "overt:bounds_min"), high = triple(spec, "overt:bounds_max");
    if (low && high)
        description.bounds = Bounds{*low, *high};
    const auto position = triple(spec, "overt:camera_position"), target = triple(spec, "overt:camera_target");
    const auto field = real(spec, "overt:camera_vertical_fov_deg");
    if (position && target && field)
        description.camera = Camera{*position, *target, {*field}};
    if (const auto angle = real(spec, "overt:angle_deg"))
        description.angle = Degrees{*angle};
    if (const OIIO::ParamValue* frame = spec.find_attribute("overt:frame", OIIO::TypeDesc::INT))
        description.frame = *static_cast<const int*>(frame->data());
    return description;
}

bool agree(const Bounds& a, const Bounds& b) { return a.min == b.min && a.max == b.max; }
bool agree(int a, int b) { return a == b; }
bool agree(const Camera& a, const Camera& b) {
    return a.position == b.position && a.target == b.target && a.vertical_fov.value == b.vertical_fov.value;
}
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
    for (auto text : {&MapDescription::sculpture, &MapDescription::unit, &MapDescription::mesh_sha256}) {
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

Channels channels_of(const std::filesystem::path& file, const OIIO::ImageSpec& spec) {
    const auto index = [&](std::string_view name) {
        const auto found = std::find(spec.channelnames.begin(), spec.channelnames.end(), name);
        return found == spec.channelnames.end() ? -1 : static_cast<int>(found - spec.channelnames.begin());
    };
    const std::array<int, 3> xyz{index("X"), index("Y"), index("Z")}, rgb{index("R"), index("G"), index("B")};
    const auto complete = [](const std::array<int, 3>& three) {
        return std::all_of(three.begin(), three.end(), [](int channel) { return channel >= 0; });
    };
    const bool is_float = spec.format == OIIO::TypeDesc::FLOAT;
    if (is_float && complete(xyz))
        return {Channels::Kind::coordinates, xyz, index("A"), index("part")};
    if (is_float && complete(rgb))
        return {Channels::Kind::shares, rgb, index("A")};
    if (spec.format == OIIO::TypeDesc::UINT16 && complete(rgb))
        return {Channels::Kind::codes, rgb, index("A")};
    throw InputError(fmt::format("{}: is no map of coordinates, which has the channels X, Y, Z or R, G, B of "
                                 "32-bit floats, or red, green and blue of 16 bits; it has {} of type {}",
                                 file.string(), fmt::join(spec.channelnames, ", "), spec.format.c_str()));
}

/// The codec of a map of codes or shares. Throws InputError if what it needs is not known.
CoordinateCodec codec_of(const std::filesystem::path& file, Channels::Kind kind,
                         const MapDescription& description) {
    const bool needs_scale = kind == Channels::Kind::codes;
    if (!description.bounds || (needs_scale && !description.scale)) {
        throw InputError(fmt::format(
            "{}: its colours mean nothing without {}: put them into {} beside it, as \"bounds\": {{\"min\": "
            "[x, y, z], \"max\": [x, y, z]}}{}, or give lut_min, lut_max{} with the sculpture",
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
    OIIO::ImageSpec spec;
    std::vector<float> values;        ///< of a file of floats
    std::vector<std::uint16_t> codes; ///< of a file of 16 bits
};

Raw read_opened(const std::filesystem::path& file) {
    OIIO::ImageSpec wish;
    // Colours as they stand: multiplying them by alpha would move the places.
    wish.attribute("oiio:UnassociatedAlpha", 1);
    const auto input = open_picture(file, "map", &wish);
    Raw raw{input->spec(), {}, {}};
    const std::size_t count = static_cast<std::size_t>(raw.spec.width) *
                              static_cast<std::size_t>(raw.spec.height) *
                              static_cast<std::size_t>(raw.spec.nchannels);
    const bool is_code = raw.spec.format == OIIO::TypeDesc::UINT16;
    void* into = nullptr;
    if (is_code) {
        raw.codes.resize(count);
        into = raw.codes.data();
    } else {
        raw.values.resize(count);
        into = raw.values.data();
    }
    // Each file is read by one thread: several are read at once.
    input->threads(1);
    if (!input->read_image(0, 0, 0, raw.spec.nchannels,
                           is_code ? OIIO::TypeDesc::UINT16 : OIIO::TypeDesc::FLOAT, into)) {
        throw InputError(fmt::format("{}: reading the map failed: {}", file.string(), input->geterror()));
    }
    return raw;
}

Raw read_raw(const std::filesystem::path& file) {
    return with_memory_for(file, [&] { return read_opened(file); });
}

[[noreturn]] void refuse_value(const std::filesystem::path& file, const OIIO::ImageSpec& spec, std::size_t i,
                               const char* why) {
    const int index = static_cast<int>(i);
    throw InputError(fmt::format("{}: pixel ({}, {}) holds {}", file.string(), index % spec.width,
                                 index / spec.width, why));
}

} // namespace

void write_coordinate_exr(const std::filesystem::path& file, const CoordinateImage& image,
                          const MapDescription& description) {
    OIIO::ImageSpec spec(image.size_px.x, image.size_px.y, 4, OIIO::TypeDesc::FLOAT);
    spec.channelnames = {"X", "Y", "Z", "A"};
    spec.attribute("compression", "zip");
    put_description(spec, description);
    if (image.parts.empty()) {
        write_picture(file, spec, OIIO::TypeDesc::FLOAT, image.pixels.data());
        return;
    }
    OVERT_EXPECTS(image.parts.size() == image.pixels.size());
    spec.nchannels = 5;
    spec.channelnames.emplace_back("part");
    std::vector<float> values;
    values.reserve(5 * image.pixels.size());
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const glm::vec4& pixel = image.pixels[i];
        values.insert(values.end(), {pixel.x, pixel.y, pixel.z, pixel.w, static_cast<float>(image.parts[i])});
    }
    write_picture(file, spec, OIIO::TypeDesc::FLOAT, values.data());
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
    OIIO::ImageSpec spec(image.size_px.x, image.size_px.y, 4, OIIO::TypeDesc::UINT16);
    spec.attribute("oiio:UnassociatedAlpha", 1);
    spec.attribute("png:compressionLevel", 3);
    MapDescription beside = description;
    beside.size_px = image.size_px;
    write_sidecar(sidecar_of(file), beside);
    write_picture(file, spec, OIIO::TypeDesc::UINT16, codes.data());
}

MapDescription read_map_description(const std::filesystem::path& file) {
    return description_in(open_picture(file, "map")->spec());
}

CoordinateImageFile read_coordinate_image(const std::filesystem::path& file, const MapDescription& known) {
    const Raw raw = read_raw(file);
    const Channels channels = channels_of(file, raw.spec);
    CoordinateImageFile map{CoordinateImage({raw.spec.width, raw.spec.height}), description_in(raw.spec), 0};
    if (const auto beside = read_sidecar(sidecar_of(file)))
        merge(file, map.description, *beside);
    merge(file, map.description, known);
    merge(file, "size", map.description.size_px, std::optional(map.image.size_px));
    std::optional<CoordinateCodec> codec;
    if (channels.kind != Channels::Kind::coordinates)
        codec.emplace(codec_of(file, channels.kind, map.description));

    const std::size_t stride = static_cast<std::size_t>(raw.spec.nchannels);
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
                refuse_value(file, raw.spec, i, "a value that is not a finite number");
            place = triple;
            if (codec && coverage >= full_coverage) {
                // Rounding may go beyond the box by the last bits of a float.
                if (glm::any(glm::lessThan(triple, glm::dvec3(-1e-5))) ||
                    glm::any(glm::greaterThan(triple, glm::dvec3(1.0 + 1e-5))))
                    refuse_value(file, raw.spec, i, "a share of the bounding box that is not within 0 … 1");
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
