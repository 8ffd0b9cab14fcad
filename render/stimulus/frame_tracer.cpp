#include "render/stimulus/frame_tracer.h"

namespace overt {

SpectralFrame FrameTracer::trace(const Condition& condition, Degrees angle, const TriangleMap& map,
                                 const BakeSettings& settings, const BakeProgress& progress) {
    const Sculpture& sculpture = sculptures_[static_cast<std::size_t>(condition.sculpture)];
    if (!light_)
        light_.emplace(protocol_->light);
    if (!scene_ || scene_of_ != condition) {
        scene_.reset(); // the memory of one at a time
        scene_.emplace(sculpture.mesh, protocol_->materials[static_cast<std::size_t>(condition.material)]);
        scene_of_ = condition;
    }
    std::vector<std::uint8_t> covered(map.codes.size());
    for (std::size_t i = 0; i < covered.size(); ++i)
        covered[i] = map.codes[i] != 0;
    return bake_frame(*scene_, *light_, sculpture.scene, angle, covered, settings, progress);
}

} // namespace overt
