/// How the surface of a PLY file looks: colours of vertices and faces, and places on pictures, while its rows
/// are read.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "experiment/scene/files/ply_header.h"
#include "experiment/scene/making/raw_mesh.h"

namespace overt {

/// Which properties of an element are a colour and a place on a picture.
struct PlyLookColumns {
    static constexpr std::size_t none = static_cast<std::size_t>(-1);
    std::array<std::size_t, 3> colour{none, none, none};
    std::array<std::size_t, 2> place{none, none}; ///< of vertices: u to the right, v up
    std::size_t corner_places = none;             ///< of faces: a list of u and v for each corner
    std::size_t picture = none;                   ///< of faces: which of the files

    /// By the names that MeshLab, Blender and others give them.
    static PlyLookColumns of(const PlyElement& element);

    /// Which channel of the colour a property is; 3: none.
    std::size_t channel(std::size_t property) const;
};

/// What rows were found to say. Colours are codes of sRGB by habit of the programs that write them.
class PlyLook {
  public:
    /// A colour's code as a share: 255 of 8 bits and 65535 of 16 are 1; floats stand as they are.
    static float share_of(double code, PlyType type);

    void set_vertex_colour(std::uint64_t vertex, glm::vec3 share);
    void set_vertex_place(std::uint64_t vertex, glm::vec2 uv);
    /// Of the triangles from `first` on, which one face became.
    void set_face(std::size_t first, std::size_t triangles, const std::optional<glm::vec3>& colour,
                  const std::vector<float>& places, std::int64_t picture);

    /// Gives the mesh what was read, with the pictures beside the file.
    void finish(RawMesh& mesh, const MeshSource& source, const PlyHeader& header) const;

  private:
    std::vector<glm::vec3> vertex_colours_, triangle_colours_; ///< linear; NaN: none
    std::vector<glm::vec2> vertex_places_;
    std::vector<CornerUvs> corner_places_;
    std::vector<std::uint16_t> triangle_pictures_;
};

} // namespace overt
