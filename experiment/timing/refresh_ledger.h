/// The book of one show: which frame comes next, and what became of each refresh of the plan.
#pragma once

#include <optional>

#include "experiment/animation.h"
#include "experiment/flip_report.h"

namespace overt {

/// Turns the display's reports into rows. One thread; allocates and throws nothing.
///
/// The first flip is the onset, refresh 0 of an attempt's first show; further shows count on from there. For
/// each refresh from there to the plan's end there is a row in the end: a FlipRecord, or a MissedRefresh if
/// it went by with the picture before. What is planned for a refresh is always the nominal plan, whatever was
/// done about lateness.
class RefreshLedger {
  public:
    /// `cycle` must outlive the ledger.
    RefreshLedger(const PageCycle& cycle, WhenLate when_late) : cycle_(&cycle), when_late_(when_late) {}

    /// Begins the book of a trial's show. `step`: which of the attempt's steps it is, from 1. `first`: the
    /// refresh of the onset of the attempt's first show; nothing: this is the first.
    void begin(int trial, int step = 0, std::optional<RefreshIndex> first = {}) noexcept;

    /// drop: the plan's time is over. stretch: all of its refreshes were flipped to.
    bool is_complete() const noexcept { return step_ >= cycle_->total_refreshes; }

    /// What to show next; not if is_complete().
    const PageCycleEntry& next() const noexcept { return cycle_->entry_at(step_); }

    /// For which refresh of the plan that is, from 0.
    int next_refresh() const noexcept { return step_; }

    /// Which refresh of the plan the last flip was for: its row counts from the attempt's first onset.
    int last_refresh() const noexcept { return last_.refresh_in_trial - offset_; }
    /// Of the attempt's first onset, once anything was shown.
    RefreshIndex first() const noexcept { return first_; }

    /// Enters what became of next(). A count that does not go on, as no display should report it, is taken as
    /// the next refresh.
    const FlipRecord& enter(const FlipReport& report) noexcept;

    /// How many refreshes of the plan went by between the last two flips, and which: 0 <= i < count.
    int missed_count() const noexcept { return missed_end_ - missed_begin_; }
    MissedRefresh missed(int i) const noexcept;

    SessionTime onset() const noexcept { return onset_; }
    int shown_refreshes() const noexcept { return shown_; }
    /// All that went by, after the plan's end too, where frames are stretched.
    int missed_refreshes() const noexcept { return missed_; }

  private:
    AnimationFrameIndex planned_at(int refresh) const noexcept;

    const PageCycle* cycle_;
    WhenLate when_late_;
    int trial_ = 0, step_number_ = 0;
    int offset_ = 0; ///< refreshes from the attempt's first onset to this show's
    bool is_first_ = true;
    int step_ = 0; ///< of the plan, to be shown next
    int shown_ = 0, missed_ = 0;
    int missed_begin_ = 0, missed_end_ = 0;
    RefreshIndex first_;
    SessionTime onset_;
    FlipRecord before_, last_;
};

} // namespace overt
