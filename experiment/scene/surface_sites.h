/// Places on the surface of a mesh: one by one, or spread evenly.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "experiment/scene/mesh.h"

namespace overt {

struct SurfaceSite {
    std::uint32_t triangle = 0;  ///< index into the mesh's triangles
    glm::dvec3 barycentric{0.0}; ///< weights of the triangle's corners, each >= 0, sum 1
};

/// In object coordinates.
glm::dvec3 position_of(const Mesh& mesh, const SurfaceSite& site);

/// Unit normal of a triangle, outwards; +z of one without an area.
glm::dvec3 normal_of_triangle(const Mesh& mesh, std::uint32_t triangle);

/// Unit normal between those of the corners, by which surfaces are shaded. `vertex_normals`: the mesh's.
glm::dvec3 shading_normal_of(const Mesh& mesh, const std::vector<glm::vec3>& vertex_normals,
                             const SurfaceSite& site);

/// The first triangle that has this vertex, at its corner; nothing if none has it.
std::optional<SurfaceSite> site_of_vertex(const Mesh& mesh, std::uint32_t vertex);

/// The place of one triangle that is nearest to a position in object coordinates.
SurfaceSite nearest_of_triangle(const Mesh& mesh, std::uint32_t triangle, const glm::dvec3& position);

/// The place of the surface that is nearest to a position in object coordinates; of several the one of the
/// lowest triangle. Looks at all triangles: for many positions see NearestSites. The mesh
/// has one at least.
SurfaceSite nearest_site(const Mesh& mesh, const glm::dvec3& position);

/// `count` places, drawn so that each piece of surface that is wanted has a share by its area, and so far
/// apart that no two lie close together: of ten times as many that are drawn by area alone, those are taken
/// out one by one that lie most among others (Yuksel, "Sample elimination for generating Poisson disk sample
/// sets", Computer Graphics Forum 34(2), 2015; distances in a straight line). In the order in which they were
/// drawn, so that the first of them are not special. The same `seed` gives the same places on every machine.
/// Fewer, perhaps none, if hardly any place is wanted. `takes_triangle`: of which triangles; `takes_site`:
/// which of their places, both may be empty.
std::vector<SurfaceSite> spread_sites(const Mesh& mesh, std::size_t count, std::uint64_t seed,
                                      const std::function<bool(std::uint32_t triangle)>& takes_triangle,
                                      const std::function<bool(const SurfaceSite&)>& takes_site);

} // namespace overt
