/// A number at each vertex of a mesh file: maps that other programs made.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace overt {

struct VertexValues {
    std::vector<glm::dvec3> positions; ///< in the file's unit
    std::vector<double> values;        ///< finite
    std::string property;              ///< of the file, that they are
};

/// Reads a PLY file whose vertices have a property `saliency`, as overt writes maps, or else `density`,
/// `value`, `quality` (as MeshLab calls it), `scalar` or `intensity`, or `scalar_NAME` as CloudCompare writes
/// the first of them. Throws InputError, with the file and place, if it is no PLY file, is damaged, has no
/// such property, or a number that is not finite.
VertexValues read_vertex_values(const std::filesystem::path& path);

} // namespace overt
