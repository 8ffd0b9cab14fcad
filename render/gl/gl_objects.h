/// OpenGL objects that release themselves: one move-only class each, ready when constructed. Each needs its
/// context to be current when it is made, used and destroyed.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <utility>

#include "render/gl/gl_context.h"

namespace overt {

/// rgb10_a2: a 32-bit word, red in the lowest ten bits. srgba8: codes of sRGB, which shaders read as light.
enum class PixelFormat { rgba8, srgba8, rgb10_a2, rgba16, rgba32f, r32ui };

/// What pixels of a format take.
std::size_t bytes_in(glm::ivec2 size_px, PixelFormat format);

/// A name that OpenGL gave and must get back.
class GlName {
  public:
    using Delete = void (*)(const GladGLContext&, GLuint);
    GlName() = default;
    GlName(const GlContext& context, GLuint name, Delete destroy)
        : context_(&context), name_(name), delete_(destroy) {}
    ~GlName() {
        if (name_)
            delete_(context_->gl(), name_);
    }
    GlName(GlName&& other) noexcept { swap(other); }
    GlName& operator=(GlName&& other) noexcept {
        swap(other);
        return *this;
    }
    GLuint operator*() const { return name_; }
    const GlContext& context() const { return *context_; }

  private:
    void swap(GlName& other) noexcept {
        std::swap(context_, other.context_);
        std::swap(name_, other.name_);
        std::swap(delete_, other.delete_);
    }
    const GlContext* context_ = nullptr;
    GLuint name_ = 0;
    Delete delete_ = nullptr;
};

/// A texture without mipmaps, sampled by nearest texel unless set_linear_filter() is called.
class Texture2D {
  public:
    Texture2D(const GlContext& context, glm::ivec2 size_px, PixelFormat format);

    /// `pixels` row by row, first row at texture coordinate 0, in the format's own component type.
    void upload(std::span<const std::byte> pixels);
    /// Bilinear; repeats horizontally and clamps vertically, as a latitude-longitude picture needs.
    void set_linear_filter_wrapped();
    /// As a picture that lies on a surface: smaller ones are made of it, and read between; or by sharp
    /// texels. `across`, `down`: OpenGL's names for what lies beyond its edges.
    void set_as_picture(GLint across, GLint down, bool is_nearest);
    void bind(int unit) const;

    GLuint name() const { return *name_; }
    glm::ivec2 size_px() const { return size_px_; }

  private:
    GlName name_;
    glm::ivec2 size_px_;
    PixelFormat format_;
};

/// Pages of one size and format in one object: the frame store.
class TextureArray {
  public:
    TextureArray(const GlContext& context, glm::ivec2 size_px, int layers, PixelFormat format);

    /// So many columns and rows of a page at its top left, row by row, in the format's own component type,
    /// from the start of the buffer that is bound to GL_PIXEL_UNPACK_BUFFER; unbinds it.
    void upload_from_buffer(int layer, glm::ivec2 size_px);
    GLuint name() const { return *name_; }
    glm::ivec2 size_px() const { return size_px_; }
    int layers() const { return layers_; }

  private:
    GlName name_;
    glm::ivec2 size_px_;
    int layers_;
    PixelFormat format_;
};

/// Where drawing goes.
class Framebuffer {
  public:
    /// A texture of its own, and a depth buffer of 32 bits if `with_depth`. Throws GraphicsError naming
    /// format and size if OpenGL cannot draw into it.
    Framebuffer(const GlContext& context, glm::ivec2 size_px, PixelFormat format, bool with_depth = false);
    /// Without a texture: attach_layer() comes before use.
    explicit Framebuffer(const GlContext& context);

    void attach_layer(const TextureArray& pages, int layer);
    void bind() const; ///< for drawing and reading, with the viewport of its size
    /// All pixels, bottom row first as OpenGL has it. Binds it.
    void read(PixelFormat format, std::span<std::byte> into) const;
    /// Its own.
    Texture2D& texture() { return *texture_; }
    const Texture2D& texture() const { return *texture_; }
    GLuint name() const { return *name_; }
    glm::ivec2 size_px() const { return size_px_; }

  private:
    GlName name_;
    std::optional<Texture2D> texture_;
    GlName depth_;
    glm::ivec2 size_px_{0};
};

class Buffer {
  public:
    Buffer(const GlContext& context, GLenum target, std::span<const std::byte> content, GLenum usage);
    /// Of a size, its content open.
    Buffer(const GlContext& context, GLenum target, std::size_t bytes, GLenum usage);
    GLuint name() const { return *name_; }

  private:
    GlName name_;
};

class VertexArray {
  public:
    explicit VertexArray(const GlContext& context);
    void bind() const;

  private:
    GlName name_;
};

/// OpenGL's names for how pixels of a format lie in memory.
struct TransferFormat {
    GLenum format, type;
};
TransferFormat transfer_format(PixelFormat format) noexcept;

/// Sets the state in which each pixel shows what is nearest there and nothing else: whatever could mix two
/// surfaces in one pixel is off.
void draw_nearest_only(const GladGLContext& gl) noexcept;

} // namespace overt
