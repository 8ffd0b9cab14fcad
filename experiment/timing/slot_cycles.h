/// What the further slots of a trial show at each flip. The trial's ledger is that of its first stimulus and
/// keeps the time; the others follow it, each through a page cycle of its own.
#pragma once

#include <span>
#include <vector>

#include "experiment/animation.h"
#include "experiment/flip_report.h"

namespace overt {

/// One thread; after begin() it allocates and throws nothing.
class SlotCycles {
  public:
    /// Begins a presentation of a trial. `beside`: of its further stimuli, in their order; one that ends
    /// before the ledger's begins again.
    void begin(int trial, std::vector<PageCycle> beside);

    /// What a flip is to show: `first`, and beside it the frames of this refresh of the plan, from 0.
    std::span<const AnimationFrameIndex> frames(AnimationFrameIndex first, int refresh) noexcept;

    /// Enters what became of those frames: a row for each further slot.
    std::span<const SlotFlip> enter(const FlipRecord& flip) noexcept;

  private:
    std::vector<PageCycle> cycles_;
    std::vector<AnimationFrameIndex> frames_{AnimationFrameIndex{}};
    std::vector<SlotFlip> rows_;
};

} // namespace overt
