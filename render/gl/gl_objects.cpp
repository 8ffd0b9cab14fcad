#include "render/gl/gl_objects.h"

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
    case PixelFormat::srgba8:
        return {GL_SRGB8_ALPHA8, GL_RGBA, GL_UNSIGNED_BYTE, 4, "SRGB8_ALPHA8", GL_RGBA};
    case PixelFormat::rgb10_a2:
        return {GL_RGB10_A2, GL_RGBA, GL_UNSIGNED_INT_2_10_10_10_REV, 4, "RGB10_A2", GL_RGBA};
    case PixelFormat::rgba16:
        return {GL_RGBA16, GL_RGBA, GL_UNSIGNED_SHORT, 8, "RGBA16", GL_RGBA};
    case PixelFormat::rgba32f:
        return {GL_RGBA32F, GL_RGBA, GL_FLOAT, 16, "RGBA32F", GL_RGBA};
    case PixelFormat::r32ui:
        return {GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, 4, "R32UI", GL_RED_INTEGER};
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

/// By OpenGL's functions for the kind of object.
template <auto generate, auto destroy> GlName make_name(const GlContext& context) {
    GLuint name = 0;
    (context.gl().*generate)(1, &name);
    return {context, name, [](const GladGLContext& gl, GLuint made) { (gl.*destroy)(1, &made); }};
}
constexpr auto make_texture = make_name<&GladGLContext::GenTextures, &GladGLContext::DeleteTextures>;

void use_nearest_texels(const GladGLContext& gl, GLenum target) {
    gl.TexParameteri(target, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl.TexParameteri(target, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl.TexParameteri(target, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl.TexParameteri(target, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    gl.TexParameteri(target, GL_TEXTURE_MAX_LEVEL, 0);
}

} // namespace

std::size_t bytes_in(glm::ivec2 size_px, PixelFormat format) {
    return gl_format(format).bytes * static_cast<std::size_t>(size_px.x) *
           static_cast<std::size_t>(size_px.y);
}

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
    OVERT_EXPECTS(pixels.size() == bytes_in(size_px_, format_));
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

void Texture2D::set_as_picture(GLint across, GLint down, bool is_nearest) {
    const GladGLContext& gl = name_.context().gl();
    gl.BindTexture(GL_TEXTURE_2D, *name_);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, across);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, down);
    if (is_nearest)
        return;
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 1000);
    gl.GenerateMipmap(GL_TEXTURE_2D);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    throw_on_gl_error(name_.context(), "making smaller ones of a picture");
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

void TextureArray::upload_from_buffer(int layer, glm::ivec2 size_px) {
    const GlFormat pixel = gl_format(format_);
    OVERT_EXPECTS(layer >= 0 && layer < layers_ && glm::all(glm::lessThanEqual(size_px, size_px_)));
    const GladGLContext& gl = name_.context().gl();
    gl.BindTexture(GL_TEXTURE_2D_ARRAY, *name_);
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl.TexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, layer, size_px.x, size_px.y, 1, pixel.format, pixel.type,
                     nullptr);
    gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    throw_on_gl_error(name_.context(), "uploading a page");
}

Framebuffer::Framebuffer(const GlContext& context)
    : name_(make_name<&GladGLContext::GenFramebuffers, &GladGLContext::DeleteFramebuffers>(context)) {}

Framebuffer::Framebuffer(const GlContext& context, glm::ivec2 size_px, PixelFormat format, bool with_depth)
    : Framebuffer(context) {
    const GladGLContext& gl = context.gl();
    texture_.emplace(context, size_px, format);
    size_px_ = size_px;
    gl.BindFramebuffer(GL_FRAMEBUFFER, *name_);
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_->name(), 0);
    if (with_depth) {
        depth_ = make_name<&GladGLContext::GenRenderbuffers, &GladGLContext::DeleteRenderbuffers>(context);
        gl.BindRenderbuffer(GL_RENDERBUFFER, *depth_);
        gl.RenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, size_px_.x, size_px_.y);
        gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, *depth_);
    }
    if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        throw GraphicsError(fmt::format(
            "{} cannot draw into a framebuffer of {} x {} pixels with 1 colour buffers{}",
            context.description().renderer, size_px_.x, size_px_.y, with_depth ? " and depth" : ""));
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

void Framebuffer::read(PixelFormat format, std::span<std::byte> into) const {
    OVERT_EXPECTS(into.size() == bytes_in(size_px_, format));
    const GlFormat pixel = gl_format(format);
    const GladGLContext& gl = name_.context().gl();
    bind();
    gl.ReadBuffer(GL_COLOR_ATTACHMENT0);
    gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl.ReadPixels(0, 0, size_px_.x, size_px_.y, pixel.format, pixel.type, into.data());
    throw_on_gl_error(name_.context(), fmt::format("reading {} x {} {}", size_px_.x, size_px_.y, pixel.name));
}

Buffer::Buffer(const GlContext& context, GLenum target, std::span<const std::byte> content, GLenum usage)
    : Buffer(context, target, content.size(), usage) {
    context.gl().BufferSubData(target, 0, static_cast<GLsizeiptr>(content.size()), content.data());
}

Buffer::Buffer(const GlContext& context, GLenum target, std::size_t bytes, GLenum usage)
    : name_(make_name<&GladGLContext::GenBuffers, &GladGLContext::DeleteBuffers>(context)) {
    const GladGLContext& gl = context.gl();
    gl.BindBuffer(target, *name_);
    gl.BufferData(target, static_cast<GLsizeiptr>(bytes), nullptr, usage);
    throw_on_gl_error(context, fmt::format("making a buffer of {} bytes", bytes));
}

VertexArray::VertexArray(const GlContext& context)
    : name_(make_name<&GladGLContext::GenVertexArrays, &GladGLContext::DeleteVertexArrays>(context)) {}

void VertexArray::bind() const { name_.context().gl().BindVertexArray(*name_); }

void draw_nearest_only(const GladGLContext& gl) noexcept {
    for (const GLenum state : {GL_BLEND, GL_DITHER, GL_MULTISAMPLE, GL_CULL_FACE, GL_SCISSOR_TEST})
        gl.Disable(state);
    gl.Enable(GL_DEPTH_TEST);
    gl.DepthFunc(GL_LESS);
}

} // namespace overt
