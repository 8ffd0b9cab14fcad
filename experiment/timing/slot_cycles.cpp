#include "experiment/timing/slot_cycles.h"

#include <algorithm>
#include <utility>

namespace overt {

namespace {

const PageCycleEntry& entry_in_turn(const PageCycle& cycle, int refresh) noexcept {
    return cycle.entry_at(refresh % cycle.total_refreshes);
}

} // namespace

void SlotCycles::begin(int trial, std::size_t loaded_count, std::vector<int> places,
                       std::vector<PageCycle> beside) {
    places_ = std::move(places);
    beside_ = std::move(beside);
    frames_.assign(loaded_count, no_frame);
    lit_as_.assign(places_.begin(), places_.end());
    rows_.clear();
    for (const int place : places_)
        if (place > 0)
            rows_.push_back({trial, 0, place, no_frame, no_frame, {}});
}

void SlotCycles::turn_to(std::size_t i, const PageCycleEntry& entry) noexcept {
    PageCycle& cycle = beside_[i - 1];
    std::ranges::fill(cycle.entries, entry);
}

std::span<const AnimationFrameIndex> SlotCycles::frames(AnimationFrameIndex lead, int refresh) noexcept {
    std::ranges::fill(frames_, no_frame);
    frames_[lit_as_.front()] = lead;
    SlotFlip* row = rows_.data() + (is_first_lit() ? 0 : 1);
    for (std::size_t i = 0; i < beside_.size(); ++i, ++row) {
        const PageCycleEntry& entry = entry_in_turn(beside_[i], refresh);
        frames_[lit_as_[i + 1]] = entry.frame;
        row->shown = entry.frame;
        row->pose = entry.pose;
    }
    return frames_;
}

std::span<const SlotFlip> SlotCycles::enter(const FlipRecord& lead, int refresh) noexcept {
    SlotFlip* row = rows_.data();
    if (!is_first_lit()) {
        row->planned = lead.planned;
        row->shown = lead.shown;
        row->pose = lead.pose;
        ++row;
    }
    for (std::size_t i = 0; i < beside_.size(); ++i, ++row)
        row->planned = lead.planned == no_frame ? no_frame : entry_in_turn(beside_[i], refresh).frame;
    for (SlotFlip& each : rows_)
        each.refresh_in_trial = lead.refresh_in_trial;
    return rows_;
}

FlipRecord SlotCycles::of_first(FlipRecord lead) const noexcept {
    if (!is_first_lit()) {
        lead.planned = lead.shown = no_frame;
        lead.pose = {};
    }
    return lead;
}

MissedRefresh SlotCycles::of_first(MissedRefresh lead) const noexcept {
    if (!is_first_lit()) {
        lead.planned = lead.shown = no_frame;
        lead.pose = {};
    }
    return lead;
}

} // namespace overt
