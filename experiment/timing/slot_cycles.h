/// What the slots of a trial show at each flip of a show.
#pragma once

#include <span>
#include <vector>

#include "experiment/animation.h"
#include "experiment/flip_report.h"

namespace overt {

/// A show lights some of a trial's stimuli, or all; the other slots stay empty. The ledger is that of the
/// first that it lights, the lead, and keeps the time; the others follow it, each through a page cycle of its
/// own. One thread; after begin() it allocates and throws nothing.
class SlotCycles {
  public:
    /// Begins a show of a trial that has `shown_count` stimuli. `places`: those that it lights
    /// (Trial::shown), rising, one at least; the first is the lead. `beside`: the cycles of the others, in
    /// their order; one that ends before the ledger's begins again.
    void begin(int trial, std::size_t shown_count, std::vector<int> places, std::vector<PageCycle> beside);

    /// What a flip is to show, of all that the trial has: `lead`, and beside it the frames of this refresh of
    /// the plan, from 0.
    std::span<const AnimationFrameIndex> frames(AnimationFrameIndex lead, int refresh) noexcept;

    /// Enters what became of those frames: a row for each that is lit, but for the trial's first stimulus.
    /// `lead`: the ledger's row; `refresh`: of the plan, at which it was lit.
    std::span<const SlotFlip> enter(const FlipRecord& lead, int refresh) noexcept;

    /// The row of the trial's first stimulus at the same refresh: empty where it is not lit.
    FlipRecord of_first(FlipRecord lead) const noexcept;
    MissedRefresh of_first(MissedRefresh lead) const noexcept;

  private:
    bool is_first_lit() const noexcept { return places_.front() == 0; }

    std::vector<int> places_{0};
    std::vector<PageCycle> beside_;
    std::vector<AnimationFrameIndex> frames_{AnimationFrameIndex{}};
    std::vector<SlotFlip> rows_;
};

} // namespace overt
