/// What stands on the screens between animations, drawn by Pango and Cairo before it is shown.
#pragma once

#include <string>

#include "render/image/linear_image.h"

namespace overt {

struct TextStyle {
    int line_height_px = 40; ///< size of the letters' em
    int wrap_width_px = 1200;
    float grey = 0.6f;       ///< linear, of the letters
    float background = 0.0f; ///< linear
    bool centred = true;
};

/// What a text comes out as.
struct TextMeasure {
    glm::ivec2 size_px{0};
    int lines = 0;
    int widest_line_px = 0;
    int unknown_glyphs = 0; ///< characters that no font of this machine has; boxes stand for them
};
TextMeasure measure_text(const std::string& text, const TextStyle& style);

/// Whether its lines begin at the right, by the first letter that has a direction.
bool begins_at_the_right(const std::string& text);

/// UTF-8 text in any script, wrapped between words. The picture is as large as the text needs, at most
/// wrap_width_px wide; its width is even. Alpha is the letters' coverage. Throws InputError if the text is
/// not UTF-8.
LinearImage draw_text(const std::string& text, const TextStyle& style);

/// A fixation target in which gaze is steadiest: disc, cross and dot (shape ABC of Thaler et al., Vision
/// Research 76, 2013). `diameter_px` is that of the disc; 0.6 degrees there. The picture is square with an
/// even side.
LinearImage draw_fixation_target(double diameter_px, float grey, float background);

} // namespace overt
