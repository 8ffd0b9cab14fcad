/// One OpenGL context, however it was made. OSMesa, EGL and a window differ in how they begin; everything
/// after is the same.
#pragma once

#include <string>
#include <string_view>

#include <glad/gl.h>
#include <glm/glm.hpp>

#include "experiment/base/enum_names.h"

namespace overt {

enum class ContextKind { osmesa, egl, window };
template <> inline constexpr auto names_of<ContextKind> = enum_names<ContextKind>("osmesa", "egl", "window");

/// What a context says of itself.
struct GlDescription {
    ContextKind kind = ContextKind::osmesa;
    std::string platform; ///< how it was reached, such as "EGL device 0 (/dev/dri/card0)"
    std::string vendor, renderer, version;
    bool is_software = false; ///< drawn by the processor
};

/// A current-able context of OpenGL 3.3 core or later. A context belongs to one thread at a time: the one on
/// which make_current() was called last. Objects made in it must be destroyed on that thread, before it.
class GlContext {
  public:
    virtual ~GlContext() = default;
    GlContext(const GlContext&) = delete;
    GlContext& operator=(const GlContext&) = delete;

    virtual void make_current() = 0;

    const GladGLContext& gl() const { return gl_; }
    const GlDescription& description() const { return description_; }

  protected:
    GlContext() = default;

    /// Fills gl_ and description_ from the context that is current now. Throws GraphicsError if it is older
    /// than 3.3.
    void load_functions(GLADloadfunc loader, ContextKind kind, std::string platform);

  private:
    GladGLContext gl_{};
    GlDescription description_;
};

/// Throws GraphicsError naming `doing` if OpenGL reports an error.
void throw_on_gl_error(const GlContext& context, std::string_view doing);

} // namespace overt
