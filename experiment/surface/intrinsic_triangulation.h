/// Triangles by the lengths of their edges alone, with edges chosen so that heat flows from warm to cold.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace overt {

/// The surface of a mesh, cut into other triangles between the same nodes: an intrinsic Delaunay
/// triangulation (Bobenko and Springborn 2007). The cotangent weights of a mesh are negative across edges
/// whose opposite angles sum to more than 180 degrees, and then heat can flow from cold to warm and densities
/// fall below zero. Exchanging such an edge for the other diagonal of its two triangles, laid flat, leaves
/// all distances on the surface as they are and ends with weights that are all >= 0. (Setting negative
/// weights to 0 instead would keep the mesh's edges but make the surface stiffer where its triangles are
/// long.) Edges of three and more triangles, and such between triangles whose fronts disagree, cannot be
/// exchanged; there a negative weight is set to 0.
///
/// Triangles without area have no angles: all edges are first made longer by the same length, at most 1e-5 of
/// the mean edge, so that in each triangle two sides exceed the third (intrinsic mollification, Sharp and
/// Crane 2020, "A Laplacian for nonmanifold triangle meshes"). Nothing is added where all triangles have
/// area.
class IntrinsicTriangulation {
  public:
    IntrinsicTriangulation() = default;
    /// `triangles`: three different nodes each.
    IntrinsicTriangulation(std::span<const glm::dvec3> positions_mm, std::span<const glm::uvec3> triangles);

    struct Triangle {
        std::array<std::uint32_t, 3> nodes{};
        std::array<double, 3> lengths_mm{}; ///< of the side from corner k to corner k + 1
    };
    std::span<const Triangle> triangles() const { return triangles_; }

    /// A triangle at a node: which, and at which of its corners.
    struct Corner {
        std::uint32_t triangle;
        std::uint32_t corner;
    };
    std::span<const Corner> corners_at(std::uint32_t node) const;

    /// Half the sum of the cotangents opposite each edge, >= 0: two nodes and the weight, once for each edge.
    struct EdgeWeight {
        std::uint32_t a, b;
        double weight;
    };
    std::vector<EdgeWeight> edge_weights() const;

    /// Edges that were exchanged.
    std::size_t exchanged() const { return exchanged_; }

  private:
    /// 3 triangle + side of the same edge in the neighbouring triangle; or none, or fixed.
    static constexpr std::uint32_t none = ~std::uint32_t{0};
    static constexpr std::uint32_t fixed = none - 1;

    void lengthen_edges();
    void find_mates(std::size_t nodes);
    void exchange_edges();
    void exchange(std::uint32_t side);
    double cotangent_opposite(std::uint32_t side) const;
    void sort_corners(std::size_t nodes);

    std::vector<Triangle> triangles_;
    std::vector<std::uint32_t> mates_; ///< by 3 triangle + side
    std::vector<std::size_t> corners_begin_;
    std::vector<Corner> corners_;
    std::size_t exchanged_ = 0;
};

} // namespace overt
