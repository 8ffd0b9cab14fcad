/// Stand-ins for the stimuli of a session that nobody sees.
#pragma once

#include "render/presenter/frame_store.h"

namespace overt {

/// As many animation frames as the stimuli have, all of them the background. A simulated observer looks at
/// the objects' meshes, and of a display that only keeps time no picture goes anywhere: reading and
/// encoding them would take nine tenths of such a session.
class UndrawnFrames final : public FrameSource {
  public:
    /// `frames` must outlive this; it tells how many there are.
    UndrawnFrames(const FrameSource& frames, glm::ivec2 image_px) : frames_(&frames), picture_(image_px) {}

    std::vector<int> page_of_frame(const Stimulus& stimulus) const override {
        return std::vector<int>(frames_->page_of_frame(stimulus).size(), 0);
    }
    LinearImage page(const Stimulus&, int) const override { return picture_; }

  private:
    const FrameSource* frames_;
    LinearImage picture_; ///< transparent
};

} // namespace overt
