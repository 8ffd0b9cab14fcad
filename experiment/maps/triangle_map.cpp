#include "experiment/maps/triangle_map.h"

#include <algorithm>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/memory_for.h"
#include "experiment/pictures/picture_file.h"

namespace overt {

std::size_t TriangleMap::covered_pixels() const {
    return static_cast<std::size_t>(
        std::count_if(codes.begin(), codes.end(), [](std::uint32_t code) { return code != 0; }));
}

void write_triangle_map(const std::filesystem::path& file, const TriangleMap& map,
                        const MapAttributes& attributes) {
    PictureHeader header{map.size_px, {"triangle"}, PixelType::bits32, -1, {{"compression", "zip"}}};
    for (const auto& [name, value] : attributes)
        header.attributes.emplace_back("overt:" + name, value);
    write_picture(file, header, PixelType::bits32, map.codes.data());
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
    return map;
}

} // namespace overt
