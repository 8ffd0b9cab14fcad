/// Areas that a hand paints on a mesh, triangle by triangle.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "experiment/scene/mesh.h"
#include "experiment/scene/nearest_sites.h"
#include "experiment/scene/surface_sites.h"

namespace overt {

/// A number for each triangle: 0 where nothing is painted, else that of an area.
class AreaPainting {
  public:
    using Paint = std::uint8_t;

    /// `mesh` must outlive this. `paints`: as long as its triangles; empty: nothing is painted.
    explicit AreaPainting(const Mesh& mesh, std::vector<Paint> paints = {});

    std::span<const Paint> paints() const { return paints_; }
    /// Share of the mesh's area that has this paint.
    double share(Paint paint) const;

    /// What is painted from here on is taken back at once.
    void begin_step();
    /// Takes back the last step that changed anything; false if there is none.
    bool undo();

    /// Paints what a brush touches: of the triangles whose middle is no farther than `radius` from the place
    /// those that hang together with the place's own, which is painted in any case. So a brush does not go
    /// through a wall, nor from one finger to the next.
    void dab(const SurfaceSite& at, double radius, Paint paint);
    /// Makes what has this paint larger by the triangles that share an edge with it.
    void grow(Paint paint);
    /// Makes it smaller by those that share an edge with others.
    void shrink(Paint paint);
    /// Paints the other side alike: each triangle whose middle, mirrored at x = `plane_x`, lies at a triangle
    /// of this paint, no farther from it than `reach`. What is painted stays.
    void mirror(Paint paint, double plane_x, double reach);

  private:
    static constexpr std::uint32_t none = 0xffffffff;
    glm::dvec3 middle(std::uint32_t triangle) const;
    void set(std::uint32_t triangle, Paint paint);
    bool borders(std::uint32_t triangle, Paint paint, bool on_it) const;

    const Mesh* mesh_;
    NearestSites sites_;
    std::vector<std::array<std::uint32_t, 3>> neighbours_; ///< by edge; none: an open one
    std::vector<Paint> paints_;
    using Step = std::vector<std::pair<std::uint32_t, Paint>>; ///< triangles, and what they were
    std::vector<Step> steps_;
};

} // namespace overt
