/// One OpenGL context, however it was made. OSMesa, EGL and a window differ in how they begin; everything
/// after is the same.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glad/gl.h>
#include <glm/glm.hpp>

namespace overt {

enum class ContextKind { osmesa, egl, window };
std::string_view name_of(ContextKind kind);

/// What a context says of itself.
struct GlDescription {
    ContextKind kind = ContextKind::osmesa;
    std::string platform; ///< how it was reached, such as «EGL device 0 (/dev/dri/card0)»
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

/// One attempt to make a context, for the messages.
struct ContextAttempt {
    ContextKind kind;
    std::string outcome; ///< «works: …» or why it does not
};

/// Makes a context that needs no window. With a kind, that one or a GraphicsError that says why not and what
/// was tried; without, EGL where a graphics processor is behind it, else OSMesa.
std::unique_ptr<GlContext> make_headless_context(std::optional<ContextKind> kind,
                                                 std::vector<ContextAttempt>* attempts = nullptr);

/// Tries each kind and says what it offers. Never throws; a context that was made is destroyed again.
std::vector<ContextAttempt> survey_contexts();

/// True if a window system seems to be there (DISPLAY or WAYLAND_DISPLAY is set).
bool display_is_available();

/// Throws GraphicsError naming `doing` if OpenGL reports an error.
void throw_on_gl_error(const GlContext& context, std::string_view doing);

} // namespace overt
