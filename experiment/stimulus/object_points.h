/// The places of a protocol's [[points]] on an object: where they are, and how they are seen.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiment/ports/probe_view.h"
#include "experiment/scene/ray_caster.h"
#include "experiment/scene/surface_sites.h"
#include "experiment/scene/viewing.h"

namespace overt {

struct Protocol;
struct PointListSettings;

struct ObjectPoint {
    std::string name; ///< "ID.1"
    SurfaceSite site;
    glm::dvec3 position{0.0};                 ///< in object coordinates
    glm::dvec3 normal{0.0};                   ///< by which it is shaded, unit length, outwards
    std::optional<std::uint32_t> vertex = {}; ///< of the mesh, where it is one
};

/// How a place is seen in a view, the object being turned by `angle`. `caster`: of the mesh.
SeenProbe seen_point(const Mesh& mesh, const RayCaster& caster, const SceneView& scene,
                     const ObjectPose& angle, const ObjectPoint& point);

/// Whether a list has places on an object of the protocol.
bool is_on_object(const Protocol& protocol, const PointListSettings& list, std::size_t object);

/// The places of a list on an object, which has a mesh; as many as the list says. Throws InputError that says
/// what the surface lacks.
std::vector<ObjectPoint> points_on(const Protocol& protocol, const PointListSettings& list, const Mesh& mesh,
                                   const SceneView& scene);

} // namespace overt
