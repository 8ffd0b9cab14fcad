#include "render/stimulus/cached_frame.h"

#include <bit>
#include <vector>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/pictures/picture_file.h"
#include "experiment/pictures/whole_exr.h"

namespace overt {
namespace {

constexpr const char* const key_attribute = "overt:key";
constexpr const char* const angle_attribute = "overt:angle_deg";
constexpr const char* const pixels_attribute = "overt:pixels_sha256";
constexpr const char* const renderer_attribute = "overt:gl_renderer";

/// As PXR24 keeps a float (floatToFloat24 of OpenEXR): rounded to 15 bits behind the point, which a value
/// that was rounded before does not change.
std::uint32_t as_24_bits(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    const std::uint32_t sign = bits & 0x80000000u, exponent = bits & 0x7f800000u;
    std::uint32_t mantissa = bits & 0x007fffffu;
    if (exponent == 0x7f800000u) {
        if (mantissa == 0)
            return (sign | exponent) >> 8;
        mantissa >>= 8;
        return (sign >> 8) | (exponent >> 8) | mantissa | (mantissa == 0);
    }
    std::uint32_t rounded = ((exponent | mantissa) + (mantissa & 0x80u)) >> 8;
    if (rounded >= 0x7f8000u)
        rounded = (exponent | mantissa) >> 8;
    return (sign >> 8) | rounded;
}

std::string text_of_angle(Degrees angle) { return fmt::format("{}", angle.value); }

std::optional<std::string> why_header_is_no_frame(const PictureHeader& header, const FrameIdentity& identity,
                                                  bool must_say_all) {
    const std::string key = header.text(key_attribute), angle = header.text(angle_attribute);
    if ((must_say_all && (key.empty() || header.text(pixels_attribute).empty())) || angle.empty())
        return "does not say what it is";
    if (!key.empty() && key != identity.key)
        return "is a frame of something else";
    if (angle != text_of_angle(identity.object.angle) ||
        header.text(move_attribute) != text_of_move(identity.object))
        return fmt::format("is the frame at {} degrees", angle);
    return std::nullopt;
}

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& why) {
    throw InputError(
        fmt::format("{}: this file of the cache {}: remove it, so that it is made anew", file.string(), why));
}

} // namespace

std::string text_of_move(const ObjectPose& object) {
    const auto& [angle, tilt, shift] = object;
    return object.is_turn() ? std::string()
                            : fmt::format("{} {} {} {} {} {} {}", tilt.w, tilt.x, tilt.y, tilt.z, shift.x,
                                          shift.y, shift.z);
}

void add_object(ContentHasher& hasher, const ObjectPose& object) {
    hasher.add(object.angle.value);
    if (!object.is_turn())
        hasher.add(std::string_view(text_of_move(object)));
}

ContentHash hash_of_pixels(const LinearImage& image) {
    ContentHasher hasher;
    hasher.add(image.size_px.x).add(image.size_px.y);
    const auto columns = static_cast<std::size_t>(image.size_px.x);
    std::vector<std::uint32_t> row(4 * columns);
    for (std::size_t first = 0; first < image.pixels.size(); first += columns) {
        for (std::size_t x = 0; x < columns; ++x)
            for (int channel = 0; channel < 4; ++channel)
                row[4 * x + static_cast<std::size_t>(channel)] = as_24_bits(image.pixels[first + x][channel]);
        hasher.add_bytes(std::as_bytes(std::span(row)));
    }
    return hasher.finish();
}

void write_cached_frame(const std::filesystem::path& file, const LinearImage& image,
                        const FrameIdentity& identity, ImageAttributes attributes) {
    attributes.emplace_back(key_attribute, identity.key);
    attributes.emplace_back(pixels_attribute, hash_of_pixels(image));
    write_linear_exr(file, image, attributes);
}

std::optional<std::string> why_no_frame(const std::filesystem::path& file, const FrameIdentity& identity,
                                        bool must_say_all) {
    if (!is_whole_exr(file))
        return "is not whole";
    try {
        return why_header_is_no_frame(PictureFile(file, "frame").header(), identity, must_say_all);
    } catch (const InputError&) {
        return "is no picture that can be read";
    }
}

ContentHash pixels_hash_of(const std::filesystem::path& file, const FrameIdentity& identity) {
    const PictureHeader header = PictureFile(file, "frame").header();
    if (ContentHash said = header.text(pixels_attribute); !said.empty())
        return said;
    const LinearImage image = read_linear_image(file);
    ImageAttributes attributes;
    for (const auto& [name, value] : header.attributes)
        if (const auto* text = std::get_if<std::string>(&value);
            text && name.starts_with("overt:") && name != key_attribute)
            attributes.emplace_back(name, *text);
    try {
        write_cached_frame(file, image, identity, std::move(attributes));
    } catch (const RecordError&) {
        // A cache that is read only: the pixels are read each time.
    }
    return hash_of_pixels(image);
}

void read_cached_frame(const std::filesystem::path& file, const FrameIdentity& identity, LinearImage& into) {
    const PictureHeader header = PictureFile(file, "frame").header();
    if (const auto why_not = why_header_is_no_frame(header, identity, false))
        refuse(file, *why_not);
    read_linear_image(file, FrameEncoding::linear, FileColours::as_they_stand, into);
    const std::string said = header.text(pixels_attribute);
    if (!said.empty() && said != hash_of_pixels(into))
        refuse(file, "has other pixels than it was written with");
}

std::string renderer_of_frame(const std::filesystem::path& file) {
    return PictureFile(file, "frame").header().text(renderer_attribute);
}

} // namespace overt
