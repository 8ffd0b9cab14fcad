/// What there is between windows and the screen, as far as the system can be asked.
#pragma once

#include <string>

namespace overt {

struct WindowSystem {
    bool is_x11 = false;         ///< an X server answers
    bool is_wayland = false;     ///< the desktop is Wayland's: windows of X11 reach it through XWayland
    bool has_compositor = false; ///< on X11: somebody owns the selection _NET_WM_CM_Sn
    std::string desktop;         ///< as XDG_CURRENT_DESKTOP names it; empty if it does not

    /// "X11 with a compositor (GNOME)".
    std::string description() const;
};

/// True if a window system seems to be there (DISPLAY or WAYLAND_DISPLAY is set).
bool display_is_available();

/// Asks the environment, and the X server if there is one. Never throws. Any thread.
WindowSystem examine_window_system();

} // namespace overt
