#include "render/gl/gl_objects.h"

#include <vector>

#include <fmt/format.h>

#include "experiment/base/error.h"

namespace overt {

namespace {

struct GlFormat {
    GLint internal;
    GLenum format, type;
    std::size_t bytes;
    const char* name;
    GLenum kept_as; ///< the components' order that the driver is asked to keep
};

GlFormat gl_format(PixelFormat format) noexcept {
    switch (format) {
    case PixelFormat::rgba8:
        // In the order of the framebuffers of window systems, so that a picture goes into a window as a plain
        // copy of memory: with Mesa's software renderer a twentieth of the time. Only a format without a size
        // leaves the choice to the order; Texture2D and TextureArray see that 8 bits come of it.
        return {GL_RGBA, GL_RGBA, GL_UNSIGNED_BYTE, 4, "RGBA8", GL_BGRA};
    case PixelFormat::rgb10_a2:
        return {GL_RGB10_A2, GL_RGBA, GL_UNSIGNED_INT_2_10_10_10_REV, 4, "RGB10_A2", GL_RGBA};
    case PixelFormat::rgba16:
        return {GL_RGBA16, GL_RGBA, GL_UNSIGNED_SHORT, 8, "RGBA16", GL_RGBA};
    case PixelFormat::rgba32f:
        return {GL_RGBA32F, GL_RGBA, GL_FLOAT, 16, "RGBA32F", GL_RGBA};
    case PixelFormat::r32ui:
        return {GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, 4, "R32UI", GL_RED_INTEGER};
    case PixelFormat::depth32f:
        return {GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT, 4, "DEPTH32F", GL_DEPTH_COMPONENT};
    }
    return {};
}

/// Throws GraphicsError if the texture bound to `target` has other than the 8 bits a channel asked for.
void expect_depth(const GlContext& context, GLenum target, PixelFormat format) {
    if (format != PixelFormat::rgba8)
        return;
    for (const GLenum channel :
         {GL_TEXTURE_RED_SIZE, GL_TEXTURE_GREEN_SIZE, GL_TEXTURE_BLUE_SIZE, GL_TEXTURE_ALPHA_SIZE}) {
        GLint bits = 0;
        context.gl().GetTexLevelParameteriv(target, 0, channel, &bits);
        if (bits != 8) {
            throw GraphicsError(fmt::format("{} keeps pictures of {} bits per channel where 8 are needed",
                                            context.description().renderer, bits));
        }
    }
}

GlName make_texture(const GlContext& context) {
    GLuint name = 0;
    context.gl().GenTextures(1, &name);
    return {context, name, [](const GladGLContext& gl, GLuint texture) { gl.DeleteTextures(1, &texture); }};
}

void use_nearest_texels(const GladGLContext& gl, GLenum target) {
    gl.TexParameteri(target, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl.TexParameteri(target, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl.TexParameteri(target, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl.TexParameteri(target, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    gl.TexParameteri(target, GL_TEXTURE_MAX_LEVEL, 0);
}

GlName make_framebuffer(const GlContext& context) {
    GLuint name = 0;
    context.gl().GenFramebuffers(1, &name);
    return {context, name,
            [](const GladGLContext& gl, GLuint framebuffer) { gl.DeleteFramebuffers(1, &framebuffer); }};
}

} // namespace

std::size_t bytes_per_pixel(PixelFormat format) { return gl_format(format).bytes; }

TransferFormat transfer_format(PixelFormat format) noexcept {
    const GlFormat pixel = gl_format(format);
    return {pixel.format, pixel.type};
}

Texture2D::Texture2D(const GlContext& context, glm::ivec2 size_px, PixelFormat format)
    : name_(make_texture(context)), size_px_(size_px), format_(format) {
    const GladGLContext& gl = context.gl();
    const GlFormat pixel = gl_format(format);
    gl.BindTexture(GL_TEXTURE_2D, *name_);
    use_nearest_texels(gl, GL_TEXTURE_2D);
    gl.TexImage2D(GL_TEXTURE_2D, 0, pixel.internal, size_px.x, size_px.y, 0, pixel.kept_as, pixel.type,
                  nullptr);
    throw_on_gl_error(context,
                      fmt::format("making a texture of {} x {} {}", size_px.x, size_px.y, pixel.name));
    expect_depth(context, GL_TEXTURE_2D, format);
}

void Texture2D::upload(std::span<const std::byte> pixels) {
    const GlFormat pixel = gl_format(format_);
    OVERT_EXPECTS(pixels.size() ==
                  pixel.bytes * static_cast<std::size_t>(size_px_.x) * static_cast<std::size_t>(size_px_.y));
    const GladGLContext& gl = name_.context().gl();
    gl.BindTexture(GL_TEXTURE_2D, *name_);
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, size_px_.x, size_px_.y, pixel.format, pixel.type, pixels.data());
    throw_on_gl_error(name_.context(), "uploading a texture");
}

void Texture2D::set_linear_filter_wrapped() {
    const GladGLContext& gl = name_.context().gl();
    gl.BindTexture(GL_TEXTURE_2D, *name_);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
}

void Texture2D::bind(int unit) const {
    const GladGLContext& gl = name_.context().gl();
    gl.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    gl.BindTexture(GL_TEXTURE_2D, *name_);
}

TextureArray::TextureArray(const GlContext& context, glm::ivec2 size_px, int layers, PixelFormat format)
    : name_(make_texture(context)), size_px_(size_px), layers_(layers), format_(format) {
    const GladGLContext& gl = context.gl();
    const GlFormat pixel = gl_format(format);
    gl.BindTexture(GL_TEXTURE_2D_ARRAY, *name_);
    use_nearest_texels(gl, GL_TEXTURE_2D_ARRAY);
    gl.TexImage3D(GL_TEXTURE_2D_ARRAY, 0, pixel.internal, size_px.x, size_px.y, layers, 0, pixel.kept_as,
                  pixel.type, nullptr);
    throw_on_gl_error(context, fmt::format("making a frame store of {} pages of {} x {} {}", layers,
                                           size_px.x, size_px.y, pixel.name));
    expect_depth(context, GL_TEXTURE_2D_ARRAY, format);
}

void TextureArray::upload(int layer, std::span<const std::byte> pixels) {
    upload(layer, pixels.data(), pixels.size());
}

void TextureArray::upload_from_buffer(int layer, std::size_t bytes) {
    upload(layer, nullptr, bytes);
    name_.context().gl().BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
}

void TextureArray::upload(int layer, const void* pixels_or_offset, std::size_t bytes) {
    const GlFormat pixel = gl_format(format_);
    OVERT_EXPECTS(layer >= 0 && layer < layers_ &&
                  bytes == pixel.bytes * static_cast<std::size_t>(size_px_.x) *
                               static_cast<std::size_t>(size_px_.y));
    const GladGLContext& gl = name_.context().gl();
    gl.BindTexture(GL_TEXTURE_2D_ARRAY, *name_);
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl.TexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, layer, size_px_.x, size_px_.y, 1, pixel.format, pixel.type,
                     pixels_or_offset);
    throw_on_gl_error(name_.context(), "uploading a page");
}

Framebuffer::Framebuffer(const GlContext& context) : name_(make_framebuffer(context)) {}

Framebuffer::Framebuffer(const GlContext& context, std::initializer_list<const Texture2D*> colours,
                         bool with_depth)
    : Framebuffer(context) {
    const GladGLContext& gl = context.gl();
    OVERT_EXPECTS(colours.size() > 0);
    size_px_ = (*colours.begin())->size_px();
    gl.BindFramebuffer(GL_FRAMEBUFFER, *name_);
    std::vector<GLenum> draw_buffers;
    for (const Texture2D* colour : colours) {
        const GLenum attachment = GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(draw_buffers.size());
        gl.FramebufferTexture2D(GL_FRAMEBUFFER, attachment, GL_TEXTURE_2D, colour->name(), 0);
        draw_buffers.push_back(attachment);
    }
    gl.DrawBuffers(static_cast<GLsizei>(draw_buffers.size()), draw_buffers.data());
    if (with_depth) {
        GLuint depth = 0;
        gl.GenRenderbuffers(1, &depth);
        depth_ = {context, depth,
                  [](const GladGLContext& g, GLuint buffer) { g.DeleteRenderbuffers(1, &buffer); }};
        gl.BindRenderbuffer(GL_RENDERBUFFER, depth);
        gl.RenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, size_px_.x, size_px_.y);
        gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth);
    }
    if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        throw GraphicsError(
            fmt::format("{} cannot draw into a framebuffer of {} x {} pixels with {} colour buffers{}",
                        context.description().renderer, size_px_.x, size_px_.y, colours.size(),
                        with_depth ? " and depth" : ""));
    }
}

