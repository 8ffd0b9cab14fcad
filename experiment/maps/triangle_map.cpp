#include "experiment/maps/triangle_map.h"

#include <algorithm>

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/memory_for.h"
#include "experiment/maps/picture_file.h"

namespace overt {

std::size_t TriangleMap::covered_pixels() const {
    return static_cast<std::size_t>(
        std::count_if(codes.begin(), codes.end(), [](std::uint32_t code) { return code != 0; }));
}

void write_triangle_map(const std::filesystem::path& file, const TriangleMap& map,
                        const MapAttributes& attributes) {
    OIIO::ImageSpec spec(map.size_px.x, map.size_px.y, 1, OIIO::TypeDesc::UINT32);
    spec.channelnames = {"triangle"};
    spec.attribute("compression", "zip");
    for (const auto& [name, value] : attributes)
        spec.attribute("overt:" + name, value);
    write_picture(file, spec, OIIO::TypeDesc::UINT32, map.codes.data());
}

TriangleMap read_triangle_map(const std::filesystem::path& file) {
    const auto input = open_picture(file, "map");
    const OIIO::ImageSpec spec = input->spec();
    if (spec.nchannels != 1 || spec.channelnames.front() != "triangle" ||
        spec.format != OIIO::TypeDesc::UINT32) {
        throw InputError(fmt::format("{}: is no map of triangle numbers (one 32-bit channel \"triangle\")",
                                     file.string()));
    }
    TriangleMap map{{spec.width, spec.height}, {}};
    with_memory_for(file, [&] {
        map.codes.resize(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height));
    });
    input->threads(1);
    if (!input->read_image(0, 0, 0, 1, OIIO::TypeDesc::UINT32, map.codes.data())) {
        throw InputError(fmt::format("{}: reading the map failed: {}", file.string(), input->geterror()));
    }
    return map;
}

} // namespace overt
