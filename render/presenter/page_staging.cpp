#include "render/presenter/page_staging.h"

#include <fmt/format.h>

#include "experiment/base/error.h"

namespace overt {

PageStaging::PageStaging(const GlContext& context, int places, std::size_t bytes_each)
    : context_(&context), bytes_each_(bytes_each) {
    const auto count = static_cast<std::size_t>(places);
    for (std::size_t place = 0; place < count; ++place)
        buffers_.emplace_back(context, GL_PIXEL_UNPACK_BUFFER, bytes_each, GL_STREAM_DRAW);
    open_.resize(count);
    for (std::size_t place = 0; place < count; ++place)
        map(place);
}

PageStaging::~PageStaging() {
    for (std::size_t place = 0; place < open_.size(); ++place) {
        if (!open_[place].empty())
            unmap(place);
    }
    context_->gl().BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
}

void PageStaging::map(std::size_t place) {
    const GladGLContext& gl = context_->gl();
    gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, buffers_[place].name());
    // What was in it may still be under way to a texture: invalidating it lets the driver give other memory.
    void* memory = gl.MapBufferRange(GL_PIXEL_UNPACK_BUFFER, 0, static_cast<GLsizeiptr>(bytes_each_),
                                     GL_MAP_WRITE_BIT | GL_MAP_INVALIDATE_BUFFER_BIT);
    gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    if (!memory) {
        open_[place] = {};
        throw GraphicsError(fmt::format("the graphics card gives no {:.0f} MB to load a page through",
                                        1e-6 * static_cast<double>(bytes_each_)));
    }
    open_[place] = {static_cast<std::byte*>(memory), bytes_each_};
}

void PageStaging::unmap(std::size_t place) const noexcept {
    const GladGLContext& gl = context_->gl();
    gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, buffers_[place].name());
    gl.UnmapBuffer(GL_PIXEL_UNPACK_BUFFER);
}

void PageStaging::hand_over(int place, TextureArray& to, int layer, glm::ivec2 size_px) {
    const auto index = static_cast<std::size_t>(place);
    OVERT_EXPECTS(index < open_.size() && !open_[index].empty());
    unmap(index); // and leaves it bound: pages come from it
    open_[index] = {};
    to.upload_from_buffer(layer, size_px);
    map(index);
}

} // namespace overt