void Framebuffer::attach_layer(const TextureArray& pages, int layer) {
    const GladGLContext& gl = name_.context().gl();
    size_px_ = pages.size_px();
    gl.BindFramebuffer(GL_FRAMEBUFFER, *name_);
    gl.FramebufferTextureLayer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, pages.name(), 0, layer);
}

void Framebuffer::bind() const {
    const GladGLContext& gl = name_.context().gl();
    gl.BindFramebuffer(GL_FRAMEBUFFER, *name_);
    gl.Viewport(0, 0, size_px_.x, size_px_.y);
}

Buffer::Buffer(const GlContext& context, GLenum target, std::span<const std::byte> content, GLenum usage)
    : Buffer(context, target, content.size(), usage) {
    context.gl().BufferSubData(target, 0, static_cast<GLsizeiptr>(content.size()), content.data());
}

Buffer::Buffer(const GlContext& context, GLenum target, std::size_t bytes, GLenum usage) {
    const GladGLContext& gl = context.gl();
    GLuint name = 0;
    gl.GenBuffers(1, &name);
    name_ = {context, name, [](const GladGLContext& g, GLuint buffer) { g.DeleteBuffers(1, &buffer); }};
    gl.BindBuffer(target, name);
    gl.BufferData(target, static_cast<GLsizeiptr>(bytes), nullptr, usage);
    throw_on_gl_error(context, fmt::format("making a buffer of {} bytes", bytes));
}

