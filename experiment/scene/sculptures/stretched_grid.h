/// The grid that a surface is contoured on: cubes, stretched about a fovea, with a distance at each node.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "experiment/scene/sculptures/contouring.h"

namespace overt {

/// The map from the even space of the grid to the space of the solid. It pulls space together about the fovea
/// and never stretches it, so a bound on distances in grid space holds in the solid's space too.
class Stretching {
  public:
    explicit Stretching(const Fovea& fovea);

    /// Point of the solid's space, mm, for a point of grid space.
    glm::dvec3 to_solid(const glm::dvec3& grid_point) const;

    /// Box of grid space whose image covers `box_mm`.
    Bounds to_grid(const Bounds& box_mm) const;

  private:
    glm::dvec3 centre_;
    double share_;
    double inner_; ///< radius, in grid space, of the ball of full fineness
    double outer_; ///< radius from which on cells have full size
};

/// Nodes of the grid with their distances. Nodes far from the surface hold the distance of a point nearby,
/// of the right sign.
class StretchedGrid {
  public:
    /// Asks for the distance only near the surface, on request.threads threads.
    explicit StretchedGrid(const ContourRequest& request);

    glm::ivec3 size() const { return size_; } ///< nodes along each axis
    std::size_t index(const glm::ivec3& node) const {
        return (static_cast<std::size_t>(node.z) * static_cast<std::size_t>(size_.y) +
                static_cast<std::size_t>(node.y)) *
                   static_cast<std::size_t>(size_.x) +
               static_cast<std::size_t>(node.x);
    }
    float distance(const glm::ivec3& node) const { return distances_[index(node)]; }
    bool is_inside(const glm::ivec3& node) const { return distance(node) < 0.0f; }

    /// Place in the solid's space of a point given in nodes (whole numbers are nodes).
    glm::dvec3 place(const glm::dvec3& node) const;

    /// Size of the cells where they are largest, mm.
    double cell_mm() const { return cell_; }

  private:
    void sample(const ContourRequest& request, const glm::ivec3& first, int width);

    Stretching stretching_;
    glm::dvec3 origin_;
    double cell_;
    glm::ivec3 size_;
    std::vector<float> distances_;
};

} // namespace overt
