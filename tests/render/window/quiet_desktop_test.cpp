/// Screen savers that stay away while a window of a session lives, and the desktop that is asked for it.
#include "render/window/quiet_desktop.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <thread>

#include <catch2/catch.hpp>
#include <gio/gio.h>
#include <xcb/screensaver.h>

#include "render/window/window_context.h"
#include "render/window/xcb_reply.h"
#include "tests/support/skip.h"
#include "tests/support/virtual_screen.h"

using namespace overt;
using namespace overt::test;
using namespace std::chrono_literals;
using Weight = ScreenFinding::Weight;

namespace {

/// Whether the server's own saver comes within some seconds; it is set to come after one.
bool saver_comes(xcb_connection_t* link) {
    const xcb_window_t root = xcb_setup_roots_iterator(xcb_get_setup(link)).data->root;
    xcb_set_screen_saver(link, 1, 1, XCB_BLANKING_PREFERRED, XCB_EXPOSURES_ALLOWED);
    xcb_force_screen_saver(link, XCB_SCREEN_SAVER_RESET);
    for (int tries = 0; tries < 60; ++tries) {
        std::this_thread::sleep_for(50ms);
        const auto info =
            owned(xcb_screensaver_query_info_reply(link, xcb_screensaver_query_info(link, root), nullptr));
        if (info && info->state == XCB_SCREENSAVER_STATE_ON)
            return true;
    }
    return false;
}

/// A bus of its own, on which a desktop answers to Inhibit and takes what has ended with its connection.
class Desktop {
  public:
    /// `services`: those that it has.
    explicit Desktop(std::vector<std::string> services) : services_(std::move(services)) {
        daemon_ =
            popen("exec dbus-daemon --session --print-address=1 --print-pid=1 --nofork --nopidfile", "r");
        REQUIRE(daemon_);
        std::array<char, 512> line{};
        REQUIRE(std::fgets(line.data(), line.size(), daemon_));
        std::string address(line.data());
        address.erase(address.find_last_not_of('\n') + 1);
        setenv("DBUS_SESSION_BUS_ADDRESS", address.c_str(), 1);
        REQUIRE(std::fscanf(daemon_, "%d", &daemon_pid_) == 1);
        serving_ = std::thread([this, address] { serve(address); });
        while (!is_ready_)
            std::this_thread::sleep_for(5ms);
    }
    ~Desktop() {
        g_main_context_invoke(
            context_,
            [](void* loop) { return g_main_loop_quit(static_cast<GMainLoop*>(loop)), G_SOURCE_REMOVE; },
            loop_);
        serving_.join();
        unsetenv("DBUS_SESSION_BUS_ADDRESS");
        ::kill(daemon_pid_, SIGTERM);
        ::pclose(daemon_);
    }

    std::vector<std::string> asked() {
        const std::lock_guard lock(mutex_);
        return asked_;
    }
    /// Whether those that asked have all gone; waits for it.
    bool is_free_again() {
        for (int tries = 0; tries < 600 && holders_ > 0; ++tries)
            std::this_thread::sleep_for(50ms);
        return holders_ == 0;
    }

  private:
    void serve(const std::string& address) {
        context_ = g_main_context_new();
        g_main_context_push_thread_default(context_);
        loop_ = g_main_loop_new(context_, FALSE);
        GDBusConnection* const bus = g_dbus_connection_new_for_address_sync(
            address.c_str(),
            static_cast<GDBusConnectionFlags>(G_DBUS_CONNECTION_FLAGS_AUTHENTICATION_CLIENT |
                                              G_DBUS_CONNECTION_FLAGS_MESSAGE_BUS_CONNECTION),
            nullptr, nullptr, nullptr);
        GDBusNodeInfo* const node = g_dbus_node_info_new_for_xml(
            "<node><interface name='org.freedesktop.ScreenSaver'><method name='Inhibit'>"
            "<arg type='s' direction='in'/><arg type='s' direction='in'/><arg type='u' direction='out'/>"
            "</method></interface><interface name='org.freedesktop.Notifications'><method name='Inhibit'>"
            "<arg type='s' direction='in'/><arg type='s' direction='in'/><arg type='a{sv}' direction='in'/>"
            "<arg type='u' direction='out'/></method></interface></node>",
            nullptr);
        const GDBusInterfaceVTable calls{&Desktop::called, nullptr, nullptr, {}};
        for (const std::string& service : services_) {
            std::string object = "/" + service;
            std::ranges::replace(object, '.', '/');
            g_dbus_connection_register_object(bus, object.c_str(),
                                              g_dbus_node_info_lookup_interface(node, service.c_str()),
                                              &calls, this, nullptr, nullptr);
            GVariant* const owned_name = g_dbus_connection_call_sync(
                bus, "org.freedesktop.DBus", "/org/freedesktop/DBus", "org.freedesktop.DBus", "RequestName",
                g_variant_new("(su)", service.c_str(), 4U), nullptr, G_DBUS_CALL_FLAGS_NONE, -1, nullptr,
                nullptr);
            g_variant_unref(owned_name);
        }
        is_ready_ = true;
        g_main_loop_run(loop_);
        g_dbus_connection_close_sync(bus, nullptr, nullptr);
        g_object_unref(bus);
        g_dbus_node_info_unref(node);
        g_main_context_pop_thread_default(context_);
        g_main_loop_unref(loop_);
        g_main_context_unref(context_);
    }

