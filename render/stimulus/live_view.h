/// An object to be turned by hand: drawn by OpenGL as an approximation, and labelled as one.
#pragma once

#include <optional>
#include <span>

#include "experiment/scene/orbit.h"
#include "experiment/stimulus/object.h"
#include "experiment/trial.h"
#include "render/stimulus/stimulus_renderer.h"

namespace overt {

class LiveView {
  public:
    /// `protocol` and `objects` must outlive the view; all objects that are looked at have a mesh.
    LiveView(const GlContext& context, const Protocol& protocol, std::span<const Object> objects,
             glm::ivec2 image_px);

    /// Throws InputError for an object without a mesh, and as StimulusRenderer does.
    void choose(const Stimulus& stimulus);
    const Stimulus& chosen() const { return stimulus_; }

    /// Display light over the protocol's background, opaque, with a line of text that says what it is. The
    /// light is turned by `light_turn` from where its settings have it.
    LinearImage draw(const Orbit& orbit, const Pose& pose = {});

  private:
    void set_material(const MaterialSettings& material, const Object& object, bool is_of_object);

    const GlContext* context_;
    const Protocol* protocol_;
    std::span<const Object> objects_;
    glm::ivec2 image_px_;
    std::optional<StimulusRenderer> renderer_; ///< for the light
    Stimulus stimulus_{-1, -1, -1, -1, -1};
    std::optional<MeshBuffers> buffers_;
    std::optional<PaintedSurface> painted_; ///< of a material that the object's file says
    float label_grey_;
    LinearImage label_;
};

} // namespace overt
