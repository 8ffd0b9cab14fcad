/// A linked vertex and fragment shader.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include <glm/glm.hpp>

#include "render/gl/gl_objects.h"

namespace overt {

class ShaderProgram {
  public:
    /// Sources begin with their #version line. Throws GraphicsError with the compiler's log; `name` tells
    /// which program.
    ShaderProgram(const GlContext& context, std::string_view name, std::string_view vertex_source,
                  std::string_view fragment_source);

    void use() const;

    // Uniforms of the program; it must be in use. A name that the shader does not have (or dropped as unused)
    // is ignored.
    void set(const char* uniform, int value) const;
    void set(const char* uniform, float value) const;
    void set(const char* uniform, glm::ivec2 value) const;
    void set(const char* uniform, glm::vec3 value) const;
    void set(const char* uniform, std::span<const glm::vec2> values) const;
    void set(const char* uniform, std::span<const glm::vec4> values) const;
    void set(const char* uniform, const glm::mat4& value) const;

  private:
    GLint location_of(const char* uniform) const;
    const GladGLContext& gl() const { return name_.context().gl(); }
    GlName name_;
};

} // namespace overt