VertexArray::VertexArray(const GlContext& context) {
    GLuint name = 0;
    context.gl().GenVertexArrays(1, &name);
    name_ = {context, name, [](const GladGLContext& gl, GLuint array) { gl.DeleteVertexArrays(1, &array); }};
}

void VertexArray::bind() const { name_.context().gl().BindVertexArray(*name_); }

void read_pixels(const GlContext& context, int index, glm::ivec2 origin_px, glm::ivec2 size_px,
                 PixelFormat format, std::span<std::byte> into) {
    const GlFormat pixel = gl_format(format);
    OVERT_EXPECTS(into.size() ==
                  pixel.bytes * static_cast<std::size_t>(size_px.x) * static_cast<std::size_t>(size_px.y));
    const GladGLContext& gl = context.gl();
    gl.ReadBuffer(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(index));
    gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl.ReadPixels(origin_px.x, origin_px.y, size_px.x, size_px.y, pixel.format, pixel.type, into.data());
    throw_on_gl_error(context, fmt::format("reading {} x {} {}", size_px.x, size_px.y, pixel.name));
}

void draw_nearest_only(const GladGLContext& gl) noexcept {
    for (const GLenum state : {GL_BLEND, GL_DITHER, GL_MULTISAMPLE, GL_CULL_FACE, GL_SCISSOR_TEST})
        gl.Disable(state);
    gl.Enable(GL_DEPTH_TEST);
    gl.DepthFunc(GL_LESS);
}

} // namespace overt
