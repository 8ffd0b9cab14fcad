#include "render/window/sent_keys.h"

#include <X11/Xlib.h>
#include <X11/keysym.h>

#include "experiment/base/error.h"
#include "render/window/native_window.h"
#include "render/window/window_context.h"

namespace overt {

struct SentKeys::State {
    Display* display = nullptr;
    XKeyEvent event{};

    ~State() {
        if (display)
            XCloseDisplay(display);
    }
};

SentKeys::SentKeys(const WindowContext& window) : state_(std::make_unique<State>()) {
    const NativeWindow native = window.native();
    if (native.x11_server.empty())
        throw GraphicsError("keys can be sent to windows of X only");
    state_->display = XOpenDisplay(native.x11_server.c_str());
    if (!state_->display)
        throw GraphicsError("the X server " + native.x11_server + " takes no further connection");
    XKeyEvent& event = state_->event;
    event.display = state_->display;
    event.window = native.x11_window;
    event.root = DefaultRootWindow(state_->display);
    event.same_screen = True;
    event.keycode = XKeysymToKeycode(state_->display, XK_Right);
    event.time = 1;
}

SentKeys::~SentKeys() = default;

void SentKeys::send(bool down) {
    // GLFW takes a press that is not later than the one before for a copy of it.
    ++state_->event.time;
    XEvent event{};
    event.xkey = state_->event;
    event.type = down ? KeyPress : KeyRelease;
    XSendEvent(state_->display, state_->event.window, True, down ? KeyPressMask : KeyReleaseMask, &event);
    XSync(state_->display, False);
}

} // namespace overt
