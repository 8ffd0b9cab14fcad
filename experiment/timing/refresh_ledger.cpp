#include "experiment/timing/refresh_ledger.h"

#include <algorithm>

namespace overt {

void RefreshLedger::begin(int trial) noexcept {
    trial_ = trial;
    step_ = shown_ = missed_ = missed_begin_ = missed_end_ = 0;
    before_ = last_ = {};
}

AnimationFrameIndex RefreshLedger::planned_at(int refresh) const noexcept {
    return refresh < cycle_->total_refreshes ? cycle_->entry_at(refresh).frame : no_frame;
}

const FlipRecord& RefreshLedger::enter(const FlipReport& report) noexcept {
    const PageCycleEntry& entry = next();
    before_ = last_;
    last_ = {trial_, 0, planned_at(0), entry.frame, entry.pose, report};
    if (shown_ == 0) {
        first_ = report.refresh;
        onset_ = report.vertical_blank;
        missed_begin_ = missed_end_ = 0;
    } else {
        const std::int64_t counted = report.refresh.value - first_.value;
        const int next_refresh = before_.refresh_in_trial + 1;
        last_.refresh_in_trial = static_cast<int>(std::clamp<std::int64_t>(counted, next_refresh, 1 << 30));
        last_.planned = planned_at(last_.refresh_in_trial);
        last_.missed_refreshes = last_.refresh_in_trial - next_refresh;
        missed_begin_ = std::min(next_refresh, cycle_->total_refreshes);
        missed_end_ = std::min(last_.refresh_in_trial, cycle_->total_refreshes);
    }
    ++shown_;
    missed_ += last_.missed_refreshes;
    step_ = when_late_ == WhenLate::stretch ? step_ + 1 : last_.refresh_in_trial + 1;
    return last_;
}

MissedRefresh RefreshLedger::missed(int i) const noexcept {
    const int refresh = missed_begin_ + i;
    const int past = refresh - before_.refresh_in_trial;
    const int span = last_.refresh_in_trial - before_.refresh_in_trial;
    const SessionDuration way = last_.report.vertical_blank - before_.report.vertical_blank;
    return {trial_,
            refresh,
            {before_.report.refresh.value + past},
            planned_at(refresh),
            before_.shown,
            before_.pose,
            before_.report.vertical_blank +
                SessionDuration(way.count() / span * past + way.count() % span * past / span),
            std::max(before_.report.uncertainty, last_.report.uncertainty)};
}

} // namespace overt
