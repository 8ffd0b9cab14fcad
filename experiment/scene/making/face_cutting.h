/// Faces of more than three corners as triangles.
#pragma once

#include <cstdint>
#include <vector>

#include "experiment/scene/making/raw_mesh.h"

namespace overt {

/// Takes the faces of a mesh that is being read, corner by corner, before all of its vertices need to be
/// known. A face of n corners becomes n - 2 triangles, one after another.
///
/// Each is first a fan about its first corner, and a convex face stays one. A concave one is cut along its
/// diagonals by clipping ears, in the coordinate plane that it lies in most (exactly: orientation.h),
/// beginning at the corner with the lowest number, so that it becomes the same triangles at whichever corner
/// its list begins. Corners on a straight edge are kept where any triangle with an area can be made of them,
/// so that neighbours still share all edges; corners at one place give triangles without area. A face whose
/// outline crosses itself stays a fan, and is counted in RawMesh::crossing_faces.
class FaceFans {
  public:
    /// The mesh must outlive it; its triangles are added there.
    explicit FaceFans(RawMesh& mesh) : mesh_(&mesh) {}

    void begin_face() { corners_ = 0; }
    void add_corner(std::uint32_t vertex);

    /// Cuts what is not convex, once all vertices are known. Every vertex of a face must have finite
    /// coordinates.
    void cut();

  private:
    struct Fan {
        std::uint32_t first_triangle, corners;
    };

    RawMesh* mesh_;
    std::uint32_t corners_ = 0;
    std::uint32_t first_ = 0, previous_ = 0;
    std::vector<Fan> fans_; ///< of more than three corners
};

} // namespace overt
