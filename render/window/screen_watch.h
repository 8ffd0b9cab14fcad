/// What changes of the observer's screen while a session runs, after all of it was found good.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "render/window/native_window.h"
#include "render/window/window_context.h"
#include "render/window/xcb_reply.h"

namespace overt {

/// Listens to the X server over a connection of its own: the mode of the monitor, its place and rotation
/// (RandR), the gamma table, a compositor, other monitors of the same screen, and whether the window is shown
/// and lies free. What changed and was changed back before anybody looked is told too, but for gamma table
/// and compositor, of which the server sends no news. Sees nothing without an X server. One thread.
class ScreenWatch {
  public:
    /// What is there now is what it was.
    explicit ScreenWatch(const NativeWindow& window);

    /// A sentence for each thing that is not as it was at the last call; each is told once. Asks the server:
    /// some milliseconds, so not between a presentation's first and last flip. Throws nothing.
    std::vector<std::string> take_changes();

  private:
    struct State {
        std::uint32_t mode = 0; ///< RandR's number; 0: the monitor shows nothing
        int x_px = 0, y_px = 0, width_px = 0, height_px = 0;
        int rotation = 0;
        std::optional<double> refresh_hz;
        GammaRamp gamma;
        std::string compositor; ///< empty: none
        std::vector<std::string> neighbours;
        bool is_shown = true;
        std::string monitor() const;
    };
    /// What came and went.
    struct News {
        bool has_mode_changed = false, has_monitor_changed = false, was_hidden = false, was_covered = false;
    };
    State look() const;
    News take_news();

    NativeWindow window_;
    XcbLink link_{nullptr, &xcb_disconnect};
    int screen_ = 0; ///< the X screen's number
    bool has_randr_ = false;
    State before_;
};

} // namespace overt
