#include "render/window/window_system.h"

#include <cstdlib>
#include <string_view>

#include <fmt/format.h>
#include <xcb/randr.h>

#include "render/window/xcb_reply.h"

namespace overt {
namespace {

std::string variable(const char* name) {
    const char* const value = std::getenv(name);
    return value ? value : "";
}

xcb_atom_t atom_called(xcb_connection_t* link, std::string_view name) {
    const auto reply = owned(xcb_intern_atom_reply(
        link, xcb_intern_atom(link, 0, static_cast<std::uint16_t>(name.size()), name.data()), nullptr));
    return reply ? reply->atom : static_cast<xcb_atom_t>(XCB_ATOM_NONE);
}

std::string name_of_window(xcb_connection_t* link, xcb_window_t window) {
    for (const char* const property : {"_NET_WM_NAME", "WM_NAME"}) {
        const auto value = owned(xcb_get_property_reply(
            link, xcb_get_property(link, 0, window, atom_called(link, property), XCB_ATOM_ANY, 0, 64),
            nullptr));
        if (value && value->format == 8 && value->value_len > 0)
            return {static_cast<const char*>(xcb_get_property_value(value.get())), value->value_len};
    }
    return {};
}

/// Since version 23.1 Xwayland has an extension of its own; before, its outputs have a name or a property
/// that no other server gives them.
bool is_xwayland_server(xcb_connection_t* link, xcb_window_t root) {
    if (has_extension(link, "XWAYLAND"))
        return true;
    if (!begin_randr(link))
        return false;
    const auto resources = owned(xcb_randr_get_screen_resources_current_reply(
        link, xcb_randr_get_screen_resources_current(link, root), nullptr));
    const xcb_atom_t emulation = atom_called(link, "RANDR Emulation");
    const int count = resources ? xcb_randr_get_screen_resources_current_outputs_length(resources.get()) : 0;
    for (int i = 0; i < count; ++i) {
        const std::uint32_t number = xcb_randr_get_screen_resources_current_outputs(resources.get())[i];
        const auto output = owned(xcb_randr_get_output_info_reply(
            link, xcb_randr_get_output_info(link, number, XCB_CURRENT_TIME), nullptr));
        if (output && name_of(*output).starts_with("XWAYLAND"))
            return true;
        const auto value = owned(xcb_randr_get_output_property_reply(
            link, xcb_randr_get_output_property(link, number, emulation, XCB_ATOM_ANY, 0, 1, 0, 0), nullptr));
        if (value && value->num_items > 0)
            return true;
    }
    return false;
}

void examine_server(WindowSystem& system, xcb_connection_t* link, int screen) {
    system.is_x11 = true;
    // Extended Window Manager Hints, "Compositing managers": the owner of this selection composites.
    const auto owner = owned(xcb_get_selection_owner_reply(
        link, xcb_get_selection_owner(link, atom_called(link, fmt::format("_NET_WM_CM_S{}", screen))),
        nullptr));
    system.has_compositor = owner && owner->owner != XCB_NONE;
    if (system.has_compositor)
        system.compositor = name_of_window(link, owner->owner);
    auto root = xcb_setup_roots_iterator(xcb_get_setup(link));
    for (int i = 0; i < screen && root.rem > 1; ++i)
        xcb_screen_next(&root);
    system.depth = root.rem > 0 ? root.data->root_depth : 0;
    system.is_xwayland = root.rem > 0 && is_xwayland_server(link, root.data->root);
}

} // namespace

std::string WindowSystem::go_between() const {
    if (is_xwayland)
        return "the X server is Xwayland, which shows nothing itself: Wayland's compositor decides when "
               "pictures are lit, and tells no vertical blank of the screen; log in to a session of X11, or "
               "start an X server of its own on the observer's screen";
    if (!is_x11 && is_wayland)
        return "Wayland's compositor decides when pictures are lit, and tells no vertical blank of the "
               "screen; "
               "log in to a session of X11";
    if (!has_compositor)
        return {};
    return fmt::format(
        "a compositor{} owns the screen (selection _NET_WM_CM_Sn) and decides when pictures are lit: turn "
        "the "
        "compositor off for the session: end picom or compton, xfwm4 --replace --compositor=off, KWin "
        "Alt+Shift+F12; where it cannot be switched off (GNOME), log in to a desktop without one",
        compositor.empty() ? "" : " (" + compositor + ")");
}

std::string WindowSystem::description() const {
    std::string text = is_xwayland  ? "Wayland, through Xwayland"
                       : is_wayland ? (is_x11 ? "Wayland, through XWayland" : "Wayland")
                       : is_x11     ? (has_compositor ? "X11 with a compositor" : "X11 without a compositor")
                                    : "none";
    if (has_compositor && !is_xwayland && !compositor.empty())
        text += ", " + compositor;
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
    int screen = 0;
    const XcbLink link(xcb_connect(nullptr, &screen), &xcb_disconnect);
    if (xcb_connection_has_error(link.get()) == 0)
        examine_server(system, link.get(), screen);
    return system;
}

} // namespace overt
