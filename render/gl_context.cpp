#include "render/gl_context.h"

#include <cstdlib>

#include <fmt/format.h>

#include "experiment/error.h"
#include "render/egl_context.h"
#include "render/osmesa_context.h"
#include "render/window_context.h"

namespace overt {

namespace {

std::string gl_string(const GladGLContext& gl, GLenum name) {
    const GLubyte* text = gl.GetString(name);
    return text ? reinterpret_cast<const char*>(text) : "";
}

std::string summary_of(const GlDescription& description) {
    return fmt::format("{} ({}; {})", description.version, description.renderer, description.platform);
}

/// Makes one kind and notes how it went; null if it did not work.
template <class Make>
std::unique_ptr<GlContext> attempt(ContextKind kind, const Make& make,
                                   std::vector<ContextAttempt>& attempts) {
    try {
        std::unique_ptr<GlContext> context = make();
        attempts.push_back({kind, summary_of(context->description())});
        return context;
    } catch (const GraphicsError& error) {
        attempts.push_back({kind, fmt::format("refused: {}", error.what())});
        return nullptr;
    }
}

std::string listed(const std::vector<ContextAttempt>& attempts) {
    std::string lines;
    for (const ContextAttempt& tried : attempts) {
        lines += fmt::format("\n  {}: {}", name_of(tried.kind), tried.outcome);
    }
    return lines;
}

} // namespace

std::string_view name_of(ContextKind kind) {
    switch (kind) {
    case ContextKind::osmesa:
        return "osmesa";
    case ContextKind::egl:
        return "egl";
    case ContextKind::window:
        return "window";
    }
    return "unknown";
}

void GlContext::load_functions(GLADloadfunc loader, ContextKind kind, std::string platform) {
    const int version = gladLoadGLContext(&gl_, loader);
    if (version == 0)
        throw GraphicsError("the OpenGL functions cannot be loaded");
    description_ = {kind, std::move(platform), gl_string(gl_, GL_VENDOR), gl_string(gl_, GL_RENDERER),
                    gl_string(gl_, GL_VERSION)};
    for (const char* software : {"llvmpipe", "softpipe", "swrast", "Software"}) {
        if (description_.renderer.find(software) != std::string::npos)
            description_.is_software = true;
    }
    if (version < GLAD_MAKE_VERSION(3, 3)) {
        throw GraphicsError(fmt::format("OpenGL 3.3 is needed, this is {}", description_.version));
    }
}

std::unique_ptr<GlContext> make_headless_context(std::optional<ContextKind> kind,
                                                 std::vector<ContextAttempt>* attempts) {
    std::vector<ContextAttempt> tried;
    std::unique_ptr<GlContext> context;
    const auto make_egl = [] { return std::make_unique<EglContext>(); };
    const auto make_osmesa = [] { return std::make_unique<OsMesaContext>(); };
    if (kind == ContextKind::egl) {
        context = attempt(ContextKind::egl, make_egl, tried);
    } else if (kind == ContextKind::osmesa) {
        context = attempt(ContextKind::osmesa, make_osmesa, tried);
    } else {
        OVERT_EXPECTS(!kind);
        context = attempt(ContextKind::egl, make_egl, tried);
        // Software EGL has nothing over OSMesa, which needs no display stack at all.
        if (context && context->description().is_software) {
            if (auto osmesa = attempt(ContextKind::osmesa, make_osmesa, tried))
                context = std::move(osmesa);
        } else if (!context) {
            context = attempt(ContextKind::osmesa, make_osmesa, tried);
        }
    }
    if (attempts)
        *attempts = tried;
    if (!context) {
        throw GraphicsError(
            fmt::format("no OpenGL context can be made. Tried:{}\nRemedy: install libosmesa6 and "
                        "libgl1-mesa-dri, or choose another with --context",
                        listed(tried)));
    }
    context->make_current();
    return context;
}

std::vector<ContextAttempt> survey_contexts() {
    std::vector<ContextAttempt> found;
    attempt(
        ContextKind::osmesa, [] { return std::make_unique<OsMesaContext>(); }, found);
    for (const std::string& outcome : EglContext::survey())
        found.push_back({ContextKind::egl, outcome});
    if (display_is_available()) {
        attempt(
            ContextKind::window,
            [] {
                return std::make_unique<WindowContext>(WindowRequest{{64, 64}, "overt", false, false});
            },
            found);
    } else {
        found.push_back(
            {ContextKind::window, "refused: no display (DISPLAY and WAYLAND_DISPLAY are not set)"});
    }
    return found;
}

bool display_is_available() {
    const auto is_set = [](const char* name) {
        const char* value = std::getenv(name);
        return value && *value;
    };
    return is_set("DISPLAY") || is_set("WAYLAND_DISPLAY");
}

void throw_on_gl_error(const GlContext& context, std::string_view doing) {
    const GLenum error = context.gl().GetError();
    if (error == GL_NO_ERROR)
        return;
    const std::string_view name = error == GL_OUT_OF_MEMORY                   ? "out of memory"
                                  : error == GL_INVALID_ENUM                  ? "invalid enumerant"
                                  : error == GL_INVALID_VALUE                 ? "invalid value"
                                  : error == GL_INVALID_OPERATION             ? "invalid operation"
                                  : error == GL_INVALID_FRAMEBUFFER_OPERATION ? "incomplete framebuffer"
                                                                              : "unknown error";
    throw GraphicsError(fmt::format("OpenGL error while {}: {} (0x{:04x})", doing, name, error));
}

} // namespace overt
