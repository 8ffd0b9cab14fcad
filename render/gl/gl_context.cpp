#include "render/gl/gl_context.h"

#include <fmt/format.h>

#include "experiment/base/error.h"

namespace overt {

namespace {

std::string gl_string(const GladGLContext& gl, GLenum name) {
    const GLubyte* text = gl.GetString(name);
    return text ? reinterpret_cast<const char*>(text) : "";
}

} // namespace

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
