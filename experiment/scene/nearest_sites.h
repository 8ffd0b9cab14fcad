/// The nearest places of a surface, for many positions.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include <glm/glm.hpp>

#include "experiment/scene/mesh.h"
#include "experiment/scene/surface_sites.h"

namespace overt {

/// Finds what nearest_site() finds, by a tree: the answer is that of looking at every triangle in double
/// precision. May be asked from any number of threads at once.
class NearestSites {
  public:
    /// Of the triangles that `takes_triangle` takes, which are one at least; of all if it is empty. `mesh`
    /// must outlive this and stay as it is. Throws GraphicsError if Embree refuses (out of memory).
    explicit NearestSites(const Mesh& mesh,
                          const std::function<bool(std::uint32_t triangle)>& takes_triangle = {});
    ~NearestSites();
    NearestSites(NearestSites&&) noexcept;
    NearestSites& operator=(NearestSites&&) noexcept;

    /// The place that is nearest to a position in object coordinates; of several the one of the lowest
    /// triangle.
    SurfaceSite nearest(const glm::dvec3& position) const noexcept;

  private:
    struct Tree;
    std::unique_ptr<Tree> tree_;
};

} // namespace overt
