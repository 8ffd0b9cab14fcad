#include "render/image/ink_canvas.h"

#include <algorithm>
#include <numbers>

#include <cairo.h>

namespace overt {

namespace {

void round_path(cairo_t* cairo, const InkBox& box, double radius) {
    const double quarter = 0.5 * std::numbers::pi;
    const double right = box.x + box.width, bottom = box.y + box.height;
    cairo_new_sub_path(cairo);
    cairo_arc(cairo, right - radius, box.y + radius, radius, -quarter, 0.0);
    cairo_arc(cairo, right - radius, bottom - radius, radius, 0.0, quarter);
    cairo_arc(cairo, box.x + radius, bottom - radius, radius, quarter, 2.0 * quarter);
    cairo_arc(cairo, box.x + radius, box.y + radius, radius, 2.0 * quarter, 3.0 * quarter);
    cairo_close_path(cairo);
}

} // namespace

void InkCanvas::Release::operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
void InkCanvas::Release::operator()(cairo_t* cairo) const { cairo_destroy(cairo); }

InkCanvas::InkCanvas(glm::ivec2 size_px)
    : size_px_(size_px), surface_(cairo_image_surface_create(CAIRO_FORMAT_A8, size_px.x, size_px.y)),
      cairo_(cairo_create(surface_.get())) {}

void InkCanvas::fill(const InkBox& box, double strength, double radius) {
    round_path(cairo(), box, radius);
    cairo_set_source_rgba(cairo(), 0.0, 0.0, 0.0, strength);
    cairo_fill(cairo());
}

void InkCanvas::outline(const InkBox& box, double strength, double line_px, double radius) {
    round_path(cairo(), box, radius);
    cairo_set_source_rgba(cairo(), 0.0, 0.0, 0.0, strength);
    cairo_set_line_width(cairo(), line_px);
    cairo_stroke(cairo());
}

void InkCanvas::line(glm::dvec2 from, glm::dvec2 to, double strength, double line_px) {
    cairo_set_source_rgba(cairo(), 0.0, 0.0, 0.0, strength);
    cairo_set_line_width(cairo(), line_px);
    cairo_move_to(cairo(), from.x, from.y);
    cairo_line_to(cairo(), to.x, to.y);
    cairo_stroke(cairo());
}

void InkCanvas::ring(glm::dvec2 middle, double radius, double strength, double line_px) {
    cairo_set_source_rgba(cairo(), 0.0, 0.0, 0.0, strength);
    cairo_set_line_width(cairo(), line_px);
    cairo_new_path(cairo());
    cairo_arc(cairo(), middle.x, middle.y, radius, 0.0, 2.0 * std::numbers::pi);
    cairo_stroke(cairo());
}

void InkCanvas::takes_away(bool now) {
    cairo_set_operator(cairo(), now ? CAIRO_OPERATOR_DEST_OUT : CAIRO_OPERATOR_OVER);
}

LinearImage InkCanvas::tinted_part(float grey, float background, glm::ivec2 first, glm::ivec2 end) const {
    const unsigned char* bytes = cairo_image_surface_get_data(surface_.get());
    const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(surface_.get()));
    LinearImage image(end - first);
    for (int y = first.y; y < end.y; ++y) {
        for (int x = first.x; x < end.x; ++x) {
            const unsigned char byte =
                bytes[static_cast<std::size_t>(y) * stride + static_cast<std::size_t>(x)];
            const float coverage = static_cast<float>(byte) / 255.0f;
            image.at(x - first.x, y - first.y) =
                glm::vec4(glm::vec3(background + coverage * (grey - background)), coverage);
        }
    }
    return image;
}

LinearImage InkCanvas::tinted(float grey, float background) const {
    cairo_surface_flush(surface_.get());
    return tinted_part(grey, background, {0, 0}, size_px_);
}

LinearImage InkCanvas::tinted_ink(float grey, float background, glm::ivec2& origin) const {
    cairo_surface_flush(surface_.get());
    const unsigned char* bytes = cairo_image_surface_get_data(surface_.get());
    const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(surface_.get()));
    glm::ivec2 first = size_px_, end(0);
    for (int y = 0; y < size_px_.y; ++y) {
        const unsigned char* row = bytes + static_cast<std::size_t>(y) * stride;
        for (int x = 0; x < size_px_.x; ++x) {
            if (row[x] == 0)
                continue;
            first = glm::min(first, glm::ivec2(x, y));
            end = glm::max(end, glm::ivec2(x + 1, y + 1));
        }
    }
    origin = {0, 0};
    if (end.x == 0)
        return {};
    // Modes that join pixels in pairs begin at even columns.
    origin = {first.x & ~1, first.y & ~1};
    return tinted_part(grey, background, origin, glm::min((end + 1) & ~1, size_px_));
}

} // namespace overt
