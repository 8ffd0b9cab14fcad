// GLX_SGI_video_sync: a count of vertical blanks, and a call that waits for one. It needs a current context,
// and keeps the thread that calls it: so it gets a thread, a connection and a context of its own, with a
// window that is never shown.
#include <cstring>

#include <X11/Xlib.h>
#include <X11/Xutil.h>

#include "experiment/base/error.h"
#include "render/vblank/retrace_clock.h"
#include "render/vblank/vblank_sources.h"

namespace overt {
namespace {

/// Types as in the specifications of GLX 1.4 and of the extension.
struct VideoSyncFunctions {
    using GlxContext = void*;
    XVisualInfo* (*choose_visual)(Display*, int screen, int* attributes) = nullptr;
    GlxContext (*create_context)(Display*, XVisualInfo*, GlxContext share, int direct) = nullptr;
    int (*make_current)(Display*, unsigned long drawable, GlxContext) = nullptr;
    void (*destroy_context)(Display*, GlxContext) = nullptr;
    int (*get_count)(unsigned* count) = nullptr;
    int (*await)(int divisor, int remainder, unsigned* count) = nullptr;
};

VideoSyncFunctions functions_of(const NativeWindow& window) {
    if (!window.x11_display || window.glx_drawable == 0)
        throw GraphicsError("the context is not GLX's");
    using Extensions = const char* (*)(void*, int);
    const auto extensions = reinterpret_cast<Extensions>(window.function("glXQueryExtensionsString"));
    auto* const display = static_cast<Display*>(window.x11_display);
    const char* const offered = extensions ? extensions(display, DefaultScreen(display)) : nullptr;
    if (!offered || !std::strstr(offered, "GLX_SGI_video_sync"))
        throw GraphicsError("the server does not offer it");
    VideoSyncFunctions found;
    const auto find = [&](auto& function, const char* name) {
        function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(window.function(name));
        if (!function)
            throw GraphicsError("the library lacks its functions");
    };
    find(found.choose_visual, "glXChooseVisual");
    find(found.create_context, "glXCreateContext");
    find(found.make_current, "glXMakeCurrent");
    find(found.destroy_context, "glXDestroyContext");
    find(found.get_count, "glXGetVideoSyncSGI");
    find(found.await, "glXWaitVideoSyncSGI");
    return found;
}

class VideoSyncWait final : public RetraceWait {
  public:
    VideoSyncWait(const VideoSyncFunctions& functions, std::string server)
        : glx_(functions), server_(std::move(server)) {}
    ~VideoSyncWait() override {
        if (context_)
            glx_.destroy_context(display_, context_);
        if (display_)
            XCloseDisplay(display_); // its window with it
    }

    void begin() override {
        display_ = XOpenDisplay(server_.c_str());
        if (!display_)
            throw GraphicsError("the X server takes no second connection");
        constexpr int rgba = 4; // GLX_RGBA
        int attributes[] = {rgba, 0};
        XVisualInfo* const visual = glx_.choose_visual(display_, DefaultScreen(display_), attributes);
        if (!visual)
            throw GraphicsError("there is no visual for a context of its own");
        XSetWindowAttributes window{};
        window.colormap = XCreateColormap(display_, RootWindow(display_, visual->screen), visual->visual, 0);
        const Window hidden =
            XCreateWindow(display_, RootWindow(display_, visual->screen), 0, 0, 1, 1, 0, visual->depth,
                          InputOutput, visual->visual, CWColormap | CWBorderPixel, &window);
        context_ = glx_.create_context(display_, visual, nullptr, 1);
        XFree(visual);
        if (!context_ || !glx_.make_current(display_, hidden, context_))
            throw GraphicsError("it gets no context of its own");
        if (glx_.get_count(&count_) != 0)
            throw GraphicsError("the driver does not count");
    }

    std::optional<std::uint32_t> next() noexcept override {
        // Waits for the count to become odd or even: with a divisor of 1 some return at once.
        const int remainder = static_cast<int>((count_ + 1) % 2);
        if (glx_.await(2, remainder, &count_) != 0) {
            glx_.make_current(display_, 0, nullptr);
            return std::nullopt;
        }
        return count_;
    }

  private:
    VideoSyncFunctions glx_;
    std::string server_;
    Display* display_ = nullptr;
    VideoSyncFunctions::GlxContext context_ = nullptr;
    unsigned count_ = 0;
};

} // namespace

std::unique_ptr<VblankClock> open_glx_video_sync(const NativeWindow& window, const Clock& clock) {
    return watch_retraces(VblankSource::glx_video_sync,
                          std::make_shared<VideoSyncWait>(functions_of(window), window.x11_server), clock);
}

} // namespace overt
