#include "render/image/text_layout.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include <fmt/format.h>
#include <pango/pangocairo.h>

#include "experiment/base/error.h"

namespace overt {

namespace {

/// Coverage only: the colours are put in afterwards, in linear light.
class CoverageSurface {
  public:
    explicit CoverageSurface(glm::ivec2 size_px)
        : size_px_(size_px), surface_(cairo_image_surface_create(CAIRO_FORMAT_A8, size_px.x, size_px.y)),
          cairo_(cairo_create(surface_.get())) {}
    cairo_t* cairo() { return cairo_.get(); }

    LinearImage tinted(float grey, float background) {
        cairo_surface_flush(surface_.get());
        const unsigned char* bytes = cairo_image_surface_get_data(surface_.get());
        const std::size_t stride = static_cast<std::size_t>(cairo_image_surface_get_stride(surface_.get()));
        LinearImage image(size_px_);
        for (int y = 0; y < size_px_.y; ++y) {
            for (int x = 0; x < size_px_.x; ++x) {
                const float coverage =
                    static_cast<float>(
                        bytes[static_cast<std::size_t>(y) * stride + static_cast<std::size_t>(x)]) /
                    255.0f;
                image.at(x, y) = glm::vec4(glm::vec3(background + coverage * (grey - background)), coverage);
            }
        }
        return image;
    }

  private:
    struct Release {
        void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
        void operator()(cairo_t* cairo) const { cairo_destroy(cairo); }
    };
    glm::ivec2 size_px_;
    std::unique_ptr<cairo_surface_t, Release> surface_;
    std::unique_ptr<cairo_t, Release> cairo_;
};

struct Unref {
    template <class T> void operator()(T* object) const { g_object_unref(object); }
};
using Layout = std::unique_ptr<PangoLayout, Unref>;

Layout lay_out(cairo_t* cairo, const std::string& text, const TextStyle& style) {
    Layout layout(pango_cairo_create_layout(cairo));
    PangoFontDescription* font = pango_font_description_from_string("DejaVu Sans");
    pango_font_description_set_absolute_size(font, style.line_height_px * PANGO_SCALE);
    pango_layout_set_font_description(layout.get(), font);
    pango_font_description_free(font);
    pango_layout_set_width(layout.get(), style.wrap_width_px * PANGO_SCALE);
    pango_layout_set_wrap(layout.get(), PANGO_WRAP_WORD_CHAR);
    pango_layout_set_alignment(layout.get(), style.centred ? PANGO_ALIGN_CENTER : PANGO_ALIGN_LEFT);
    pango_layout_set_line_spacing(layout.get(), 1.25f);
    pango_layout_set_text(layout.get(), text.data(), static_cast<int>(text.size()));
    return layout;
}

int even(int size) { return (size + 1) & ~1; }

void require_utf8(const std::string& text) {
    if (!g_utf8_validate(text.data(), static_cast<gssize>(text.size()), nullptr))
        throw InputError(fmt::format("a text to be shown is not UTF-8: \"{:.40}\"", text));
}

} // namespace

TextMeasure measure_text(const std::string& text, const TextStyle& style) {
    require_utf8(text);
    CoverageSurface measuring({1, 1});
    const Layout layout = lay_out(measuring.cairo(), text, style);
    TextMeasure measure;
    PangoRectangle extent{};
    pango_layout_get_pixel_extents(layout.get(), nullptr, &extent);
    measure.size_px = {even(extent.width + 4), even(extent.height + 4)};
    measure.lines = pango_layout_get_line_count(layout.get());
    measure.unknown_glyphs = pango_layout_get_unknown_glyphs_count(layout.get());
    for (int line = 0; line < measure.lines; ++line) {
        PangoRectangle of_line{};
        pango_layout_line_get_pixel_extents(pango_layout_get_line_readonly(layout.get(), line), nullptr,
                                            &of_line);
        measure.widest_line_px = std::max(measure.widest_line_px, of_line.width);
    }
    return measure;
}

LinearImage draw_text(const std::string& text, const TextStyle& style) {
    require_utf8(text);
    CoverageSurface measuring({1, 1});
    PangoRectangle extent{};
    const Layout measured = lay_out(measuring.cairo(), text, style);
    pango_layout_get_pixel_extents(measured.get(), nullptr, &extent);
    CoverageSurface surface({even(extent.width + 4), even(extent.height + 4)});
    cairo_translate(surface.cairo(), 2 - extent.x, 2 - extent.y);
    const Layout layout = lay_out(surface.cairo(), text, style);
    pango_cairo_show_layout(surface.cairo(), layout.get());
    return surface.tinted(style.grey, style.background);
}

LinearImage draw_fixation_target(double diameter_px, float grey, float background) {
    const int side = even(static_cast<int>(std::ceil(diameter_px)) + 2);
    CoverageSurface surface({side, side});
    cairo_t* cairo = surface.cairo();
    const double middle = 0.5 * side;
    cairo_arc(cairo, middle, middle, 0.5 * diameter_px, 0.0, 2.0 * std::numbers::pi);
    cairo_fill(cairo);
    // The cross is cut out of the disc, as wide as the dot that is put back: 0.2 of 0.6 degrees.
    cairo_set_operator(cairo, CAIRO_OPERATOR_DEST_OUT);
    cairo_set_line_width(cairo, diameter_px / 3.0);
    for (const bool upright : {false, true}) {
        cairo_move_to(cairo, upright ? middle : 0.0, upright ? 0.0 : middle);
        cairo_line_to(cairo, upright ? middle : side, upright ? side : middle);
        cairo_stroke(cairo);
    }
    cairo_set_operator(cairo, CAIRO_OPERATOR_OVER);
    cairo_arc(cairo, middle, middle, diameter_px / 6.0, 0.0, 2.0 * std::numbers::pi);
    cairo_fill(cairo);
    return surface.tinted(grey, background);
}

bool begins_at_the_right(const std::string& text) {
    return pango_find_base_dir(text.data(), static_cast<int>(text.size())) == PANGO_DIRECTION_RTL;
}

} // namespace overt
