#include "render/gl/egl_context.h"

#include <array>

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <fmt/format.h>

#include "experiment/base/error.h"

namespace overt {

namespace {

/// A place where a context may be made: one device, or the surfaceless platform.
struct Place {
    EGLenum platform = 0;
    void* native = nullptr;
    std::string name;
};

template <class Function> Function egl_function(const char* name) {
    return reinterpret_cast<Function>(eglGetProcAddress(name));
}

std::vector<Place> places() {
    std::vector<Place> found;
    const auto query_devices = egl_function<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
    const auto query_string = egl_function<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
    std::array<EGLDeviceEXT, 32> devices{};
    EGLint count = 0;
    if (query_devices && query_devices(static_cast<EGLint>(devices.size()), devices.data(), &count)) {
        for (EGLint i = 0; i < count; ++i) {
            const EGLDeviceEXT device = devices[static_cast<std::size_t>(i)];
            const char* file = query_string ? query_string(device, EGL_DRM_DEVICE_FILE_EXT) : nullptr;
            found.push_back({EGL_PLATFORM_DEVICE_EXT, device,
                             fmt::format("EGL device {}{}", i, file ? fmt::format(" ({})", file) : "")});
        }
    }
    found.push_back({EGL_PLATFORM_SURFACELESS_MESA, nullptr, "EGL surfaceless"});
    return found;
}

} // namespace

struct EglContext::State {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;

    explicit State(const Place& place) {
        const auto platform_display =
            egl_function<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
        if (!platform_display)
            throw GraphicsError("EGL cannot choose a platform (EGL_EXT_platform_base)");
        display = platform_display(place.platform, place.native, nullptr);
        EGLint major = 0, minor = 0;
        if (display == EGL_NO_DISPLAY || !eglInitialize(display, &major, &minor)) {
            display = EGL_NO_DISPLAY;
            throw GraphicsError(fmt::format("no display (EGL error 0x{:04x})", eglGetError()));
        }
        if (!eglBindAPI(EGL_OPENGL_API))
            throw GraphicsError("offers no desktop OpenGL");
        const EGLint config_attributes[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0,
                                            EGL_NONE};
        EGLConfig config = nullptr;
        EGLint configs = 0;
        if (!eglChooseConfig(display, config_attributes, &config, 1, &configs) || configs == 0) {
            throw GraphicsError("has no configuration for OpenGL");
        }
        for (const auto& [gl_major, gl_minor] : {std::pair{4, 5}, std::pair{3, 3}}) {
            const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                         gl_major,
                                         EGL_CONTEXT_MINOR_VERSION,
                                         gl_minor,
                                         EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                         EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                         EGL_NONE};
            context = eglCreateContext(display, config, EGL_NO_CONTEXT, attributes);
            if (context != EGL_NO_CONTEXT)
                break;
        }
        if (context == EGL_NO_CONTEXT) {
            throw GraphicsError(
                fmt::format("gives no core context of 3.3 or later (EGL error 0x{:04x})", eglGetError()));
        }
    }

    ~State() {
        if (context == EGL_NO_CONTEXT)
            return;
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        eglDestroyContext(display, context);
        // The display itself is shared by all users in the process and is left initialised.
    }
};

EglContext::EglContext() {
    std::string refusals;
    bool found_software = false;
    // Two rounds: a graphics processor is worth passing over a software device that comes first.
    for (const bool accept_software : {false, true}) {
        if (accept_software && !found_software)
            break;
        for (const Place& place : places()) {
            try {
                state_ = std::make_unique<State>(place);
                make_current();
                load_functions(reinterpret_cast<GLADloadfunc>(eglGetProcAddress), ContextKind::egl,
                               place.name);
                if (accept_software || !description().is_software)
                    return;
                found_software = true;
            } catch (const GraphicsError& error) {
                if (!accept_software)
                    refusals +=
                        fmt::format("{}{}: {}", refusals.empty() ? "" : "; ", place.name, error.what());
            }
            state_.reset();
        }
    }
    throw GraphicsError(refusals);
}

EglContext::~EglContext() = default;

void EglContext::make_current() {
    if (!eglMakeCurrent(state_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, state_->context)) {
        throw GraphicsError(
            fmt::format("cannot be made current without a surface (EGL error 0x{:04x})", eglGetError()));
    }
}

std::vector<std::string> EglContext::survey() {
    std::vector<std::string> lines;
    for (const Place& place : places()) {
        try {
            const State state(place);
            if (!eglMakeCurrent(state.display, EGL_NO_SURFACE, EGL_NO_SURFACE, state.context)) {
                throw GraphicsError("cannot be made current without a surface");
            }
            const auto get_string = egl_function<const unsigned char* (*)(unsigned)>("glGetString");
            const auto text = [&](unsigned name) { return reinterpret_cast<const char*>(get_string(name)); };
            lines.push_back(fmt::format("{} ({}; {})", text(GL_VERSION), text(GL_RENDERER), place.name));
        } catch (const GraphicsError& error) {
            lines.push_back(fmt::format("refused: {}: {}", place.name, error.what()));
        }
    }
    return lines;
}

} // namespace overt
