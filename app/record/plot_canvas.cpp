#include "app/record/plot_canvas.h"

#include <cmath>
#include <memory>
#include <numbers>
#include <span>
#include <string_view>

#include <fmt/format.h>
#include <pango/pangocairo.h>

#include "experiment/base/error.h"
#include "experiment/base/whole_file.h"

namespace overt {

namespace {

constexpr const char* ink_of_words = "#333333";
constexpr double png_scale = 2.0; ///< 1800 pixels for a plot of 900 points

std::string svg_escaped(const std::string& text) {
    std::string safe;
    for (const char letter : text) {
        if (letter == '&')
            safe += "&amp;";
        else if (letter == '<')
            safe += "&lt;";
        else if (letter == '>')
            safe += "&gt;";
        else
            safe += letter;
    }
    return safe;
}

const char* svg_word(PlotCanvas::Anchor anchor) {
    constexpr const char* words[] = {"start", "middle", "end"};
    return words[static_cast<int>(anchor)];
}

void set_colour(cairo_t* cairo, const std::string& colour) {
    const unsigned long rgb = std::stoul(colour.substr(1), nullptr, 16);
    cairo_set_source_rgb(cairo, static_cast<double>(rgb >> 16 & 0xffu) / 255.0,
                         static_cast<double>(rgb >> 8 & 0xffu) / 255.0,
                         static_cast<double>(rgb & 0xffu) / 255.0);
}

struct ObjectRelease {
    void operator()(gpointer object) const { g_object_unref(object); }
};
struct FontRelease {
    void operator()(PangoFontDescription* font) const { pango_font_description_free(font); }
};
struct SurfaceRelease {
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};
struct CairoRelease {
    void operator()(cairo_t* cairo) const { cairo_destroy(cairo); }
};

/// Words on the current point's base line: `share` of their width lies to its left.
void show_words(cairo_t* cairo, const std::string& words, double size, double share) {
    const std::unique_ptr<PangoLayout, ObjectRelease> layout(pango_cairo_create_layout(cairo));
    const std::unique_ptr<PangoFontDescription, FontRelease> font(
        pango_font_description_from_string("DejaVu Sans"));
    pango_font_description_set_absolute_size(font.get(), size * PANGO_SCALE);
    pango_layout_set_font_description(layout.get(), font.get());
    pango_layout_set_text(layout.get(), words.data(), static_cast<int>(words.size()));
    int width = 0;
    pango_layout_get_size(layout.get(), &width, nullptr);
    cairo_rel_move_to(cairo, -share * width / PANGO_SCALE,
                      -static_cast<double>(pango_layout_get_baseline(layout.get())) / PANGO_SCALE);
    pango_cairo_show_layout(cairo, layout.get());
}

cairo_status_t add_bytes(void* into, const unsigned char* bytes, unsigned int count) {
    auto& all = *static_cast<std::vector<std::byte>*>(into);
    const auto piece = std::as_bytes(std::span(bytes, count));
    all.insert(all.end(), piece.begin(), piece.end());
    return CAIRO_STATUS_SUCCESS;
}

} // namespace

void PlotCanvas::text(double x, double y, const std::string& words, Anchor anchor, double size, bool turned) {
    marks_.push_back({Mark::Kind::text, x, y, 0.0, 0.0, size, ink_of_words, words, anchor, turned});
}
void PlotCanvas::line(double x1, double y1, double x2, double y2, const char* colour, double thickness) {
    marks_.push_back({Mark::Kind::line, x1, y1, x2, y2, thickness, colour});
}
void PlotCanvas::box(double x, double y, double width, double height, const char* colour) {
    marks_.push_back({Mark::Kind::box, x, y, width, height, 0.0, colour});
}
void PlotCanvas::outline(double x, double y, double width, double height, const char* colour) {
    marks_.push_back({Mark::Kind::outline, x, y, width, height, 1.0, colour});
}
void PlotCanvas::dot(double x, double y, double radius, const char* colour) {
    marks_.push_back({Mark::Kind::dot, x, y, radius, 0.0, 0.0, colour});
}

std::string PlotCanvas::svg(double width, double height) const {
    std::string body;
    const auto add = [&body]<class... Values>(fmt::format_string<Values...> format, Values&&... values) {
        body += fmt::format(format, std::forward<Values>(values)...);
    };
    for (const Mark& mark : marks_) {
        switch (mark.kind) {
        case Mark::Kind::text:
            if (mark.turned)
                add("<text transform=\"translate({:.1f} {:.1f}) rotate(-90)\"", mark.x, mark.y);
            else
                add("<text x=\"{:.1f}\" y=\"{:.1f}\"", mark.x, mark.y);
            add(" text-anchor=\"{}\" font-size=\"{}\" fill=\"{}\">{}</text>\n", svg_word(mark.anchor),
                mark.size, mark.colour, svg_escaped(mark.words));
            break;
        case Mark::Kind::line:
            add("<line x1=\"{:.2f}\" y1=\"{:.2f}\" x2=\"{:.2f}\" y2=\"{:.2f}\" stroke=\"{}\" "
                "stroke-width=\"{}\"/>\n",
                mark.x, mark.y, mark.a, mark.b, mark.colour, mark.size);
            break;
        case Mark::Kind::box:
            add("<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\"/>\n", mark.x,
                mark.y, mark.a, mark.b, mark.colour);
            break;
        case Mark::Kind::outline:
            add("<rect x=\"{}\" y=\"{:.1f}\" width=\"{}\" height=\"{:.1f}\" fill=\"none\" stroke=\"{}\"/>\n",
                mark.x, mark.y, mark.a, mark.b, mark.colour);
            break;
        case Mark::Kind::dot:
            add("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{}\" fill=\"{}\"/>\n", mark.x, mark.y, mark.a,
                mark.colour);
            break;
        }
    }
    return fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1:.0f}\" "
                       "viewBox=\"0 0 {0} {1:.0f}\" font-family=\"sans-serif\">\n"
                       "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n{2}</svg>\n",
                       width, height, body);
}

