/// Stand-ins for the stimuli of a session that nobody sees.
#pragma once

#include "experiment/protocol/protocol.h"
#include "render/presenter/frame_store.h"

namespace overt {

/// As many animation frames as the stimuli have, all of them the background. A simulated observer looks at
/// the objects' meshes, and of a display that only keeps time no picture goes anywhere: reading and
/// encoding them would take nine tenths of such a session.
class UndrawnFrames final : public FrameSource {
  public:
    /// Both must outlive this; `frames` tells how many there are.
    UndrawnFrames(const FrameSource& frames, const Protocol& protocol)
        : frames_(&frames), protocol_(&protocol) {}

    Stimulus in_slot(const PlacedStimulus& placed, Eye eye) const override {
        return frames_->in_slot(placed, eye);
    }
    std::vector<int> page_of_frame(const Stimulus& stimulus) const override {
        return std::vector<int>(frames_->page_of_frame(stimulus).size(), 0);
    }
    LinearImage page(const Stimulus& stimulus, int) const override {
        const ViewSettings& view = protocol_->view_of(stimulus);
        return LinearImage({view.width_px, view.height_px}); // transparent
    }

  private:
    const FrameSource* frames_;
    const Protocol* protocol_;
};

} // namespace overt
