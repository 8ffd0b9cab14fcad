#include "render/image/text_layout.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include <fmt/format.h>
#include <pango/pangocairo.h>

#include "experiment/base/error.h"
#include "render/image/text_markup.h"

namespace overt {

namespace {

struct Unref {
    template <class T> void operator()(T* object) const { g_object_unref(object); }
};
using Layout = std::unique_ptr<PangoLayout, Unref>;

Layout lay_out(cairo_t* cairo, const std::string& text, const TextStyle& style) {
    Layout layout(pango_cairo_create_layout(cairo));
    PangoFontDescription* font = pango_font_description_from_string("DejaVu Sans");
    if (style.bold)
        pango_font_description_set_weight(font, PANGO_WEIGHT_BOLD);
    pango_font_description_set_absolute_size(font, style.line_height_px * PANGO_SCALE);
    pango_layout_set_font_description(layout.get(), font);
    pango_font_description_free(font);
    pango_layout_set_width(layout.get(), style.wrap_width_px * PANGO_SCALE);
    pango_layout_set_wrap(layout.get(), PANGO_WRAP_WORD_CHAR);
    pango_layout_set_alignment(layout.get(), style.centred ? PANGO_ALIGN_CENTER : PANGO_ALIGN_LEFT);
    pango_layout_set_line_spacing(layout.get(), 1.25f);
    if (style.one_line) {
        // The end of what is typed is seen, for that is where the next letter goes.
        pango_layout_set_single_paragraph_mode(layout.get(), TRUE);
        pango_layout_set_ellipsize(layout.get(), PANGO_ELLIPSIZE_START);
    }
    if (style.has_marks) {
        const std::string markup = pango_markup_of(text);
        pango_layout_set_markup(layout.get(), markup.data(), static_cast<int>(markup.size()));
    } else {
        pango_layout_set_text(layout.get(), text.data(), static_cast<int>(text.size()));
    }
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
    InkCanvas measuring({1, 1});
    const Layout layout = lay_out(measuring.cairo(), text, style);
    TextMeasure measure;
    PangoRectangle extent{};
    pango_layout_get_pixel_extents(layout.get(), nullptr, &extent);
    measure.size_px = {even(extent.width + 4), even(extent.height + 4)};
    measure.lines = pango_layout_get_line_count(layout.get());
    measure.unknown_glyphs = pango_layout_get_unknown_glyphs_count(layout.get());
    int of_paragraph = 0;
    for (int line = 0; line < measure.lines; ++line) {
        PangoRectangle of_line{};
        PangoLayoutLine* const laid = pango_layout_get_line_readonly(layout.get(), line);
        pango_layout_line_get_pixel_extents(laid, nullptr, &of_line);
        measure.widest_line_px = std::max(measure.widest_line_px, of_line.width);
        of_paragraph = laid->is_paragraph_start ? 1 : of_paragraph + 1;
        measure.longest_paragraph = std::max(measure.longest_paragraph, of_paragraph);
    }
    return measure;
}

void put_text(InkCanvas& canvas, const std::string& text, const TextStyle& style, glm::ivec2 top_left_px,
              double strength) {
    require_utf8(text);
    cairo_t* const cairo = canvas.cairo();
    const Layout layout = lay_out(cairo, text, style);
    PangoRectangle extent{};
    pango_layout_get_pixel_extents(layout.get(), nullptr, &extent);
    canvas.note_text({static_cast<double>(top_left_px.x), static_cast<double>(top_left_px.y),
                      extent.width + 4.0, extent.height + 4.0});
    cairo_save(cairo);
    cairo_translate(cairo, top_left_px.x + 2 - extent.x, top_left_px.y + 2 - extent.y);
    cairo_set_source_rgba(cairo, 0.0, 0.0, 0.0, strength);
    pango_cairo_show_layout(cairo, layout.get());
    cairo_restore(cairo);
}

void put_caret(InkCanvas& canvas, const std::string& text, const TextStyle& style, glm::ivec2 top_left_px,
               std::size_t before_byte) {
    require_utf8(text);
    const Layout layout = lay_out(canvas.cairo(), text, style);
    PangoRectangle extent{}, strong{};
    pango_layout_get_pixel_extents(layout.get(), nullptr, &extent);
    pango_layout_get_cursor_pos(layout.get(), static_cast<int>(std::min(before_byte, text.size())), &strong,
                                nullptr);
    const double x = top_left_px.x + 2 - extent.x + static_cast<double>(strong.x) / PANGO_SCALE,
                 y = top_left_px.y + 2 - extent.y + static_cast<double>(strong.y) / PANGO_SCALE;
    canvas.line({x, y}, {x, y + static_cast<double>(strong.height) / PANGO_SCALE}, 1.0,
                std::max(1.0, style.line_height_px / 12.0));
}

TextPart lines_around(const std::string& text, const TextStyle& style, std::size_t byte, int lines) {
    require_utf8(text);
    InkCanvas measuring({1, 1});
    const Layout layout = lay_out(measuring.cairo(), text, style);
    const int count = pango_layout_get_line_count(layout.get());
    int here = 0;
    pango_layout_index_to_line_x(layout.get(), static_cast<int>(std::min(byte, text.size())), FALSE, &here,
                                 nullptr);
    const int last = std::max(here, std::min(count, lines) - 1), first = std::max(0, last + 1 - lines);
    const auto begin_of = [&](int line) {
        return static_cast<std::size_t>(pango_layout_get_line_readonly(layout.get(), line)->start_index);
    };
    const PangoLayoutLine* const end = pango_layout_get_line_readonly(layout.get(), last);
    return {begin_of(first), static_cast<std::size_t>(end->start_index + end->length)};
}

LinearImage draw_text(const std::string& text, const TextStyle& style) {
    InkCanvas canvas(measure_text(text, style).size_px);
    put_text(canvas, text, style, {0, 0});
    return canvas.tinted(style.grey, style.background);
}

void write_on(LinearImage& picture, const std::string& text, glm::ivec2 bottom_px) {
    TextStyle style;
    style.wrap_width_px = 100'000;
    style.background = 0.01f;
    constexpr int largest_px = 22;
    style.line_height_px = largest_px;
    const int wide = measure_text(text, style).size_px.x;
    if (wide > picture.size_px.x)
        style.line_height_px = std::max(6, largest_px * picture.size_px.x / wide);
    const LinearImage words = draw_text(text, style);
    const glm::ivec2 origin(bottom_px.x - words.size_px.x / 2, bottom_px.y + 1 - words.size_px.y);
    for (int y = 0; y < words.size_px.y; ++y) {
        for (int x = 0; x < words.size_px.x; ++x) {
            const glm::ivec2 at = origin + glm::ivec2(x, y);
            if (at.x >= 0 && at.y >= 0 && at.x < picture.size_px.x && at.y < picture.size_px.y)
                picture.at(at.x, at.y) = glm::vec4(glm::vec3(words.at(x, y)), 1.0f);
        }
    }
}

LinearImage draw_fixation_target(double diameter_px, float grey, float background) {
    const int side = even(static_cast<int>(std::ceil(diameter_px)) + 2);
    InkCanvas surface({side, side});
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
    InkCanvas canvas({1, 1});
    const Layout layout = lay_out(canvas.cairo(), text, {});
    return pango_layout_get_direction(layout.get(), 0) == PANGO_DIRECTION_RTL;
}

} // namespace overt
