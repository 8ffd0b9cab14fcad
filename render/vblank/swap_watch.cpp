#include "render/vblank/swap_watch.h"

#include <cstdlib>

#include "experiment/base/error.h"

namespace overt {

std::unique_ptr<SwapWatch> SwapWatch::of(const NativeWindow& window) try {
    return std::unique_ptr<SwapWatch>(new SwapWatch(window));
} catch (const GraphicsError&) {
    return nullptr;
}

std::optional<SwapModes> SwapWatch::take() noexcept {
    // Once the server has answered anything, all that it has told before has arrived.
    xcb_connection_t* const link = listener_.link();
    std::free(xcb_get_input_focus_reply(link, xcb_get_input_focus(link), nullptr));
    SwapModes modes;
    for (xcb_present_complete_notify_event_t completion; listener_.next(completion);) {
        if (completion.kind != XCB_PRESENT_COMPLETE_KIND_PIXMAP)
            continue;
        switch (completion.mode) {
        case XCB_PRESENT_COMPLETE_MODE_FLIP:
            ++modes.flipped;
            break;
        case XCB_PRESENT_COMPLETE_MODE_COPY:
            ++modes.copied;
            break;
        case XCB_PRESENT_COMPLETE_MODE_SKIP:
            ++modes.skipped;
            break;
        default: // "suboptimal copy", the only other one there is (version 1.2)
            ++modes.suboptimal_copied;
        }
    }
    return xcb_connection_has_error(link) ? std::nullopt : std::optional(modes);
}

} // namespace overt
