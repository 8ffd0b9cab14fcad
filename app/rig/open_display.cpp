#include "app/rig/open_display.h"

#include "devices/host/clocks.h"
#include "render/gl/headless_context.h"
#include "render/vblank/vblank_clock.h"
#include "render/window/window_system.h"

namespace overt {

bool wants_window(ContextChoice context) {
    return context ? *context == ContextKind::window : display_is_available();
}

OpenDisplay::OpenDisplay(DisplayRequest request) : request_(std::move(request)) {
    if ((request_.headless && !request_.context) || !wants_window(request_.context)) {
        context_ = make_headless_context(request_.context);
        return;
    }
    auto window = std::make_unique<WindowContext>(WindowRequest{
        request_.size_px, request_.title, !request_.windowed && !request_.virtual_time, true,
        request_.bits_per_channel, request_.monitor, request_.refresh_hz, request_.has_two_eyes});
    window_ = window.get();
    context_ = std::move(window);
}

void OpenDisplay::start(DisplayFaults faults, SessionTime start) {
    if (request_.virtual_time)
        clock_ = std::make_unique<VirtualClock>(start);
    else
        clock_ = std::make_unique<SteadyClock>(start);
    if (!window_) {
        auto display = std::make_unique<VirtualDisplay>(*context_, *clock_, request_.refresh_hz,
                                                        request_.bits_per_channel, std::move(faults));
        virtual_refresh_ = &display->refresh();
        surface_ = std::move(display);
        return;
    }
    VblankChoice vblanks;
    if (request_.finds_blanks && is_real())
        vblanks = choose_vblank_clock(vblank_candidates(*window_, *clock_), *clock_);
    auto display = std::make_unique<WindowDisplay>(
        *window_, *clock_, request_.refresh_hz, request_.virtual_time, std::move(faults), std::move(vblanks));
    window_display_ = display.get();
    virtual_refresh_ = request_.virtual_time ? &display->refresh() : nullptr;
    surface_ = std::move(display);
}

} // namespace overt
