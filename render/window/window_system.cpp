#include "render/window/window_system.h"

#include <cstdlib>
#include <memory>

#include <X11/Xlib.h>
#include <fmt/format.h>

namespace overt {
namespace {

std::string variable(const char* name) {
    const char* const value = std::getenv(name);
    return value ? value : "";
}

} // namespace

std::string WindowSystem::description() const {
    std::string text = is_wayland ? (is_x11 ? "Wayland, through XWayland" : "Wayland")
                       : is_x11   ? (has_compositor ? "X11 with a compositor" : "X11 without a compositor")
                                  : "none";
    if (!desktop.empty() && text != "none")
        text += fmt::format(" ({})", desktop);
    return text;
}

bool display_is_available() { return !variable("DISPLAY").empty() || !variable("WAYLAND_DISPLAY").empty(); }

WindowSystem examine_window_system() {
    WindowSystem system;
    system.desktop = variable("XDG_CURRENT_DESKTOP");
    system.is_wayland = !variable("WAYLAND_DISPLAY").empty() || variable("XDG_SESSION_TYPE") == "wayland";
    if (variable("DISPLAY").empty())
        return system;
    const std::unique_ptr<Display, int (*)(Display*)> server(XOpenDisplay(nullptr), XCloseDisplay);
    if (!server)
        return system;
    system.is_x11 = true;
    // Extended Window Manager Hints, "Compositing managers": the owner of this selection composites.
    const std::string selection = fmt::format("_NET_WM_CM_S{}", XDefaultScreen(server.get()));
    system.has_compositor =
        XGetSelectionOwner(server.get(), XInternAtom(server.get(), selection.c_str(), False)) != None;
    return system;
}

} // namespace overt
