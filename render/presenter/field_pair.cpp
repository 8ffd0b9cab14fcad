#include "render/presenter/field_pair.h"

#include <algorithm>
#include <cstring>
#include <vector>

#include "render/signal/display_encoder.h"
#include "render/signal/signal_pass.h"

namespace overt {

FieldPair::FieldPair(const GlContext& context, DisplaySurface& surface, const Protocol& protocol)
    : context_(&context), surface_(&surface), stereo_(protocol.stereo),
      leading_(leading_eye(stereo_)), places_{field_of(protocol, Eye::left), field_of(protocol, Eye::right)},
      message_rows_(reserved_rows(protocol.display.output)), fields_{Field(*this, Eye::left),
                                                                     Field(*this, Eye::right)} {
    if (stereo_.kind == StereoKind::mirrors)
        put_background(protocol);
}

Eye FieldPair::leading_eye(const StereoSettings& stereo) {
    return stereo.kind == StereoKind::mirrors && stereo.swapped ? Eye::right : Eye::left;
}

/// What no field covers, where one is moved, stays so.
void FieldPair::put_background(const Protocol& protocol) {
    const glm::ivec2 size_px(protocol.display.width_px, protocol.display.height_px);
    const DisplayEncoder encoder(protocol.display);
    Framebuffer picture(*context_, size_px, encoder.format());
    std::vector<std::byte> bytes(bytes_in(size_px, encoder.format()));
    encoder.encode_background(size_px, bytes);
    picture.texture().upload(bytes);
    if (!encoder.leaves_last_step()) {
        format_ = encoder.format();
        whole_.emplace(std::move(picture));
        return;
    }
    SignalPass last_step(*context_, protocol.display);
    format_ = last_step.format();
    whole_.emplace(*context_, size_px, format_);
    last_step.draw(picture.texture(), *whole_, 0);
}

FieldPair::Part FieldPair::picture_of(Eye eye) const {
    const ImageBox& place = places_[static_cast<std::size_t>(eye)];
    const glm::ivec2 shift = stereo_.shift_px(eye), end = place.size_px;
    // What leaves its half is cut off: the other eye must not see it.
    const glm::ivec2 first = glm::max(glm::ivec2(0, message_rows_), shift);
    const glm::ivec2 last = glm::min(end, glm::ivec2(end.x, end.y) + shift);
    Part part;
    part.to_px = place.origin_px + first;
    part.size_px = last - first;
    part.from_px = first - shift;
    if (part.from_px.y < message_rows_) { // these rows are messages, no picture
        const int rows = message_rows_ - part.from_px.y;
        part.from_px.y += rows;
        part.to_px.y += rows;
        part.size_px.y -= rows;
    }
    if (stereo_.mirrored)
        part.from_px.x = end.x - part.from_px.x - part.size_px.x;
    return part;
}

void FieldPair::put(Eye eye, const Framebuffer& canvas) noexcept {
    const GladGLContext& gl = context_->gl();
    gl.BindFramebuffer(GL_READ_FRAMEBUFFER, canvas.name());
    gl.ReadBuffer(GL_COLOR_ATTACHMENT0);
    gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, whole_->name());
    const Part part = picture_of(eye);
    if (!part.is_empty()) {
        int left = part.to_px.x, right = part.to_px.x + part.size_px.x;
        if (stereo_.mirrored)
            std::swap(left, right);
        gl.BlitFramebuffer(part.from_px.x, part.from_px.y, part.from_px.x + part.size_px.x,
                           part.from_px.y + part.size_px.y, left, part.to_px.y, right,
                           part.to_px.y + part.size_px.y, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    }
    if (message_rows_ > 0 && eye == leading_) {
        const int width = canvas.size_px().x;
        gl.BlitFramebuffer(0, 0, width, message_rows_, 0, 0, width, message_rows_, GL_COLOR_BUFFER_BIT,
                           GL_NEAREST);
    }
}

FlipReport FieldPair::present(Eye eye, const Framebuffer& canvas) noexcept {
    if (whole_)
        put(eye, canvas);
    if (eye != leading_) {
        waiting_ = &canvas;
        return {};
    }
    if (whole_)
        return surface_->present(*whole_);
    return surface_->present_pair(canvas, waiting_ ? *waiting_ : canvas);
}

std::vector<std::byte> FieldPair::read_screen() const {
    std::vector<std::byte> bytes(bytes_in(whole_->size_px(), format_));
    surface_->read(*whole_, format_, bytes);
    return bytes;
}

void FieldPair::read(Eye eye, const Framebuffer& canvas, PixelFormat format, std::span<std::byte> into) {
    if (!whole_) {
        surface_->read(canvas, format, into);
        return;
    }
    put(eye, canvas);
    // What is cut off goes nowhere: it is as it was drawn.
    canvas.read(format, into);
    const glm::ivec2 whole_px = whole_->size_px(), field_px = canvas.size_px();
    std::vector<std::byte> all(bytes_in(whole_px, format));
    surface_->read(*whole_, format, all);
    const std::size_t pixel = bytes_in({1, 1}, format);
    const auto copy = [&](const Part& part, bool mirrored) {
        for (int y = 0; y < part.size_px.y; ++y)
            for (int x = 0; x < part.size_px.x; ++x) {
                const int from_x = mirrored ? part.to_px.x + part.size_px.x - 1 - x : part.to_px.x + x;
                const auto from =
                    static_cast<std::size_t>(part.to_px.y + y) * static_cast<std::size_t>(whole_px.x) +
                    static_cast<std::size_t>(from_x);
                const auto to =
                    static_cast<std::size_t>(part.from_px.y + y) * static_cast<std::size_t>(field_px.x) +
                    static_cast<std::size_t>(part.from_px.x + x);
                std::memcpy(into.data() + to * pixel, all.data() + from * pixel, pixel);
            }
    };
    copy(picture_of(eye), stereo_.mirrored);
    if (eye == leading_)
        copy({{0, 0}, {0, 0}, {field_px.x, message_rows_}}, false);
}

} // namespace overt
