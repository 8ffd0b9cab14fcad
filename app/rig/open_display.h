/// A display that is opened: what draws, what keeps the time, and where finished screens go.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "app/cli/context_choice.h"
#include "experiment/session_time.h"
#include "render/vblank/display_surface.h"
#include "render/window/window_context.h"

namespace overt {

struct DisplayRequest {
    ContextChoice context =
        {};                ///< left out: a window where one can be opened, else the best there is in memory
    glm::ivec2 size_px{0}; ///< of a window
    std::string title = "overt";
    double refresh_hz = 60.0;
    int bits_per_channel = 8;
    bool virtual_time = false; ///< nothing is lit for as long as it should be: no window takes a screen over
    bool windowed = false;     ///< a window instead of the whole screen
    std::string monitor = {};  ///< see WindowRequest
    bool headless = false;     ///< no window, unless `context` says so
    bool has_two_eyes = false; ///< a window has a buffer for each eye
    /// In a window in real time, times are those of the best source there is; else of the swaps.
    bool finds_blanks = false;
};

/// Whether a window is opened on this machine for this choice.
bool wants_window(ContextChoice context);

/// Objects that are made in its context must go before it. On the main thread, if it is a window.
class OpenDisplay {
  public:
    /// Opens the window or makes the context in memory. Throws GraphicsError.
    explicit OpenDisplay(DisplayRequest request);

    /// Starts the clock, with `start`, and makes the surface. To be called once, before clock() and
    /// surface(). `faults`: what goes wrong with a display that only keeps time.
    void start(DisplayFaults faults = {}, SessionTime start = {});

    GlContext& context() const { return *context_; }
    WindowContext* window() const { return window_; } ///< the context, if it is a window; else null
    Clock& clock() const { return *clock_; }
    DisplaySurface& surface() const { return *surface_; }
    WindowDisplay* window_display() const { return window_display_; } ///< the surface, if it is a window
    /// What keeps the time of a display that is not there, or in virtual time; else null.
    VirtualRefresh* virtual_refresh() const { return virtual_refresh_; }

    /// A screen lights what is shown, for as long as it should be.
    bool is_real() const { return window_ != nullptr && !request_.virtual_time; }

  private:
    DisplayRequest request_;
    std::unique_ptr<GlContext> context_;
    WindowContext* window_ = nullptr;
    std::unique_ptr<Clock> clock_;
    std::unique_ptr<DisplaySurface> surface_;
    WindowDisplay* window_display_ = nullptr;
    VirtualRefresh* virtual_refresh_ = nullptr;
};

} // namespace overt
