/// The live map of gaze on an object, as a picture that can be turned by hand.
#pragma once

#include <memory>
#include <optional>

#include "app/watch/live_saliency.h"
#include "app/watch/watched_object.h"
#include "experiment/scene/orbit.h"
#include "render/gl/gl_objects.h"
#include "render/gl/shader_program.h"

namespace overt {

/// Draws into a texture of its own, when something has changed.
class SaliencyPicture {
  public:
    /// `context` must be current and outlive this.
    explicit SaliencyPicture(const GlContext& context);

    /// The texture, bottom row first.
    GLuint draw(const WatchedObject& object, const std::shared_ptr<const SaliencyMap>& map,
                const Orbit& orbit, glm::ivec2 size_px);

    /// Where a point of the surface is in the picture drawn last, from its top left, and whether the
    /// object hides it.
    struct Place {
        glm::dvec2 px{0.0};
        bool is_hidden = false;
    };
    std::optional<Place> place_of(const WatchedObject& object, const glm::dvec3& position) const;

  private:
    void upload(const SaliencyMap& map);

    const GlContext* context_;
    ShaderProgram program_;
    VertexArray array_;
    std::optional<Buffer> positions_, normals_, colours_, triangles_;
    std::optional<Framebuffer> frame_;
    std::shared_ptr<const SaliencyMap> map_; ///< that is uploaded
    Orbit orbit_;
    SceneView seen_; ///< of the picture drawn last
};

} // namespace overt
