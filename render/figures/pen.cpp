#include "render/figures/pen.h"

#include <algorithm>
#include <memory>
#include <numbers>

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <pango/pangocairo.h>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/whole_file.h"

namespace overt {
namespace {

constexpr double points_per_mm = 72.0 / 25.4;

using Layout = std::unique_ptr<PangoLayout, decltype(&g_object_unref)>;

// A page is scaled to millimetres: letters are given in them. `context` is used up.
Layout layout_of(PangoContext* context, std::string_view text, double points) {
    // No hinting: widths are those of the print, not of a screen.
    cairo_font_options_t* options = cairo_font_options_create();
    cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
    cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
    pango_cairo_context_set_font_options(context, options);
    cairo_font_options_destroy(options);
    // A unit is a millimetre: letters would otherwise stand at whole ones of a screen.
    pango_context_set_round_glyph_positions(context, FALSE);
    Layout layout(pango_layout_new(context), &g_object_unref);
    g_object_unref(context);
    const std::unique_ptr<PangoFontDescription, decltype(&pango_font_description_free)> font(
        pango_font_description_from_string("DejaVu Sans"), &pango_font_description_free);
    pango_font_description_set_absolute_size(font.get(), points / points_per_mm * PANGO_SCALE);
    pango_layout_set_font_description(layout.get(), font.get());
    const std::unique_ptr<char, decltype(&g_free)> valid(
        g_utf8_make_valid(text.data(), static_cast<gssize>(text.size())), &g_free);
    std::string line(valid.get());
    std::replace_if(
        line.begin(), line.end(), [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
    pango_layout_set_single_paragraph_mode(layout.get(), TRUE);
    pango_layout_set_text(layout.get(), line.data(), static_cast<int>(line.size()));
    return layout;
}

// To be measured, without a page.
Layout layout_of(std::string_view text, double points) {
    return layout_of(pango_font_map_create_context(pango_cairo_font_map_get_default()), text, points);
}

TextExtent measured(PangoLayout* layout) {
    PangoRectangle extent;
    pango_layout_get_extents(layout, nullptr, &extent);
    const double above = static_cast<double>(pango_layout_get_baseline(layout)) / PANGO_SCALE;
    return {static_cast<double>(extent.width) / PANGO_SCALE, above,
            static_cast<double>(extent.height) / PANGO_SCALE - above};
}

class CairoPen final : public FigurePen {
  public:
    explicit CairoPen(cairo_t* cairo) : cairo_(cairo) {
        cairo_scale(cairo_, points_per_mm, points_per_mm);
        cairo_set_line_join(cairo_, CAIRO_LINE_JOIN_ROUND);
    }
    void line(glm::dvec2 from, glm::dvec2 to, FigureColour colour, double width_mm) override {
        path({from, to}, colour, width_mm, {});
    }
    void path(const std::vector<glm::dvec2>& points, FigureColour colour, double width_mm,
              const std::vector<double>& dash_mm) override {
        take(colour);
        cairo_set_line_width(cairo_, width_mm);
        cairo_set_dash(cairo_, dash_mm.data(), static_cast<int>(dash_mm.size()), 0.0);
        outline(points);
        cairo_stroke(cairo_);
    }
    void polygon(const std::vector<glm::dvec2>& corners, FigureColour colour) override {
        take(colour);
        outline(corners);
        cairo_fill(cairo_);
    }
    void box(glm::dvec2 corner, glm::dvec2 size, FigureColour colour) override {
        take(colour);
        cairo_rectangle(cairo_, corner.x, corner.y, size.x, size.y);
        cairo_fill(cairo_);
    }
    void dot(glm::dvec2 centre, double radius_mm, FigureColour colour, double opacity) override {
        take(colour, opacity);
        cairo_arc(cairo_, centre.x, centre.y, radius_mm, 0.0, 2.0 * std::numbers::pi);
        cairo_fill(cairo_);
    }
    void text(glm::dvec2 at, std::string_view text, double points, TextAlign align, FigureColour colour,
              bool upwards) override {
        take(colour);
        const Layout layout = layout_of(pango_cairo_create_context(cairo_), text, points);
        const TextExtent extent = measured(layout.get());
        cairo_save(cairo_);
        cairo_translate(cairo_, at.x, at.y);
        if (upwards)
            cairo_rotate(cairo_, -0.5 * std::numbers::pi);
        const double share = align == TextAlign::left ? 0.0 : align == TextAlign::centre ? 0.5 : 1.0;
        cairo_move_to(cairo_, -share * extent.width, -extent.above);
        pango_cairo_show_layout(cairo_, layout.get());
        cairo_restore(cairo_);
    }

  private:
    void outline(const std::vector<glm::dvec2>& points) {
        for (const glm::dvec2& point : points)
            cairo_line_to(cairo_, point.x, point.y);
    }
    // Colour, and a path that does not begin where the last text was.
    void take(FigureColour colour, double opacity = 1.0) {
        cairo_new_path(cairo_);
        cairo_set_source_rgba(cairo_, colour[0], colour[1], colour[2], opacity);
    }
    cairo_t* cairo_;
};

cairo_status_t append(void* text, const unsigned char* bytes, unsigned count) {
    static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(bytes), count);
    return CAIRO_STATUS_SUCCESS;
}

std::string drawn(cairo_surface_t* (*make)(cairo_write_func_t, void*, double, double), glm::dvec2 size_mm,
                  const std::function<void(FigurePen&)>& draw, bool is_pdf) {
    std::string bytes;
    cairo_surface_t* surface = make(&append, &bytes, size_mm.x * points_per_mm, size_mm.y * points_per_mm);
    // The same figure is the same file.
    if (is_pdf)
        cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATE_DATE, "1970-01-01T00:00:00Z");
    cairo_t* cairo = cairo_create(surface);
    CairoPen pen(cairo);
    draw(pen);
    cairo_show_page(cairo);
    const cairo_status_t status = cairo_status(cairo);
    cairo_destroy(cairo);
    cairo_surface_finish(surface);
    cairo_surface_destroy(surface);
    if (status != CAIRO_STATUS_SUCCESS)
        throw Error(fmt::format("a figure cannot be drawn: {}", cairo_status_to_string(status)));
    return bytes;
}

// Cairo numbers the surfaces of a program; a figure's name for itself must not depend on those before.
std::string without_numbers(std::string svg) {
    constexpr std::string_view name = "\"surface";
    for (std::size_t at = svg.find(name); at != std::string::npos; at = svg.find(name, at + 1)) {
        const std::size_t begin = at + name.size(), end = svg.find_first_not_of("0123456789", begin);
        svg.erase(begin, end - begin);
    }
    return svg;
}

} // namespace

FigureColour figure_colour(std::size_t number) {
    static constexpr FigureColour colours[] = {
        {0.0, 0.447, 0.698},   {0.902, 0.624, 0.0}, {0.0, 0.620, 0.451}, {0.8, 0.475, 0.655},
        {0.337, 0.706, 0.914}, {0.835, 0.369, 0.0}, {0.478, 0.435, 0.0}, {0.3, 0.3, 0.3}};
    static_assert(std::size(colours) == figure_colours);
    return colours[number % figure_colours];
}

TextExtent extent_of(std::string_view text, double points) { return measured(layout_of(text, points).get()); }

std::vector<std::string> broken_into_lines(std::string_view text, double points, double width_mm) {
    const Layout layout = layout_of(text, points);
    pango_layout_set_width(layout.get(), static_cast<int>(width_mm * PANGO_SCALE));
    pango_layout_set_wrap(layout.get(), PANGO_WRAP_WORD_CHAR);
    const std::string_view all(pango_layout_get_text(layout.get()));
    std::vector<std::string> lines;
    for (int i = 0; i < pango_layout_get_line_count(layout.get()); ++i) {
        const PangoLayoutLine* line = pango_layout_get_line_readonly(layout.get(), i);
        std::string_view part =
            all.substr(static_cast<std::size_t>(line->start_index), static_cast<std::size_t>(line->length));
        // A space at which a line was broken is drawn nowhere.
        while (part.ends_with(' '))
            part.remove_suffix(1);
        lines.emplace_back(part);
    }
    return lines;
}

double height_of(const std::vector<std::string>& lines, double points) {
    double height = 0.0;
    for (const std::string& line : lines)
        height += extent_of(line, points).height();
    return height;
}

double draw_lines(FigurePen& pen, glm::dvec2 at, const std::vector<std::string>& lines, double points,
                  TextAlign align, FigureColour colour) {
    double height = 0.0;
    for (const std::string& line : lines) {
        const TextExtent extent = extent_of(line, points);
        pen.text({at.x, at.y + height + extent.above}, line, points, align, colour);
        height += extent.height();
    }
    return height;
}

void save_figure(const std::filesystem::path& folder, const StudyFigure& figure) {
    write_whole_file(
        folder / fmt::format("{}.svg", figure.name),
        without_numbers(drawn(&cairo_svg_surface_create_for_stream, figure.size_mm, figure.draw, false)));
    write_whole_file(folder / fmt::format("{}.pdf", figure.name),
                     drawn(&cairo_pdf_surface_create_for_stream, figure.size_mm, figure.draw, true));
}

} // namespace overt
