/// A mesh in a plain material, to be turned by hand, with triangles in colours: for what is outlined or
/// painted on it.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>

#include "experiment/protocol/protocol.h"
#include "experiment/scene/orbit.h"
#include "experiment/scene/ray_caster.h"
#include "experiment/stimulus/object.h"
#include "render/stimulus/live_view.h"

namespace overt {

/// A protocol that shows one mesh file in grey. `up`, `unit`: as [[object]] has them; empty: as is usual for
/// the file's format.
Protocol plain_protocol(const std::filesystem::path& mesh, const std::string& up, const std::string& unit);

class SurfaceView {
  public:
    /// `context`, `protocol` and `object` must outlive this.
    SurfaceView(const GlContext& context, const Protocol& protocol, const Object& object,
                glm::ivec2 image_px);

    /// The surface under a point of the picture.
    std::optional<RayHit> surface_at(glm::dvec2 image_px, const Orbit& orbit) const;

    /// By the index of a triangle: the colour that its light is multiplied by; nothing leaves it as it is.
    using Tint = std::function<std::optional<glm::vec3>(std::uint32_t triangle)>;
    /// `marks`: places of the object that get a dot.
    LinearImage draw(const Orbit& orbit, const Tint& tint, std::span<const glm::dvec3> marks = {});

  private:
    Ray ray_at(glm::dvec2 image_px, const Orbit& orbit) const;
    void add_tints(LinearImage& picture, const Orbit& orbit, const Tint& tint) const;
    void mark(LinearImage& picture, const Orbit& orbit, glm::dvec3 point) const;

    RayCaster caster_;
    LiveView view_;
    SceneView scene_;
};

} // namespace overt
