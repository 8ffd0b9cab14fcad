/// The hidden map of one pose: which triangle is nearest at each pixel's centre. With the mesh and the camera
/// it is the exact coordinate-encoded look-up table, at a quarter of the size of float coordinates.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "experiment/base/content_hash.h"
#include "experiment/units.h"

namespace overt {

struct TriangleMap {
    glm::ivec2 size_px{0};
    std::vector<std::uint32_t> codes; ///< triangle index + 1, 0 off the object; top row first

    /// Code at a pixel; 0 outside the image.
    std::uint32_t code_at(int x, int y) const {
        if (x < 0 || y < 0 || x >= size_px.x || y >= size_px.y)
            return 0;
        return codes[static_cast<std::size_t>(y) * static_cast<std::size_t>(size_px.x) +
                     static_cast<std::size_t>(x)];
    }

    /// Number of pixels on the object.
    std::size_t covered_pixels() const;
};

/// Text attributes kept with a map: mesh_sha256, camera, angle_deg. The hash of its codes is one, too.
using MapAttributes = std::vector<std::pair<std::string, std::string>>;

/// Writes an EXR file with one 32-bit unsigned channel, "triangle" (code as above), losslessly compressed; at
/// once or not at all. Throws RecordError.
void write_triangle_map(const std::filesystem::path& file, const TriangleMap& map,
                        const MapAttributes& attributes);

/// Whether the file is a map, whole, with the hash of its triangles (maps of early programs have none), that
/// says to be of this mesh at this angle; a mesh or angle that it does not say counts as said.
bool is_map_of(const std::filesystem::path& file, const ContentHash& mesh, Degrees angle);

/// Throws InputError if the file is missing or is no such map, and if its codes are not those that it was
/// written with.
TriangleMap read_triangle_map(const std::filesystem::path& file);

} // namespace overt
