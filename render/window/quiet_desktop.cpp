#include "render/window/quiet_desktop.h"

#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>
#include <gio/gio.h>
#include <xcb/screensaver.h>

#include "render/window/xcb_reply.h"

namespace overt {

struct CloseBus {
    void operator()(GDBusConnection* bus) const {
        g_dbus_connection_close_sync(bus, nullptr, nullptr);
        g_object_unref(bus);
    }
};
using Bus = std::unique_ptr<GDBusConnection, CloseBus>;

namespace {

using Weight = ScreenFinding::Weight;

constexpr const char* saver_finding = "screen saver";
constexpr const char* notifications_finding = "notifications";
constexpr const char* reason = "an experiment is running";
constexpr int answer_ms = 2000; ///< a service that does not answer must not keep a session waiting

/// Where the session's bus listens; empty: there is none. None is started for it.
std::string bus_address() {
    if (const char* const told = std::getenv("DBUS_SESSION_BUS_ADDRESS"); told && *told)
        return told;
    const char* const runtime = std::getenv("XDG_RUNTIME_DIR");
    std::error_code ignored;
    if (!runtime || !std::filesystem::exists(std::filesystem::path(runtime) / "bus", ignored))
        return {};
    return fmt::format("unix:path={}/bus", runtime);
}

Bus connect_to_bus() {
    const std::string address = bus_address();
    if (address.empty())
        return nullptr;
    return Bus(g_dbus_connection_new_for_address_sync(
        address.c_str(),
        static_cast<GDBusConnectionFlags>(G_DBUS_CONNECTION_FLAGS_AUTHENTICATION_CLIENT |
                                          G_DBUS_CONNECTION_FLAGS_MESSAGE_BUS_CONNECTION),
        nullptr, nullptr, nullptr));
}

/// Calls a service's Inhibit, which lasts as long as the connection; whether it granted it.
bool inhibit(GDBusConnection* bus, const char* service, const char* object, GVariant* arguments) {
    GVariant* const cookie = g_dbus_connection_call_sync(bus, service, object, service, "Inhibit", arguments,
                                                         G_VARIANT_TYPE("(u)"), G_DBUS_CALL_FLAGS_NONE,
                                                         answer_ms, nullptr, nullptr);
    if (!cookie)
        return false;
    g_variant_unref(cookie);
    return true;
}

/// Until the connection ends.
bool suspend_savers(xcb_connection_t* link) {
    const xcb_query_extension_reply_t* const extension =
        xcb_connection_has_error(link) ? nullptr : xcb_get_extension_data(link, &xcb_screensaver_id);
    if (!extension || !extension->present)
        return false;
    const auto version =
        owned(xcb_screensaver_query_version_reply(link, xcb_screensaver_query_version(link, 1, 1), nullptr));
    if (!version || version->server_major_version < 1 ||
        (version->server_major_version == 1 && version->server_minor_version < 1))
        return false;
    return !owned(xcb_request_check(link, xcb_screensaver_suspend_checked(link, 1)));
}

} // namespace

struct QuietDesktop::Connections {
    XcbLink server{nullptr, &xcb_disconnect};
    Bus bus;
};

QuietDesktop::QuietDesktop(const NativeWindow& window) : connections_(std::make_unique<Connections>()) {
    bool server_is_quiet = false, desktop_is_quiet = false, notes_are_held = false;
    if (!window.x11_server.empty()) {
        connections_->server = link_to(window.x11_server.c_str());
        server_is_quiet = suspend_savers(connections_->server.get());
    }
    if ((connections_->bus = connect_to_bus())) {
        GDBusConnection* const bus = connections_->bus.get();
        desktop_is_quiet = inhibit(bus, "org.freedesktop.ScreenSaver", "/org/freedesktop/ScreenSaver",
                                   g_variant_new("(ss)", "overt", reason)) ||
                           inhibit(bus, "org.freedesktop.ScreenSaver", "/ScreenSaver",
                                   g_variant_new("(ss)", "overt", reason));
        notes_are_held = inhibit(bus, "org.freedesktop.Notifications", "/org/freedesktop/Notifications",
                                 g_variant_new("(ssa{sv})", "overt", reason, nullptr));
    }
    if (server_is_quiet || desktop_is_quiet)
        findings_.push_back({Weight::good, saver_finding,
                             fmt::format("held back by {}", server_is_quiet && desktop_is_quiet
                                                                ? "the X server, with DPMS, and the desktop"
                                                            : server_is_quiet ? "the X server, with DPMS"
                                                                              : "the desktop")});
    else
        findings_.push_back({Weight::risk, saver_finding,
                             "neither the X server nor the desktop holds it back: switch it off, and DPMS "
                             "with `xset s off -dpms`"});
    if (notes_are_held)
        findings_.push_back({Weight::good, notifications_finding, "held back by the desktop"});
    else if (connections_->bus)
        findings_.push_back({Weight::risk, notifications_finding,
                             "the desktop does not hold them back when it is asked: switch on its \"do not "
                             "disturb\""});
}

QuietDesktop::~QuietDesktop() = default;

} // namespace overt
