/// The path tracer on the stimuli of a protocol.
#pragma once

#include <optional>
#include <span>

#include "experiment/maps/triangle_map.h"
#include "experiment/stimulus/sculpture.h"
#include "experiment/trial.h"
#include "render/bake/frame_baker.h"

namespace overt {

class FrameTracer {
  public:
    /// Both must outlive the tracer.
    FrameTracer(const Protocol& protocol, std::span<const Sculpture> sculptures)
        : protocol_(&protocol), sculptures_(sculptures) {}

    /// Traces one frame on all processors; see bake_frame(). `map` is the hidden map of that angle. What a
    /// stimulus needs is built when it comes up and kept until another does. Throws InputError,
    /// GraphicsError.
    SpectralFrame trace(const Condition& condition, Degrees angle, const TriangleMap& map,
                        const BakeSettings& settings, const BakeProgress& progress);

  private:
    const Protocol* protocol_;
    std::span<const Sculpture> sculptures_;
    std::optional<SpectralLight> light_;
    std::optional<BakeScene> scene_;
    Condition scene_of_;
};

} // namespace overt
