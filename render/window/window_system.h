/// What there is between windows and the screen, as far as the system can be asked.
#pragma once

#include <string>

namespace overt {

struct WindowSystem {
    bool is_x11 = false;         ///< an X server answers
    bool is_wayland = false;     ///< the environment says that the desktop is Wayland's
    bool is_xwayland = false;    ///< the X server is Xwayland, by its own word: it shows nothing itself
    bool has_compositor = false; ///< on X11: somebody owns the selection _NET_WM_CM_Sn
    std::string compositor;      ///< what its owner calls itself: "picom"; empty if it does not
    int depth = 0;               ///< on X11, bits of a pixel of the screen: 24, or 30; 0: not known
    std::string desktop;         ///< as XDG_CURRENT_DESKTOP names it; empty if it does not

    /// What else than the X server decides when pictures are shown, as a part of a sentence with its remedy;
    /// empty: nothing that can be seen from here.
    std::string go_between() const;

    /// "X11 with a compositor (GNOME)".
    std::string description() const;
};

/// True if a window system seems to be there (DISPLAY or WAYLAND_DISPLAY is set).
bool display_is_available();

/// Asks the environment, and the X server if there is one. Never throws. Any thread.
WindowSystem examine_window_system();

} // namespace overt
