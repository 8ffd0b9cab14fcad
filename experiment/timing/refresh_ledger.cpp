#include "experiment/timing/refresh_ledger.h"

#include <algorithm>

namespace overt {

void RefreshLedger::begin(int trial, int step, std::optional<RefreshIndex> first) noexcept {
    trial_ = trial;
    step_number_ = step;
    offset_ = 0;
    is_first_ = !first;
    first_ = first.value_or(RefreshIndex{});
    step_ = shown_ = missed_ = missed_begin_ = missed_end_ = 0;
    before_ = last_ = {};
}

AnimationFrameIndex RefreshLedger::planned_at(int refresh) const noexcept {
    const int in_show = refresh - offset_;
    return in_show < cycle_->total_refreshes ? cycle_->entry_at(in_show).frame : no_frame;
}

const FlipRecord& RefreshLedger::enter(const FlipReport& report) noexcept {
    const PageCycleEntry& entry = next();
    before_ = last_;
    last_ = {trial_, 0, planned_at(offset_), entry.frame, entry.pose, report, 0, step_number_};
    if (shown_ == 0) {
        if (is_first_)
            first_ = report.refresh;
        offset_ = static_cast<int>(std::clamp<std::int64_t>(report.refresh.value - first_.value, 0, 1 << 30));
        last_.refresh_in_trial = offset_;
        last_.planned = planned_at(offset_);
        onset_ = report.vertical_blank;
        missed_begin_ = missed_end_ = 0;
    } else {
        const std::int64_t counted = report.refresh.value - first_.value;
        const int next_refresh = before_.refresh_in_trial + 1;
        last_.refresh_in_trial = static_cast<int>(std::clamp<std::int64_t>(counted, next_refresh, 1 << 30));
        last_.planned = planned_at(last_.refresh_in_trial);
        last_.missed_refreshes = last_.refresh_in_trial - next_refresh;
        const int end = offset_ + cycle_->total_refreshes;
        missed_begin_ = std::min(next_refresh, end);
        missed_end_ = std::min(last_.refresh_in_trial, end);
    }
    ++shown_;
    missed_ += last_.missed_refreshes;
    step_ = when_late_ == WhenLate::stretch ? step_ + 1 : last_refresh() + 1;
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
