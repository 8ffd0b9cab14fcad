#include "experiment/surface/volume_file.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <string>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/number_text.h"
#include "experiment/base/whole_file.h"

namespace overt {

void write_nrrd(const std::filesystem::path& path, const VoxelDensity& voxels, std::string_view unit,
                std::string_view meaning) {
    const glm::ivec3 cells = voxels.cells();
    const glm::dvec3 origin = voxels.origin();
    const double side = voxels.cell_side();
    std::string text = fmt::format("NRRD0004\n"
                                   "# Gaussian of standard deviation {0} {1}\n"
                                   "content: {2}\n"
                                   "type: float\n"
                                   "dimension: 3\n"
                                   "space dimension: 3\n"
                                   "sizes: {3} {4} {5}\n"
                                   "space directions: ({6},0,0) (0,{6},0) (0,0,{6})\n"
                                   "space origin: ({7},{8},{9})\n"
                                   "space units: \"{1}\" \"{1}\" \"{1}\"\n"
                                   "kinds: space space space\n"
                                   "endian: little\n"
                                   "encoding: raw\n\n",
                                   voxels.sigma(), unit, meaning, cells.x, cells.y, cells.z, side, origin.x,
                                   origin.y, origin.z);
    text.reserve(text.size() + 4 * voxels.values().size());
    for (const double value : voxels.values()) {
        const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(value));
        for (int byte = 0; byte < 4; ++byte)
            text += static_cast<char>(bits >> 8 * byte & 0xff);
    }
    write_whole_file(path, text);
}

void write_cube_table(const std::filesystem::path& path, const VoxelDensity& voxels, const Bounds& bounds,
                      double most, int side, std::string_view title, std::string_view meaning) {
    OVERT_EXPECTS(side >= 2 && side <= 256);
    std::string quoted(title);
    std::replace_if(
        quoted.begin(), quoted.end(), [](char c) { return c == '"' || c == '\n' || c == '\r'; }, ' ');
    std::string text =
        fmt::format("TITLE \"{}\"\n"
                    "# 1 stands for {} {}\n"
                    "# (0, 0, 0) is the object coordinate ({}, {}, {}), (1, 1, 1) is ({}, {}, {})\n"
                    "LUT_3D_SIZE {}\n"
                    "DOMAIN_MIN 0.0 0.0 0.0\n"
                    "DOMAIN_MAX 1.0 1.0 1.0\n",
                    quoted, most, meaning, bounds.min.x, bounds.min.y, bounds.min.z, bounds.max.x,
                    bounds.max.y, bounds.max.z, side);
    // Red, which is x, runs fastest.
    for (int blue = 0; blue < side; ++blue) {
        for (int green = 0; green < side; ++green) {
            for (int red = 0; red < side; ++red) {
                const glm::dvec3 share = glm::dvec3(red, green, blue) / static_cast<double>(side - 1);
                const double value =
                    most > 0.0 ? voxels.at(bounds.min + share * bounds.extent()) / most : 0.0;
                const std::size_t begin = text.size();
                append_fixed(text, std::clamp(value, 0.0, 1.0), 6);
                const std::string number = text.substr(begin);
                text += ' ';
                text += number;
                text += ' ';
                text += number;
                text += '\n';
            }
        }
    }
    write_whole_file(path, text);
}

} // namespace overt
