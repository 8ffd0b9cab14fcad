#include "render/vblank/present_listener.h"

#include <cstdlib>
#include <cstring>

#include <fmt/format.h>

#include "experiment/base/error.h"

namespace overt {
namespace {

/// Why the server does not let a connection listen to the window; empty if it does.
std::string why_deaf(xcb_connection_t* link, std::uint32_t window, xcb_special_event_t*& events) {
    if (xcb_connection_has_error(link))
        return "the X server takes no second connection";
    const xcb_query_extension_reply_t* const extension = xcb_get_extension_data(link, &xcb_present_id);
    if (!extension || !extension->present)
        return "the X server does not offer it";
    std::free(xcb_present_query_version_reply(link, xcb_present_query_version(link, 1, 0), nullptr));
    const std::uint32_t listener = xcb_generate_id(link);
    events = xcb_register_for_special_xge(link, &xcb_present_id, listener, nullptr);
    xcb_generic_error_t* const error =
        xcb_request_check(link, xcb_present_select_input_checked(link, listener, window,
                                                                 XCB_PRESENT_EVENT_MASK_COMPLETE_NOTIFY));
    if (!error)
        return {};
    const int code = error->error_code;
    std::free(error);
    xcb_unregister_for_special_event(link, events);
    return fmt::format("the X server refuses it for the window, with error {}", code);
}

} // namespace

PresentListener::PresentListener(const NativeWindow& window) {
    if (window.x11_server.empty() || window.x11_window == 0)
        throw GraphicsError("the window is not one of X11");
    link_ = xcb_connect(window.x11_server.c_str(), nullptr);
    if (const std::string reason = why_deaf(link_, window.x11_window, events_); !reason.empty()) {
        xcb_disconnect(link_);
        throw GraphicsError(reason);
    }
}

PresentListener::~PresentListener() {
    xcb_unregister_for_special_event(link_, events_);
    xcb_disconnect(link_);
}

bool PresentListener::next(xcb_present_complete_notify_event_t& completion) noexcept {
    while (xcb_generic_event_t* const event = xcb_poll_for_special_event(link_, events_)) {
        std::memcpy(&completion, event, sizeof completion);
        std::free(event);
        if (completion.event_type == XCB_PRESENT_EVENT_COMPLETE_NOTIFY)
            return true;
    }
    return false;
}

} // namespace overt