    static void called(GDBusConnection* bus, const char* sender, const char*, const char* service,
                       const char*, GVariant* arguments, GDBusMethodInvocation* call, void* self) {
        auto& desktop = *static_cast<Desktop*>(self);
        GVariant* const who = g_variant_get_child_value(arguments, 0);
        {
            const std::lock_guard lock(desktop.mutex_);
            desktop.asked_.push_back(std::string(service) + " for " + g_variant_get_string(who, nullptr));
        }
        g_variant_unref(who);
        ++desktop.holders_;
        g_bus_watch_name_on_connection(
            bus, sender, G_BUS_NAME_WATCHER_FLAGS_NONE, nullptr,
            [](GDBusConnection*, const char*, void* watcher) { --static_cast<Desktop*>(watcher)->holders_; },
            self, nullptr);
        g_dbus_method_invocation_return_value(call, g_variant_new("(u)", 7U));
    }

    std::vector<std::string> services_, asked_;
    std::mutex mutex_;
    std::atomic<int> holders_ = 0;
    std::atomic<bool> is_ready_ = false;
    GMainContext* context_ = nullptr;
    GMainLoop* loop_ = nullptr;
    FILE* daemon_ = nullptr; ///< what it prints
    int daemon_pid_ = 0;
    std::thread serving_;
};

} // namespace

TEST_CASE("a desktop is asked for a quiet screen, and is free again afterwards", "[gl][waits]") {
    if (std::system("command -v dbus-daemon >/dev/null") != 0)
        OVERT_SKIP("no dbus-daemon (packages.txt)");
    Desktop desktop({"org.freedesktop.ScreenSaver", "org.freedesktop.Notifications"});
    {
        const QuietDesktop quiet({});
        CHECK(desktop.asked() == std::vector<std::string>{"org.freedesktop.ScreenSaver for overt",
                                                          "org.freedesktop.Notifications for overt"});
        REQUIRE(quiet.findings().size() == 2);
        CHECK(quiet.findings()[0].finding == "held back by the desktop");
        CHECK(quiet.findings()[1].finding == "held back by the desktop");
    }
    CHECK(desktop.is_free_again());
}

TEST_CASE("a desktop that cannot be asked to be quiet is a risk", "[gl]") {
    if (std::system("command -v dbus-daemon >/dev/null") != 0)
        OVERT_SKIP("no dbus-daemon (packages.txt)");
    const Desktop desktop({"org.freedesktop.ScreenSaver"});
    const QuietDesktop quiet({});
    REQUIRE(quiet.findings().size() == 2);
    CHECK(quiet.findings()[0].weight == Weight::good);
    CHECK(quiet.findings()[1].weight == Weight::risk);
}

TEST_CASE("the server's screen saver does not come while a session's screen is kept, and comes after it",
          "[gl]") {
    const auto screen = VirtualScreen::start(320, 240, 24);
    unsetenv("DBUS_SESSION_BUS_ADDRESS");
    unsetenv("XDG_RUNTIME_DIR");
    WindowContext window({{160, 120}, "quiet"});
    const XcbLink link = link_to(nullptr);
    REQUIRE_FALSE(xcb_connection_has_error(link.get()));
    REQUIRE(saver_comes(link.get()));
    {
        const QuietDesktop quiet(window.native());
        REQUIRE(quiet.findings().size() == 1);
        CHECK(quiet.findings()[0].weight == Weight::good);
        CHECK(quiet.findings()[0].finding == "held back by the X server, with DPMS");
        CHECK_FALSE(saver_comes(link.get()));
    }
    CHECK(saver_comes(link.get()));
}

TEST_CASE("a window knows that another took its keyboard, and that it came back", "[gl]") {
    const auto screen = VirtualScreen::start(320, 240, 24);
    WindowContext window({{160, 120}, "keyboard"});
    const XcbLink link = link_to(nullptr);
    const auto give_to = [&](std::uint32_t other) {
        const auto error =
            owned(xcb_request_check(link.get(), xcb_set_input_focus_checked(link.get(), XCB_INPUT_FOCUS_NONE,
                                                                            other, XCB_CURRENT_TIME)));
        REQUIRE_FALSE(error);
        window.poll_events();
    };
    window.poll_events();
    CHECK_FALSE(window.has_lost_focus());
    give_to(window.native().x11_window);
    CHECK_FALSE(window.has_lost_focus());
    give_to(XCB_INPUT_FOCUS_POINTER_ROOT);
    CHECK(window.has_lost_focus());
    give_to(window.native().x11_window);
    CHECK_FALSE(window.has_lost_focus());
}

TEST_CASE("where nothing can hold a screen saver back, that is a risk with its remedy", "[unit]") {
    unsetenv("DBUS_SESSION_BUS_ADDRESS");
    unsetenv("XDG_RUNTIME_DIR");
    const QuietDesktop quiet({});
    REQUIRE(quiet.findings().size() == 1);
    CHECK(quiet.findings()[0].weight == Weight::risk);
    CHECK(quiet.findings()[0].finding.find("xset s off -dpms") != std::string::npos);
}
