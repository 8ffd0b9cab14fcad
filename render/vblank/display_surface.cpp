#include "render/vblank/display_surface.h"

#include <algorithm>
#include <cmath>

#include "experiment/base/error.h"

namespace overt {
namespace {

/// What the kernel's stamps of vertical blanks are good for: it asks the controller for the row until it
/// knows when the blank began to so much (module drm, timestamp_precision_usec).
constexpr SessionDuration kernel_precision = std::chrono::microseconds(20);

/// Of a thread that waits for a blank and reads the clock when it has woken up. An assumption: a machine that
/// is busy wakes it later, which the measurement before a session shows as irregular refreshes.
constexpr SessionDuration wake_up = std::chrono::milliseconds(1);

/// Of a server that makes its vertical blanks with a timer of whole milliseconds.
constexpr SessionDuration server_timer = std::chrono::milliseconds(1);

SessionDuration uncertainty_of(const VblankChoice& vblanks) {
    if (!vblanks.is_real)
        return server_timer;
    return vblanks.clock->source() == VblankSource::glx_video_sync ? wake_up : kernel_precision;
}

} // namespace

FlipReport VirtualDisplay::present(const Framebuffer&) noexcept {
    const SessionTime requested = clock_->now();
    // What a display would show must have been drawn by the time it is lit.
    context_->gl().Finish();
    return refresh_.next(requested);
}

void VirtualDisplay::read(const Framebuffer& canvas, PixelFormat format, std::span<std::byte> into) {
    canvas.read(format, into);
}

WindowDisplay::WindowDisplay(WindowContext& window, Clock& clock, double refresh_hz, bool virtual_time,
                             DisplayFaults faults, VblankChoice vblanks)
    : window_(&window), clock_(&clock), virtual_time_(virtual_time),
      virtual_refresh_(clock, refresh_hz, std::move(faults)), blanks_are_real_(vblanks.is_real),
      refused_sources_(std::move(vblanks.refused)), uncertainty_(uncertainty_of(vblanks)),
      flips_(window, clock, refresh_hz, std::move(vblanks.clock), uncertainty_),
      watch_(virtual_time ? nullptr : SwapWatch::of(window.native())) {
    window.set_swap_interval(virtual_time ? 0 : 1);
}

DisplayTiming WindowDisplay::timing() const {
    return virtual_time_ ? virtual_refresh_.timing()
                         : DisplayTiming{virtual_refresh_.refresh_hz(), flips_.source()};
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

void copy_for_window(const GladGLContext& gl, const Framebuffer& canvas, unsigned int into) noexcept {
    const glm::ivec2 size = canvas.size_px();
    gl.BindFramebuffer(GL_READ_FRAMEBUFFER, canvas.name());
    gl.ReadBuffer(GL_COLOR_ATTACHMENT0);
    gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, into);
    // Turned round here and nowhere else.
    gl.BlitFramebuffer(0, 0, size.x, size.y, 0, size.y, size.x, 0, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void WindowDisplay::draw_into_window(const Framebuffer& canvas) noexcept {
    copy_for_window(window_->gl(), canvas, 0);
}

void WindowDisplay::read(const Framebuffer& canvas, PixelFormat format, std::span<std::byte> into) {
    draw_into_window(canvas);
    const GladGLContext& gl = window_->gl();
    const glm::ivec2 size = canvas.size_px();
    const auto [components, type] = transfer_format(format);
    const std::size_t stride = bytes_in({size.x, 1}, format);
    OVERT_EXPECTS(into.size() == bytes_in(size, format));
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

FlipReport WindowDisplay::present_dark() noexcept {
    OVERT_EXPECTS(!virtual_time_);
    const SessionTime requested = clock_->now();
    flips_.begin();
    const GladGLContext& gl = window_->gl();
    gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    gl.ClearColor(0.0f, 0.0f, 0.0f, 1.0f);
    gl.Clear(GL_COLOR_BUFFER_BIT);
    return flips_.swap(requested);
}

FlipReport WindowDisplay::present_pair(const Framebuffer& left, const Framebuffer& right) noexcept {
    const SessionTime requested = clock_->now();
    if (!virtual_time_)
        flips_.begin();
    const GladGLContext& gl = window_->gl();
    for (const auto& [canvas, buffer] : {std::pair(&left, GL_BACK_LEFT), std::pair(&right, GL_BACK_RIGHT)}) {
        gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
        gl.DrawBuffer(static_cast<GLenum>(buffer));
        draw_into_window(*canvas);
    }
    gl.DrawBuffer(GL_BACK);
    return swapped(requested);
}

FlipReport WindowDisplay::present(const Framebuffer& canvas) noexcept {
    const SessionTime requested = clock_->now();
    if (!virtual_time_)
        flips_.begin();
    draw_into_window(canvas);
    return swapped(requested);
}

FlipReport WindowDisplay::swapped(SessionTime requested) noexcept {
    if (!virtual_time_)
        return flips_.swap(requested);
    window_->swap_buffers();
    window_->poll_events();
    return virtual_refresh_.next(requested);
}

} // namespace overt
