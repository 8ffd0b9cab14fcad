#include "render/window/screen_watch.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "render/window/screen_check.h"
#include "render/window/screen_output.h"
#include "render/window/window_system.h"

namespace overt {
namespace {

GammaRamp gamma_of(xcb_connection_t* link, std::uint32_t crtc, int screen) {
    GammaRamp ramp;
    ramp.server_gamma = server_gamma(link, screen);
    const auto reply =
        owned(xcb_randr_get_crtc_gamma_reply(link, xcb_randr_get_crtc_gamma(link, crtc), nullptr));
    if (!reply)
        return ramp;
    const auto channel = [](const std::uint16_t* levels, int count) {
        return std::vector<std::uint16_t>(levels, levels + count);
    };
    ramp.red =
        channel(xcb_randr_get_crtc_gamma_red(reply.get()), xcb_randr_get_crtc_gamma_red_length(reply.get()));
    ramp.green = channel(xcb_randr_get_crtc_gamma_green(reply.get()),
                         xcb_randr_get_crtc_gamma_green_length(reply.get()));
    ramp.blue = channel(xcb_randr_get_crtc_gamma_blue(reply.get()),
                        xcb_randr_get_crtc_gamma_blue_length(reply.get()));
    return ramp;
}

std::string compositor_of(const WindowSystem& system) {
    if (!system.has_compositor)
        return {};
    return system.compositor.empty() ? "one without a name" : system.compositor;
}

/// Those of `now` that are not in `before`.
std::vector<std::string> new_ones(const std::vector<std::string>& now,
                                  const std::vector<std::string>& before) {
    std::vector<std::string> found;
    for (const std::string& each : now)
        if (std::ranges::find(before, each) == before.end())
            found.push_back(each);
    return found;
}

} // namespace

std::string ScreenWatch::State::monitor() const {
    if (mode == 0)
        return "nothing at all";
    return fmt::format("{} x {} px{} at {}, {}", width_px, height_px,
                       refresh_hz ? fmt::format(" at {:.2f} Hz", *refresh_hz) : "",
                       fmt::format("({}, {}) of the desktop", x_px, y_px),
                       rotation == XCB_RANDR_ROTATION_ROTATE_0 ? "unturned" : "turned or mirrored");
}

ScreenWatch::ScreenWatch(const NativeWindow& window) : window_(window) {
    if (window_.x11_server.empty())
        return;
    link_ = {xcb_connect(window_.x11_server.c_str(), &screen_), &xcb_disconnect};
    if (xcb_connection_has_error(link_.get()) != 0) {
        link_.reset();
        return;
    }
    has_randr_ = begin_randr(link_.get()) && window_.randr_crtc != 0;
    if (has_randr_)
        xcb_randr_select_input(link_.get(), window_.x11_window,
                               XCB_RANDR_NOTIFY_MASK_CRTC_CHANGE | XCB_RANDR_NOTIFY_MASK_OUTPUT_CHANGE);
    const std::uint32_t wanted[] = {XCB_EVENT_MASK_STRUCTURE_NOTIFY | XCB_EVENT_MASK_VISIBILITY_CHANGE};
    xcb_change_window_attributes(link_.get(), window_.x11_window, XCB_CW_EVENT_MASK, wanted);
    xcb_flush(link_.get());
    before_ = look();
    take_news();
}

ScreenWatch::State ScreenWatch::look() const {
    State state;
    const WindowSystem system = examine_window_system();
    state.compositor = compositor_of(system);
    const auto attributes = owned(xcb_get_window_attributes_reply(
        link_.get(), xcb_get_window_attributes(link_.get(), window_.x11_window), nullptr));
    state.is_shown = attributes && attributes->map_state == XCB_MAP_STATE_VIEWABLE;
    if (!has_randr_)
        return state;
    const auto crtc = owned(xcb_randr_get_crtc_info_reply(
        link_.get(), xcb_randr_get_crtc_info(link_.get(), window_.randr_crtc, XCB_CURRENT_TIME), nullptr));
    if (crtc) {
        state.mode = crtc->mode;
        state.x_px = crtc->x;
        state.y_px = crtc->y;
        state.width_px = crtc->width;
        state.height_px = crtc->height;
        state.rotation = crtc->rotation;
    }
    state.gamma = gamma_of(link_.get(), window_.randr_crtc, screen_);
    ScreenOutput output = examine_output(window_);
    state.refresh_hz = output.refresh_hz;
    state.neighbours = std::move(output.neighbours);
    return state;
}

ScreenWatch::News ScreenWatch::take_news() {
    News news;
    const xcb_query_extension_reply_t* const randr =
        has_randr_ ? xcb_get_extension_data(link_.get(), &xcb_randr_id) : nullptr;
    while (xcb_generic_event_t* const event = xcb_poll_for_event(link_.get())) {
        const auto freed = owned(event);
        const int type = event->response_type & 0x7f; // the highest bit: sent by another client
        if (type == XCB_UNMAP_NOTIFY) {
            news.was_hidden = true;
        } else if (type == XCB_VISIBILITY_NOTIFY) {
            const auto& visibility = reinterpret_cast<const xcb_visibility_notify_event_t&>(*event);
            news.was_covered = news.was_covered || visibility.state != XCB_VISIBILITY_UNOBSCURED;
        } else if (randr && type == randr->first_event + XCB_RANDR_NOTIFY) {
            const auto& told = reinterpret_cast<const xcb_randr_notify_event_t&>(*event);
            if (told.subCode == XCB_RANDR_NOTIFY_CRTC_CHANGE)
                (told.u.cc.crtc == window_.randr_crtc ? news.has_mode_changed : news.has_monitor_changed) =
                    true;
            else
                news.has_monitor_changed = true;
        }
    }
    return news;
}

std::vector<std::string> ScreenWatch::take_changes() {
    std::vector<std::string> changes;
    if (!link_)
        return changes;
    if (xcb_connection_has_error(link_.get()) != 0) {
        link_.reset();
        changes.emplace_back(
            "the X server does not answer any more: what happens to the screen is not known");
        return changes;
    }
    State now = look(); // its questions also bring what the server told meanwhile
    const News news = take_news();
    const bool is_other_mode = now.monitor() != before_.monitor() || now.mode != before_.mode;
    if (is_other_mode)
        changes.push_back(
            fmt::format("the monitor shows {}, where it was {}", now.monitor(), before_.monitor()));
    else if (news.has_mode_changed)
        changes.push_back(
            fmt::format("the monitor's mode was set meanwhile, and is {} as before", now.monitor()));
    if (now.gamma != before_.gamma)
        changes.push_back(fmt::format("the gamma table is {}, where it was {}", describe(now.gamma),
                                      describe(before_.gamma)));
    if (now.compositor != before_.compositor)
        changes.push_back(
            now.compositor.empty()
                ? fmt::format("the compositor ({}) is gone", before_.compositor)
                : fmt::format("a compositor ({}) has taken the screen, and decides when pictures "
                              "are lit",
                              now.compositor));
    const std::vector<std::string> more = new_ones(now.neighbours, before_.neighbours),
                                   fewer = new_ones(before_.neighbours, now.neighbours);
    if (!more.empty())
        changes.push_back(
            fmt::format("{} shows another part of the same X screen now", fmt::join(more, ", ")));
    if (!fewer.empty())
        changes.push_back(
            fmt::format("{} shows no part of the same X screen any more", fmt::join(fewer, ", ")));
    if (more.empty() && fewer.empty() && news.has_monitor_changed && !is_other_mode)
        changes.emplace_back("a monitor was plugged in or out, or set otherwise");
    if (!now.is_shown)
        changes.emplace_back("the session's window is not shown: it was hidden, or made an icon");
    else if (news.was_hidden)
        changes.emplace_back("the session's window was hidden for a time, and is shown again");
    // A server that sets a screen to another size tells of its windows as covered meanwhile.
    else if (news.was_covered && !news.has_mode_changed && !news.has_monitor_changed)
        changes.emplace_back("another window lay over a part of the session's window");
    before_ = std::move(now);
    return changes;
}

} // namespace overt
