#include "experiment/timing/slot_cycles.h"

#include <utility>

namespace overt {

namespace {

const PageCycleEntry& entry_in_turn(const PageCycle& cycle, int refresh) noexcept {
    return cycle.entry_at(refresh % cycle.total_refreshes);
}

} // namespace

void SlotCycles::begin(int trial, std::vector<PageCycle> beside) {
    cycles_ = std::move(beside);
    frames_.resize(1 + cycles_.size());
    rows_.assign(cycles_.size(), {});
    for (std::size_t i = 0; i < rows_.size(); ++i) {
        rows_[i].trial = trial;
        rows_[i].place = static_cast<int>(i) + 1;
    }
}

std::span<const AnimationFrameIndex> SlotCycles::frames(AnimationFrameIndex first, int refresh) noexcept {
    frames_[0] = first;
    for (std::size_t i = 0; i < cycles_.size(); ++i) {
        const PageCycleEntry& entry = entry_in_turn(cycles_[i], refresh);
        frames_[i + 1] = entry.frame;
        rows_[i].shown = entry.frame;
        rows_[i].pose = entry.pose;
    }
    return frames_;
}

std::span<const SlotFlip> SlotCycles::enter(const FlipRecord& flip) noexcept {
    for (std::size_t i = 0; i < cycles_.size(); ++i) {
        rows_[i].refresh_in_trial = flip.refresh_in_trial;
        rows_[i].planned =
            flip.planned == no_frame ? no_frame : entry_in_turn(cycles_[i], flip.refresh_in_trial).frame;
    }
    return rows_;
}

} // namespace overt
