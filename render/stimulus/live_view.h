/// A sculpture to be turned by hand: drawn by OpenGL as an approximation, and labelled as one.
#pragma once

#include <span>

#include "experiment/stimulus/sculpture.h"
#include "experiment/trial.h"
#include "render/stimulus/stimulus_renderer.h"

namespace overt {

/// From where a sculpture is looked at, beside what its protocol says.
struct Orbit {
    double turn_deg = 0.0;      ///< of the turntable, counter-clockwise seen from above
    double elevation_deg = 0.0; ///< of the camera about its target, -85 … 85
    double distance = 1.0;      ///< factor to the camera's

    /// By a drag of the mouse: half a degree for each pixel, as if the surface were held.
    void drag(glm::dvec2 by_px);
    /// By steps of the wheel, a tenth each; nearer for positive ones.
    void zoom(double steps);
};

/// The same scene looked at from elsewhere. A camera that came into the space which the turning object
/// sweeps is put just outside of it.
SceneView seen_from(const SceneView& scene, const Orbit& orbit);

class LiveView {
  public:
    /// `protocol` and `sculptures` must outlive the view; all sculptures that are looked at have a mesh.
    /// Throws as StimulusRenderer does.
    LiveView(const GlContext& context, const Protocol& protocol, std::span<const Sculpture> sculptures,
             glm::ivec2 image_px);

    /// Throws InputError for a sculpture without a mesh.
    void choose(const Condition& stimulus);
    const Condition& chosen() const { return stimulus_; }

    /// Display light over the protocol's background, opaque, with a line of text that says what it is.
    LinearImage draw(const Orbit& orbit);

  private:
    const GlContext* context_;
    const Protocol* protocol_;
    std::span<const Sculpture> sculptures_;
    glm::ivec2 image_px_;
    StimulusRenderer renderer_;
    Condition stimulus_{-1, -1};
    std::optional<MeshBuffers> buffers_;
    float label_grey_;
    LinearImage label_;
};

} // namespace overt
