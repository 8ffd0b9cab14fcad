#include "render/vblank/window_flips.h"

#include <algorithm>
#include <cmath>

namespace overt {

void FlipCount::number(FlipReport& report, std::optional<std::int64_t> count) noexcept {
    // Followed in any case, so that its phase is known when the source falls silent.
    const std::int64_t by_time = by_time_.at(report.vertical_blank);
    std::int64_t refreshes = std::max<std::int64_t>(1, by_time - last_by_time_);
    if (count && last_count_) {
        const std::int64_t counted = *count - *last_count_;
        const double elapsed = to_seconds(report.vertical_blank - last_blank_) * nominal_hz_;
        // Over a long pause a rate that is not quite nominal adds up.
        const double tolerance = 1.5 + 0.02 * elapsed;
        if (counted >= 1 && std::abs(static_cast<double>(counted) - elapsed) <= tolerance)
            refreshes = counted;
    }
    last_by_time_ = by_time;
    last_count_ = count;
    last_blank_ = report.vertical_blank;
    refresh_ += refreshes;
    report.refresh = {refresh_};
}

void WindowFlips::begin() noexcept {
    if (!source_ || is_silent_)
        return;
    before_ = source_->last();
}

void WindowFlips::draw_a_pixel() const noexcept {
    const GladGLContext& gl = window_->gl();
    gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    gl.Enable(GL_SCISSOR_TEST);
    gl.Scissor(0, 0, 1, 1);
    gl.ClearColor(0.0f, 0.0f, 0.0f, 1.0f);
    gl.Clear(GL_COLOR_BUFFER_BIT);
    gl.Disable(GL_SCISSOR_TEST);
}

FlipReport WindowFlips::swap(SessionTime requested) noexcept {
    window_->swap_buffers();
    FlipReport report;
    report.requested = requested;
    report.swapped = clock_->now();
    if (!before_)
        draw_a_pixel();
    window_->gl().Finish();
    const SessionTime returned = clock_->now();
    const std::optional<VblankStamp> lit =
        source_ && before_ ? source_->after_swap(*before_) : std::optional<VblankStamp>();
    window_->poll_events();
    if (lit) {
        report.vertical_blank = lit->at;
        report.source = source_->source();
        report.uncertainty = uncertainty_;
        count_.number(report, lit->count);
        return report;
    }
    // Kept, not destroyed: that may take its time.
    before_.reset();
    is_silent_ = true;
    report.vertical_blank = returned;
    report.source = VblankSource::swap_return;
    report.uncertainty = std::max(returned - report.swapped, refresh_);
    count_.number(report, std::nullopt);
    return report;
}

} // namespace overt
