/// How the surface of an OBJ file looks: places on pictures, colours of vertices and materials, while the
/// file is read.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiment/scene/files/mesh_text.h"
#include "experiment/scene/files/mtl_reader.h"
#include "experiment/scene/making/raw_mesh.h"

namespace overt {

/// Hears what the reader comes by, in the order of the file. What is wrong throws InputError at the text's
/// place.
class ObjLook {
  public:
    /// The text must outlive it. Without `is_wanted` only the names of materials are kept.
    ObjLook(const MeshText& text, bool is_wanted) : text_(text), is_wanted_(is_wanted) {}

    bool is_wanted() const { return is_wanted_; }

    /// A line `vt`, of which u is to the right and v up.
    void add_place(double u, double v) { places_.emplace_back(u, 1.0 - v); }
    /// The colour of the vertex of that number, in codes of sRGB as shares.
    void add_vertex_colour(std::size_t vertex, glm::vec3 srgb);
    /// A line `mtllib`: the names of files, or one name with blanks.
    void add_libraries(std::string_view names);
    /// A line `usemtl`.
    void use_material(std::string_view name);

    void begin_face();
    /// `word`: v, v/vt, v//vn or v/vt/vn, of which v is `vertex`.
    void add_corner(std::uint32_t vertex, std::string_view word);
    /// The face became all triangles from that of `first` on.
    void end_face(std::size_t first, std::size_t triangles);

    /// Gives the mesh what was heard, once its faces are cut.
    void finish(RawMesh& mesh, const MeshSource& source);

  private:
    struct Corner {
        std::uint32_t vertex;
        std::int64_t place; ///< number of its `vt` from 0; -1: none
    };
    struct Face {
        std::size_t first_triangle, first_corner;
    };

    void give_materials(RawMesh& mesh, const MeshSource& source);
    void give_uvs(RawMesh& mesh) const;
    void give_colours(RawMesh& mesh) const;

    const MeshText& text_;
    bool is_wanted_;
    std::vector<glm::dvec2> places_;
    std::vector<Corner> corners_;
    std::vector<Face> faces_;
    std::int64_t highest_place_ = -1;
    TextPlace highest_at_;
    std::vector<glm::vec3> colours_; ///< of vertices, linear; NaN: none
    std::vector<std::pair<std::string, TextPlace>> libraries_;
    std::map<std::string, std::uint16_t> numbers_; ///< of materials by name
    std::vector<std::string> names_;
    std::vector<std::uint16_t> triangle_materials_;
    std::optional<std::uint16_t> material_;
};

} // namespace overt
