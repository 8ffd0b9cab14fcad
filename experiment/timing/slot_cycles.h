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
    /// Begins a show of a trial of which `loaded_count` stimuli stand ready. `places`: those that it lights
    /// (Trial::shown), rising, one at least; the first is the lead. `beside`: the cycles of the others, in
    /// their order; one that ends before the ledger's begins again.
    void begin(int trial, std::size_t loaded_count, std::vector<int> places, std::vector<PageCycle> beside);

    /// From now on the place that is lit as the i-th, the lead being the 0th, shows another of what is
    /// loaded: in the same pose, at the same place on the screen. Until then it shows itself.
    void show_as(std::size_t i, std::size_t loaded) noexcept { lit_as_[i] = loaded; }
    /// From now on this is what the i-th shows, i > 0, whatever its cycle says.
    void turn_to(std::size_t i, const PageCycleEntry& entry) noexcept;

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
    std::vector<std::size_t> lit_as_{0}; ///< of each place that is lit, which of what is loaded
    std::vector<SlotFlip> rows_;
};

} // namespace overt