std::vector<std::byte> PlotCanvas::png(double width, double height, double scale) const {
    const std::unique_ptr<cairo_surface_t, SurfaceRelease> surface(
        cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(std::lround(scale * width)),
                                   static_cast<int>(std::lround(scale * height))));
    const std::unique_ptr<cairo_t, CairoRelease> owned(cairo_create(surface.get()));
    cairo_t* const cairo = owned.get();
    cairo_set_source_rgb(cairo, 1.0, 1.0, 1.0);
    cairo_paint(cairo);
    cairo_scale(cairo, scale, scale);
    for (const Mark& mark : marks_) {
        set_colour(cairo, mark.colour);
        cairo_set_line_width(cairo, mark.size);
        switch (mark.kind) {
        case Mark::Kind::text:
            cairo_save(cairo);
            cairo_translate(cairo, mark.x, mark.y);
            if (mark.turned)
                cairo_rotate(cairo, -0.5 * std::numbers::pi);
            cairo_move_to(cairo, 0.0, 0.0);
            show_words(cairo, mark.words, mark.size, 0.5 * static_cast<int>(mark.anchor));
            cairo_restore(cairo);
            break;
        case Mark::Kind::line:
            cairo_move_to(cairo, mark.x, mark.y);
            cairo_line_to(cairo, mark.a, mark.b);
            cairo_stroke(cairo);
            break;
        case Mark::Kind::box:
            cairo_rectangle(cairo, mark.x, mark.y, mark.a, mark.b);
            cairo_fill(cairo);
            break;
        case Mark::Kind::outline:
            cairo_rectangle(cairo, mark.x, mark.y, mark.a, mark.b);
            cairo_stroke(cairo);
            break;
        case Mark::Kind::dot:
            cairo_new_path(cairo); // words leave a point that an arc would be joined with
            cairo_arc(cairo, mark.x, mark.y, mark.a, 0.0, 2.0 * std::numbers::pi);
            cairo_fill(cairo);
            break;
        }
        cairo_new_path(cairo);
    }
    std::vector<std::byte> bytes;
    const cairo_status_t status = cairo_status(cairo) != CAIRO_STATUS_SUCCESS
                                      ? cairo_status(cairo)
                                      : cairo_surface_write_to_png_stream(surface.get(), add_bytes, &bytes);
    if (status != CAIRO_STATUS_SUCCESS)
        throw RecordError(fmt::format("the plot cannot be drawn as PNG ({}): write it as .svg",
                                      cairo_status_to_string(status)));
    return bytes;
}

void PlotCanvas::check_ending(const std::filesystem::path& file) {
    if (const auto ending = file.extension(); ending != ".svg" && ending != ".png")
        throw InputError(
            fmt::format("{}: plots are written as .svg or as .png: give a name with one of these endings",
                        file.string()));
}

void PlotCanvas::write(const std::filesystem::path& file, double width, double height) const {
    check_ending(file);
    if (file.extension() == ".png")
        write_whole_file(file, png(width, height, png_scale));
    else
        write_whole_file(file, svg(width, height));
}

} // namespace overt
