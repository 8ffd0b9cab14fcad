#include "render/screen_text.h"

#include <algorithm>

namespace overt {

namespace {

constexpr double safe_width = 0.8, safe_height = 0.9;
constexpr int smallest_line_px = 8;

TextStyle style_of(bool is_form, const ScreenGeometry& geometry, double text_height_deg) {
    TextStyle style;
    style.line_height_px =
        std::max(smallest_line_px, static_cast<int>(text_height_deg * geometry.px_per_deg_at_centre()));
    style.wrap_width_px = static_cast<int>(safe_width * geometry.screen_px.x);
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
    return {measure, style.line_height_px, style.line_height_px < wanted};
}

LinearImage draw_screen_text(const std::string& text, bool is_form, const ScreenGeometry& geometry,
                             const ScreenSettings& screens, double background) {
    TextStyle style = style_of(is_form, geometry, screens.text_height_deg);
    style.line_height_px = fit_screen_text(text, is_form, geometry, screens.text_height_deg).line_height_px;
    style.grey = static_cast<float>(screens.text_grey);
    style.background = static_cast<float>(background);
    return cropped(draw_text(text, style), geometry.screen_px);
}

} // namespace overt
