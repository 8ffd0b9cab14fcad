/// Keys that are pressed on a window through the X server, as a keyboard's; also on another program's window.
#pragma once

#include <chrono>
#include <string_view>
#include <thread>

// To be included last: Xlib defines words.
#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <X11/keysym.h>
#undef Status

namespace overt::test {

class Keyboard {
  public:
    /// From here on the process outlives requests to windows that are gone: a program may close its window
    /// between two keys, and Xlib ends a process at an error that nothing handles.
    Keyboard(Display* display, Window window) : display_(display), window_(window) {
        XSetErrorHandler([](Display*, XErrorEvent*) { return 0; });
    }

    /// Presses and releases a key.
    void type(KeySym symbol, unsigned modifiers = 0) { hold(symbol, 1, modifiers); }

    /// Holds a key down until it has come so often.
    void hold(KeySym symbol, int times, unsigned modifiers = 0) {
        hold_code(XKeysymToKeycode(display_, symbol), times, modifiers);
    }
    void hold_code(unsigned code, int times, unsigned modifiers = 0) {
        for (int i = 0; i < times; ++i)
            send(KeyPress, code, modifiers);
        send(KeyRelease, code, modifiers);
        XSync(display_, False);
    }
    /// Presses a key, or goes on holding it, and does not let it go.
    void press(KeySym symbol) {
        send(KeyPress, XKeysymToKeycode(display_, symbol), 0);
        XSync(display_, False);
    }

    /// Moves the pointer there and presses and releases its left button.
    void click(int x_px, int y_px) {
        for (const int kind : {MotionNotify, ButtonPress, ButtonRelease}) {
            XEvent event{};
            event.xbutton.type = kind;
            event.xbutton.display = display_;
            event.xbutton.window = window_;
            event.xbutton.root = XDefaultRootWindow(display_);
            event.xbutton.same_screen = True;
            event.xbutton.x = x_px;
            event.xbutton.y = y_px;
            event.xbutton.time = time_ += 50;
            if (kind != MotionNotify)
                event.xbutton.button = Button1;
            XSendEvent(display_, window_, True, PointerMotionMask | ButtonPressMask | ButtonReleaseMask,
                       &event);
        }
        XSync(display_, False);
    }
    Window window() const { return window_; }

  private:
    void send(int type, unsigned code, unsigned modifiers) {
        XKeyEvent event{};
        event.type = type;
        event.display = display_;
        event.window = window_;
        event.root = XDefaultRootWindow(display_);
        event.same_screen = True;
        event.keycode = code;
        event.state = modifiers;
        event.time = time_ += 50;
        XSendEvent(display_, window_, True, type == KeyPress ? KeyPressMask : KeyReleaseMask,
                   reinterpret_cast<XEvent*>(&event));
    }

    Display* display_;
    Window window_;
    Time time_ = 1000;
};

/// The first window of a size on the screen, once a program has opened one; 0 if none does for half a minute.
inline Window await_window(Display* display) {
    for (int i = 0; i < 600; ++i) {
        Window root = 0, parent = 0, found = 0;
        Window* children = nullptr;
        unsigned count = 0;
        XQueryTree(display, XDefaultRootWindow(display), &root, &parent, &children, &count);
        for (unsigned n = 0; n < count; ++n) {
            XWindowAttributes look{};
            // Helpers of a driver are a pixel large, or not to be seen.
            if (XGetWindowAttributes(display, children[n], &look) != 0 && look.map_state == IsViewable &&
                look.width > 100 && look.c_class == InputOutput)
                found = children[n];
        }
        if (children)
            XFree(children);
        if (found != 0)
            return found;
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return 0;
}

} // namespace overt::test
