#include "experiment/analysis/flip_history.h"

#include <algorithm>

#include "experiment/base/error.h"

namespace overt {

FlipHistory::FlipHistory(std::span<const Show> shows, const ScanOut& scan_out)
    : scan_out_(scan_out), refresh_ns_(1e9 / scan_out.refresh_hz) {
    OVERT_EXPECTS(scan_out.refresh_hz > 0.0 && scan_out.screen_rows > 0.0);
    for (const Show& show : shows)
        if (!show.flips.empty())
            shows_.emplace_back(show, scan_out.refresh_hz);
    std::ranges::stable_sort(shows_, {}, &ShowHistory::onset);
}

FlipHistory::FlipHistory(std::span<const FlipRecord> flips, const ScanOut& scan_out, const PageCycle& plan)
    : FlipHistory(std::vector<Show>{{flips, plan}}, scan_out) {}

FlipHistory::ShowHistory::ShowHistory(const Show& show, double refresh_hz) : refresh_ns_(1e9 / refresh_hz) {
    std::vector<FlipRecord> ordered(show.flips.begin(), show.flips.end());
    std::stable_sort(ordered.begin(), ordered.end(), [](const FlipRecord& a, const FlipRecord& b) {
        return a.report.vertical_blank < b.report.vertical_blank;
    });
    blanks_.reserve(ordered.size());
    pictures_.reserve(ordered.size());
    for (const FlipRecord& flip : ordered) {
        blanks_.push_back(flip.report.vertical_blank);
        pictures_.push_back({flip.shown, flip.pose, flip.report.refresh});
    }
    end_ = blanks_.back() + from_seconds(1.0 / refresh_hz);
    for (int refresh = 0; refresh <= show.plan.total_refreshes; ++refresh) {
        planned_blanks_.push_back(blanks_.front() + from_seconds(refresh / refresh_hz));
        if (refresh < show.plan.total_refreshes)
            planned_frames_.push_back(show.plan.entry_at(refresh).frame);
    }
    // Two steps for each blank, so that hardly a step holds more than one.
    const std::size_t steps = 2 * blanks_.size();
    const double step_ns = static_cast<double>((end_ - blanks_.front()).count()) / static_cast<double>(steps);
    steps_per_ns_ = 1.0 / step_ns;
    std::uint32_t before = 0;
    for (std::size_t step = 0; step <= steps; ++step) {
        const SessionTime from =
            blanks_.front() + SessionDuration(static_cast<std::int64_t>(step_ns * static_cast<double>(step)));
        while (before < blanks_.size() && blanks_[before] <= from)
            ++before;
        blanks_before_step_.push_back(before);
    }
}

const FlipHistory::ShowHistory* FlipHistory::show_at(SessionTime blank) const {
    if (shows_.empty())
        return nullptr;
    std::size_t i = shows_.size() - 1;
    while (i > 0 && blank < shows_[i].onset())
        --i;
    return &shows_[i];
}

std::ptrdiff_t FlipHistory::ShowHistory::picture_at(SessionTime blank) const {
    if (blank < blanks_.front() || blank >= end_)
        return -1;
    const auto step =
        static_cast<std::size_t>(static_cast<double>((blank - blanks_.front()).count()) * steps_per_ns_);
    // Rounding may have led to the step before or after; the neighbours' bounds take that in.
    const std::size_t first = step > 0 ? blanks_before_step_[step - 1] : 1;
    const std::size_t last = blanks_before_step_[std::min(step + 2, blanks_before_step_.size() - 1)];
    const auto next = std::upper_bound(blanks_.begin() + static_cast<std::ptrdiff_t>(first),
                                       blanks_.begin() + static_cast<std::ptrdiff_t>(last), blank);
    return next - blanks_.begin() - 1;
}

std::ptrdiff_t FlipHistory::ShowHistory::planned_at(SessionTime blank) const {
    if (blank < planned_blanks_.front() || blank >= planned_blanks_.back())
        return -1;
    auto refresh =
        static_cast<std::size_t>(static_cast<double>((blank - blanks_.front()).count()) / refresh_ns_);
    // Compared with whole nanoseconds of each planned blank: an instant right on one belongs to its refresh.
    refresh = std::min(refresh, planned_frames_.size() - 1);
    while (blank >= planned_blanks_[refresh + 1])
        ++refresh;
    while (blank < planned_blanks_[refresh])
        --refresh;
    return static_cast<std::ptrdiff_t>(refresh);
}

bool FlipHistory::ShowHistory::is_on_plan(std::ptrdiff_t picture, SessionTime blank) const {
    const std::ptrdiff_t planned = planned_at(blank);
    return picture < 0 || planned < 0 ? picture == planned
                                      : pictures_[static_cast<std::size_t>(picture)].frame ==
                                            planned_frames_[static_cast<std::size_t>(planned)];
}

bool FlipHistory::ShowHistory::is_off_plan(std::ptrdiff_t picture, SessionTime blank) const {
    constexpr SessionDuration rounding = std::chrono::microseconds(1);
    return !is_on_plan(picture, blank) && !is_on_plan(picture, blank - rounding) &&
           !is_on_plan(picture, blank + rounding);
}

std::optional<LitFrame> FlipHistory::frame_shown_at(SessionTime time, double row_px) const {
    return lighting_at(time, row_px).shown;
}

std::optional<AnimationFrameIndex> FlipHistory::frame_planned_at(SessionTime time, double row_px) const {
    const SessionTime blank = blank_lighting(scan_out_, refresh_ns_, time, row_px);
    const ShowHistory* const show = show_at(blank);
    const std::ptrdiff_t refresh = show ? show->planned_at(blank) : -1;
    return refresh < 0 ? std::nullopt : std::optional(show->planned(refresh));
}

Lighting FlipHistory::lighting_at(SessionTime time, double row_px) const {
    const SessionTime blank = blank_lighting(scan_out_, refresh_ns_, time, row_px);
    const ShowHistory* const show = show_at(blank);
    if (!show)
        return {};
    const std::ptrdiff_t picture = show->picture_at(blank);
    // A slot may be empty for a while.
    const bool is_lit = picture >= 0 && show->picture(picture).frame != no_frame;
    return {is_lit ? std::optional(show->picture(picture)) : std::nullopt, show->is_off_plan(picture, blank)};
}

bool FlipHistory::is_off_plan(SessionTime time, double row_px) const {
    return lighting_at(time, row_px).off_plan;
}

} // namespace overt
