#include "experiment/maps/triangle_map.h"

#include <algorithm>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/memory_for.h"
#include "experiment/pictures/picture_file.h"
#include "experiment/pictures/whole_exr.h"

namespace overt {
namespace {

constexpr const char* const codes_attribute = "overt:codes_sha256";

ContentHash hash_of_codes(const TriangleMap& map) {
    ContentHasher hasher;
    hasher.add(map.size_px.x).add(map.size_px.y).add(map.codes);
    return hasher.finish();
}

} // namespace

std::size_t TriangleMap::covered_pixels() const {
    return static_cast<std::size_t>(
        std::count_if(codes.begin(), codes.end(), [](std::uint32_t code) { return code != 0; }));
}

void write_triangle_map(const std::filesystem::path& file, const TriangleMap& map,
                        const MapAttributes& attributes) {
    PictureHeader header{map.size_px, {"triangle"}, PixelType::bits32, -1, {{"compression", "zip"}}};
    for (const auto& [name, value] : attributes)
        header.attributes.emplace_back("overt:" + name, value);
    header.attributes.emplace_back(codes_attribute, hash_of_codes(map));
    write_picture(file, header, PixelType::bits32, map.codes.data());
}

bool is_map_of(const std::filesystem::path& file, const ContentHash& mesh, Degrees angle) {
    if (!is_whole_exr(file))
        return false;
    try {
        const PictureFile picture(file, "map");
        const std::string of_mesh = picture.header().text("overt:mesh_sha256"),
                          at_angle = picture.header().text("overt:angle_deg");
        // A map of a program that wrote no hash of the triangles has other bytes than one drawn anew.
        return !picture.header().text(codes_attribute).empty() && (of_mesh.empty() || of_mesh == mesh) &&
               (at_angle.empty() || at_angle == fmt::format("{}", angle.value));
    } catch (const InputError&) {
        return false;
    }
}

TriangleMap read_triangle_map(const std::filesystem::path& file) {
    PictureFile picture(file, "map");
    const PictureHeader& header = picture.header();
    if (header.channels != std::vector<std::string>{"triangle"} || header.type != PixelType::bits32) {
        throw InputError(fmt::format("{}: is no map of triangle numbers (one 32-bit channel \"triangle\")",
                                     file.string()));
    }
    TriangleMap map{header.size_px, {}};
    with_memory_for(file, [&] {
        map.codes.resize(static_cast<std::size_t>(header.size_px.x) *
                         static_cast<std::size_t>(header.size_px.y));
    });
    picture.read(1, PixelType::bits32, map.codes.data());
    const std::string said = header.text(codes_attribute);
    if (!said.empty() && said != hash_of_codes(map))
        throw InputError(
            fmt::format("{}: has other triangles than it was written with: it is damaged, or was "
                        "changed",
                        file.string()));
    return map;
}

} // namespace overt
