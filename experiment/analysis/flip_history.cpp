#include "experiment/analysis/flip_history.h"

#include <algorithm>
#include <utility>

#include "experiment/error.h"

namespace overt {
FlipHistory::FlipHistory(std::span<const FlipRecord> flips, const ScanOut& scan_out, PageCycle plan)
    : scan_out_(scan_out), plan_(std::move(plan)) {
    OVERT_EXPECTS(scan_out.refresh_hz > 0.0 && scan_out.screen_rows > 0.0);
    std::vector<FlipRecord> ordered(flips.begin(), flips.end());
    std::stable_sort(ordered.begin(), ordered.end(), [](const FlipRecord& a, const FlipRecord& b) {
        return a.report.vertical_blank < b.report.vertical_blank;
    });
    blanks_.reserve(ordered.size());
    pictures_.reserve(ordered.size());
    for (const FlipRecord& flip : ordered) {
        blanks_.push_back(flip.report.vertical_blank);
        pictures_.push_back({flip.shown, flip.page, flip.report.refresh});
    }
    if (!blanks_.empty())
        end_ = blanks_.back() + from_seconds(1.0 / scan_out_.refresh_hz);
}

SessionTime FlipHistory::blank_lighting(SessionTime time, double row_px) const {
    const double row_share = std::clamp(row_px / scan_out_.screen_rows, 0.0, 1.0);
    return time - scan_out_.latency - from_seconds(row_share / scan_out_.refresh_hz);
}

std::optional<LitFrame> FlipHistory::frame_shown_at(SessionTime time, double row_px) const {
    const SessionTime instant = blank_lighting(time, row_px);
    if (blanks_.empty() || instant < blanks_.front() || instant >= end_)
        return std::nullopt;
    const auto next = std::upper_bound(blanks_.begin(), blanks_.end(), instant);
    return pictures_[static_cast<std::size_t>(next - blanks_.begin() - 1)];
}

std::optional<AnimationFrameIndex> FlipHistory::frame_planned_at(SessionTime time, double row_px) const {
    const SessionTime instant = blank_lighting(time, row_px);
    if (blanks_.empty() || instant < blanks_.front())
        return std::nullopt;
    // Compared with whole nanoseconds of each planned blank: an instant right on one belongs to its refresh.
    const double since_onset_s = to_seconds(instant - blanks_.front());
    auto refresh = static_cast<std::int64_t>(since_onset_s * scan_out_.refresh_hz);
    const auto planned_blank = [&](std::int64_t index) {
        return blanks_.front() + from_seconds(static_cast<double>(index) / scan_out_.refresh_hz);
    };
    while (instant >= planned_blank(refresh + 1))
        ++refresh;
    while (refresh > 0 && instant < planned_blank(refresh))
        --refresh;
    if (refresh >= plan_.total_refreshes)
        return std::nullopt;
    return plan_.entry_at(static_cast<int>(refresh)).frame;
}

bool FlipHistory::is_off_plan(SessionTime time, double row_px) const {
    const std::optional<LitFrame> shown = frame_shown_at(time, row_px);
    const auto agrees_at = [&](SessionTime planned_time) {
        const std::optional<AnimationFrameIndex> planned = frame_planned_at(planned_time, row_px);
        return planned.has_value() == shown.has_value() && (!planned || *planned == shown->frame);
    };
    constexpr SessionDuration rounding = std::chrono::microseconds(1);
    return !agrees_at(time) && !agrees_at(time - rounding) && !agrees_at(time + rounding);
}

} // namespace overt
