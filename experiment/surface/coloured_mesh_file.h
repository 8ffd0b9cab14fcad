/// A mesh with a value at each vertex, as files that other programs show in colour.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "experiment/scene/mesh.h"

namespace overt {

struct ColouredMesh {
    const Mesh& mesh;
    std::span<const float> values;                     ///< by vertex
    std::span<const std::array<std::uint8_t, 3>> srgb; ///< by vertex
    std::string title;
    double scale = 1.0; ///< of the file's lengths: what a unit of the mesh is in the file
    /// What a reader must know of the colours: name and text, such as unit, scale, grey.
    std::vector<std::pair<std::string, std::string>> legend;
};

/// Writes glTF 2.0, binary: positions, which `scale` has to make metres, with +y up as glTF has it, colours
/// as COLOR_0 (linear light, 16 bits), values as _SALIENCY, the legend in `extras`, and an unlit material
/// (KHR_materials_unlit), so that a colour on the screen is one of the legend. Throws RecordError; the mesh
/// must have triangles.
void write_glb(const std::filesystem::path& path, const ColouredMesh& coloured);

/// Writes binary PLY with x y z, red green blue (sRGB, as MeshLab and Blender take them) and `saliency` of
/// each vertex, the legend as comments. Throws RecordError.
void write_coloured_ply(const std::filesystem::path& path, const ColouredMesh& coloured);

} // namespace overt
