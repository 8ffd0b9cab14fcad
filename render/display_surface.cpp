#include "render/display_surface.h"

#include <algorithm>
#include <cmath>

#include "experiment/error.h"

namespace overt {

FlipReport VirtualDisplay::present(const Framebuffer&) noexcept {
    const SessionTime requested = clock_->now();
    // What a display would show must have been drawn by the time it is lit.
    context_->gl().Finish();
    return refresh_.next(requested);
}

void VirtualDisplay::read(const Framebuffer& canvas, PixelFormat format, std::span<std::byte> into) {
    canvas.bind();
    read_pixels(*context_, 0, {0, 0}, canvas.size_px(), format, into);
}

WindowDisplay::WindowDisplay(WindowContext& window, Clock& clock, double refresh_hz, bool virtual_time,
                             DisplayFaults faults)
    : window_(&window), clock_(&clock), virtual_time_(virtual_time),
      virtual_refresh_(clock, refresh_hz, std::move(faults)) {
    window.set_swap_interval(virtual_time ? 0 : 1);
}

DisplayTiming WindowDisplay::timing() const {
    return virtual_time_ ? virtual_refresh_.timing()
                         : DisplayTiming{virtual_refresh_.refresh_hz(), VblankSource::swap_return};
}

std::string WindowDisplay::why_closed() const {
    switch (window_->disturbance()) {
    case WindowDisturbance::resized:
        return "the window was resized, or the screen's mode changed";
    case WindowDisturbance::moved:
        return "the window was moved, to another screen or within a whole one";
    case WindowDisturbance::screen_lost:
        return "the screen that showed the window was unplugged";
    case WindowDisturbance::none:
        break;
    }
    return "the display was closed";
}

void WindowDisplay::draw_into_window(const Framebuffer& canvas) noexcept {
    const GladGLContext& gl = window_->gl();
    const glm::ivec2 size = canvas.size_px();
    gl.BindFramebuffer(GL_READ_FRAMEBUFFER, canvas.name());
    gl.ReadBuffer(GL_COLOR_ATTACHMENT0);
    gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    // The canvas holds its top row first, the window its bottom row: turned round here and nowhere else.
    gl.BlitFramebuffer(0, 0, size.x, size.y, 0, size.y, size.x, 0, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void WindowDisplay::read(const Framebuffer& canvas, PixelFormat format, std::span<std::byte> into) {
    draw_into_window(canvas);
    const GladGLContext& gl = window_->gl();
    const glm::ivec2 size = canvas.size_px();
    const auto [components, type] = transfer_format(format);
    const std::size_t stride = bytes_per_pixel(format) * static_cast<std::size_t>(size.x);
    OVERT_EXPECTS(into.size() == stride * static_cast<std::size_t>(size.y));
    gl.BindFramebuffer(GL_READ_FRAMEBUFFER, 0);
    gl.ReadBuffer(GL_BACK);
    gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl.ReadPixels(0, 0, size.x, size.y, components, type, into.data());
    // OpenGL has the window's bottom row first.
    for (auto top = into.begin(), bottom = into.end();
         bottom - top >= 2 * static_cast<std::ptrdiff_t>(stride);) {
        const auto next = top + static_cast<std::ptrdiff_t>(stride);
        bottom -= static_cast<std::ptrdiff_t>(stride);
        std::swap_ranges(top, next, bottom);
        top = next;
    }
    throw_on_gl_error(*window_, "reading the window's back buffer");
}

FlipReport WindowDisplay::present(const Framebuffer& canvas) noexcept {
    const SessionTime requested = clock_->now();
    const GladGLContext& gl = window_->gl();
    draw_into_window(canvas);
    window_->swap_buffers();
    window_->poll_events();
    if (virtual_time_)
        return virtual_refresh_.next(requested);

    FlipReport report;
    report.requested = requested;
    report.swapped = clock_->now();
    gl.Finish();
    report.vertical_blank = clock_->now();
    report.source = VblankSource::swap_return;
    // The blank lies between the two.
    report.uncertainty = report.vertical_blank - report.swapped;
    const double elapsed = to_seconds(report.vertical_blank - last_blank_) * virtual_refresh_.refresh_hz();
    const std::int64_t refreshes = std::max<std::int64_t>(1, std::llround(elapsed));
    report.missed_refreshes = static_cast<int>(std::min<std::int64_t>(refreshes - 1, 1 << 30));
    last_refresh_ += refreshes;
    last_blank_ = report.vertical_blank;
    report.refresh = {last_refresh_};
    return report;
}

} // namespace overt
