/// A mesh as a surface that things spread over: areas, neighbours, lengths in millimetres.
#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "experiment/scene/mesh.h"
#include "experiment/surface/intrinsic_triangulation.h"

namespace overt {

/// A place on a mesh.
struct SurfacePlace {
    std::uint32_t triangle = 0;  ///< index into Mesh::triangles
    glm::dvec3 barycentric{0.0}; ///< weights of its corners, >= 0, sum 1
};

/// Something that is at a place, and how wide it is to be spread.
struct SurfaceWeight {
    SurfacePlace place;
    double weight = 1.0;   ///< >= 0: a count, or milliseconds
    double sigma_mm = 0.0; ///< standard deviation along each direction on the surface
};

/// May be read from any thread once it is made.
///
/// Meshes from scanners and editors are not always clean. Vertices at the very same position are one node
/// here, so that a seam of duplicate vertices does not cut the surface. Triangles that name a node twice, or
/// three nodes that an earlier triangle has, are no part of the surface. Triangles without area stay in it,
/// for they hold their neighbours together. Edges of one triangle, or of three and more, are allowed.
class SurfaceGeometry {
  public:
    /// `mm_per_unit`: > 0, millimetres of one unit of the mesh.
    explicit SurfaceGeometry(const Mesh& mesh, double mm_per_unit = 1.0);

    std::size_t vertex_count() const { return node_of_vertex_.size(); }
    std::size_t node_count() const { return positions_mm_.size(); }
    std::size_t triangle_count() const { return corners_.size(); }

    std::uint32_t node_of(std::uint32_t vertex) const { return node_of_vertex_[vertex]; }
    std::span<const glm::dvec3> node_positions_mm() const { return positions_mm_; }

    /// The nodes at the corners of a triangle of the mesh.
    const glm::uvec3& corners(std::uint32_t triangle) const { return corners_[triangle]; }
    glm::dvec3 position_mm(const SurfacePlace& place) const;

    /// A third of the area of each triangle at a node; their sum is the area.
    std::span<const double> node_areas_mm2() const { return areas_mm2_; }
    double total_area_mm2() const { return total_area_mm2_; }
    /// By vertex of the mesh. Vertices of one node share its area, so the sum is the area here, too.
    std::vector<double> vertex_areas_mm2() const;

    /// Nodes that share an edge with a node, rising.
    std::span<const std::uint32_t> neighbours(std::uint32_t node) const;

    /// Triangles of the surface at a node, rising.
    std::span<const std::uint32_t> triangles_at(std::uint32_t node) const;

    /// The same nodes and lengths with edges that suit the solution of equations: made when it is first asked
    /// for, by whatever thread, since it takes longer than all else.
    const IntrinsicTriangulation& triangulation() const;

    /// Values of nodes by vertex of the mesh.
    std::vector<double> at_vertices(std::span<const double> of_nodes) const;

  private:
    std::vector<std::uint32_t> node_of_vertex_;
    std::vector<glm::dvec3> positions_mm_;
    std::vector<glm::uvec3> corners_;
    std::vector<double> areas_mm2_;
    double total_area_mm2_ = 0.0;
    std::vector<std::size_t> neighbours_begin_; ///< by node, one more at the end
    std::vector<std::uint32_t> neighbours_;
    std::vector<std::size_t> triangles_begin_; ///< by node, one more at the end
    std::vector<std::uint32_t> triangles_;
    mutable std::once_flag triangulated_;
    mutable IntrinsicTriangulation triangulation_;
};

} // namespace overt
