#include "render/presenter/screen_text.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace overt {

namespace {

constexpr double safe_width = 0.8, safe_height = 0.9, form_width = 0.6;
constexpr double meter_width = 0.2, meter_height = 0.05; // a text's margin below is a twentieth of the screen

constexpr int smallest_line_px = 8;

TextStyle style_of(bool is_form, const ScreenGeometry& geometry, double text_height_deg) {
    TextStyle style;
    style.line_height_px =
        std::max(smallest_line_px, static_cast<int>(text_height_deg * geometry.px_per_deg_at_centre()));
    style.wrap_width_px =
        static_cast<int>((is_form ? form_width : safe_width) * geometry.screen_px.x) / 2 * 2;
    style.centred = !is_form;
    return style;
}

/// What is left of a picture that not even the smallest letters make small enough: its beginning.
LinearImage cropped(LinearImage picture, glm::ivec2 screen_px) {
    const glm::ivec2 size = glm::min(picture.size_px, screen_px);
    if (size == picture.size_px)
        return picture;
    LinearImage part(size);
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x)
            part.at(x, y) = picture.at(x, y);
    return part;
}

/// As wide as lines may be, so that a form stays in its place while it is filled in.
LinearImage widened(const LinearImage& picture, const TextStyle& style, bool at_the_right) {
    LinearImage wide({std::max(picture.size_px.x, style.wrap_width_px), picture.size_px.y});
    std::fill(wide.pixels.begin(), wide.pixels.end(), glm::vec4(glm::vec3(style.background), 0.0f));
    const int left = at_the_right ? wide.size_px.x - picture.size_px.x : 0;
    for (int y = 0; y < picture.size_px.y; ++y)
        for (int x = 0; x < picture.size_px.x; ++x)
            wide.at(left + x, y) = picture.at(x, y);
    return wide;
}

} // namespace

ScreenTextFit fit_screen_text(const std::string& text, bool is_form, const ScreenGeometry& geometry,
                              double text_height_deg) {
    TextStyle style = style_of(is_form, geometry, text_height_deg);
    const int wanted = style.line_height_px, highest = static_cast<int>(safe_height * geometry.screen_px.y);
    TextMeasure measure = measure_text(text, style);
    while (measure.size_px.y > highest && style.line_height_px > smallest_line_px) {
        style.line_height_px = std::max(smallest_line_px, style.line_height_px * 9 / 10);
        measure = measure_text(text, style);
    }
    return {measure, style.line_height_px, style.line_height_px < wanted, measure.size_px.y <= highest};
}

LinearImage draw_screen_text(const std::string& text, bool is_form, const ScreenGeometry& geometry,
                             const ScreenSettings& screens, double background) {
    TextStyle style = style_of(is_form, geometry, screens.text_height_deg);
    style.line_height_px = fit_screen_text(text, is_form, geometry, screens.text_height_deg).line_height_px;
    style.grey = static_cast<float>(screens.text_grey);
    style.background = static_cast<float>(background);
    LinearImage picture = cropped(draw_text(text, style), geometry.screen_px);
    return is_form ? widened(picture, style, begins_at_the_right(text)) : picture;
}

LinearImage draw_level_bar(const LevelBar& bar, const ScreenGeometry& geometry, const ScreenSettings& screens,
                           double background) {
    const int width = static_cast<int>(meter_width * geometry.screen_px.x) / 2 * 2,
              height = std::max(8, static_cast<int>(meter_height * geometry.screen_px.y)) / 2 * 2;
    const auto grey_of = [](double grey) { return glm::vec4(glm::vec3(static_cast<float>(grey)), 1.0f); };
    LinearImage picture({width, height});
    std::fill(picture.pixels.begin(), picture.pixels.end(), grey_of(background));
    const int bar_height = std::max(4, height / 4), top = height - bar_height;
    const auto column = [&](double share) { return static_cast<int>(share * (width - 1)); };
    for (int y = top; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const bool is_edge = y == top || y == height - 1 || x == 0 || x == width - 1;
            const bool is_filled = x <= column(bar.mean) && bar.mean > 0.0;
            const bool is_peak = bar.peak > 0.0 && std::abs(x - column(bar.peak)) <= 1;
            if (is_edge || is_filled || is_peak)
                picture.at(x, y) = grey_of(0.5 * (screens.text_grey + background));
            if (is_peak)
                picture.at(x, y) = grey_of(screens.text_grey);
        }
    }
    if (bar.warning.empty())
        return picture;
    TextStyle style;
    style.line_height_px = std::max(smallest_line_px, (top - 2) * 2 / 3);
    style.wrap_width_px = 20 * width; // one line; what is too long is cut off
    style.grey = static_cast<float>(screens.text_grey);
    style.background = static_cast<float>(background);
    const LinearImage words = draw_text(bar.warning, style);
    const int left = std::max(0, (width - words.size_px.x) / 2);
    for (int y = 0; y < std::min(words.size_px.y, top - 1); ++y)
        for (int x = 0; x < std::min(words.size_px.x, width); ++x)
            picture.at(left + x, y) = glm::vec4(glm::vec3(words.at(x, y)), 1.0f);
    return picture;
}

glm::ivec2 level_bar_origin(const ScreenGeometry& geometry, glm::ivec2 size_px) {
    const glm::ivec2 middle = centred_origin_px(geometry.screen_px, size_px);
    return {middle.x, geometry.screen_px.y - size_px.y - geometry.screen_px.y / 200};
}

} // namespace overt
