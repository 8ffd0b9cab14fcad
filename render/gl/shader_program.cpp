#include "render/gl/shader_program.h"

#include <fmt/format.h>
#include <glm/gtc/type_ptr.hpp>

#include "experiment/base/error.h"

namespace overt {

namespace {

GlName compile(const GlContext& context, std::string_view program, GLenum stage, std::string_view source) {
    const GladGLContext& gl = context.gl();
    GlName shader(context, gl.CreateShader(stage),
                  [](const GladGLContext& g, GLuint name) { g.DeleteShader(name); });
    const GLchar* text = source.data();
    const auto length = static_cast<GLint>(source.size());
    gl.ShaderSource(*shader, 1, &text, &length);
    gl.CompileShader(*shader);
    GLint compiled = 0;
    gl.GetShaderiv(*shader, GL_COMPILE_STATUS, &compiled);
    if (!compiled) {
        std::string log(4096, '\0');
        GLsizei written = 0;
        gl.GetShaderInfoLog(*shader, static_cast<GLsizei>(log.size()), &written, log.data());
        log.resize(static_cast<std::size_t>(written));
        throw GraphicsError(fmt::format("the {} shader of \"{}\" does not compile on {}:\n{}",
                                        stage == GL_VERTEX_SHADER ? "vertex" : "fragment", program,
                                        context.description().renderer, log));
    }
    return shader;
}

} // namespace

ShaderProgram::ShaderProgram(const GlContext& context, std::string_view name, std::string_view vertex_source,
                             std::string_view fragment_source) {
    const GladGLContext& gl = context.gl();
    const GlName vertex = compile(context, name, GL_VERTEX_SHADER, vertex_source);
    const GlName fragment = compile(context, name, GL_FRAGMENT_SHADER, fragment_source);
    name_ = {context, gl.CreateProgram(),
             [](const GladGLContext& g, GLuint program) { g.DeleteProgram(program); }};
    gl.AttachShader(*name_, *vertex);
    gl.AttachShader(*name_, *fragment);
    gl.LinkProgram(*name_);
    GLint linked = 0;
    gl.GetProgramiv(*name_, GL_LINK_STATUS, &linked);
    if (!linked) {
        std::string log(4096, '\0');
        GLsizei written = 0;
        gl.GetProgramInfoLog(*name_, static_cast<GLsizei>(log.size()), &written, log.data());
        log.resize(static_cast<std::size_t>(written));
        throw GraphicsError(fmt::format("the program \"{}\" does not link:\n{}", name, log));
    }
}

void ShaderProgram::use() const { gl().UseProgram(*name_); }

GLint ShaderProgram::location_of(const char* uniform) const {
    return gl().GetUniformLocation(*name_, uniform);
}

void ShaderProgram::set(const char* uniform, int value) const { gl().Uniform1i(location_of(uniform), value); }
void ShaderProgram::set(const char* uniform, float value) const {
    gl().Uniform1f(location_of(uniform), value);
}
void ShaderProgram::set(const char* uniform, glm::ivec2 value) const {
    gl().Uniform2i(location_of(uniform), value.x, value.y);
}
void ShaderProgram::set(const char* uniform, glm::vec3 value) const {
    gl().Uniform3f(location_of(uniform), value.x, value.y, value.z);
}
void ShaderProgram::set(const char* uniform, std::span<const glm::vec2> values) const {
    gl().Uniform2fv(location_of(uniform), static_cast<GLsizei>(values.size()),
                    glm::value_ptr(values.front()));
}
void ShaderProgram::set(const char* uniform, std::span<const glm::vec4> values) const {
    gl().Uniform4fv(location_of(uniform), static_cast<GLsizei>(values.size()),
                    glm::value_ptr(values.front()));
}
void ShaderProgram::set(const char* uniform, const glm::mat4& value) const {
    gl().UniformMatrix4fv(location_of(uniform), 1, GL_FALSE, glm::value_ptr(value));
}

} // namespace overt
