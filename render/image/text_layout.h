/// What stands on the screens between animations, drawn by Pango and Cairo before it is shown.
#pragma once

#include <string>

#include "render/image/ink_canvas.h"
#include "render/image/linear_image.h"

namespace overt {

struct TextStyle {
    int line_height_px = 40; ///< size of the letters' em
    int wrap_width_px = 1200;
    float grey = 0.6f;       ///< linear, of the letters
    float background = 0.0f; ///< linear
    bool centred = true;
    bool bold = false;
    bool has_marks = false; ///< <b> and the like are emphasis (text_markup.h), not letters
    bool one_line = false;  ///< what is too long for it loses its beginning
};

/// What a text comes out as.
struct TextMeasure {
    glm::ivec2 size_px{0};
    int lines = 0;
    int widest_line_px = 0;
    int longest_paragraph = 0; ///< in lines
    int unknown_glyphs = 0;    ///< characters that no font of this machine has; boxes stand for them
};
TextMeasure measure_text(const std::string& text, const TextStyle& style);

/// Whether its lines begin at the right, by the first letter that has a direction.
bool begins_at_the_right(const std::string& text);

/// UTF-8 text in any script, wrapped between words. The picture is as large as the text needs, at most
/// wrap_width_px wide; its width is even. Alpha is the letters' coverage. Throws InputError if the text is
/// not UTF-8.
LinearImage draw_text(const std::string& text, const TextStyle& style);

/// The same on a canvas, with measure_text()'s size from a place on. `strength`: see InkCanvas.
void put_text(InkCanvas& canvas, const std::string& text, const TextStyle& style, glm::ivec2 top_left_px,
              double strength = 1.0);

/// A line before the letter that begins at this byte of a text that put_text() would put there, also of an
/// empty one.
void put_caret(InkCanvas& canvas, const std::string& text, const TextStyle& style, glm::ivec2 top_left_px,
               std::size_t before_byte);

/// Some bytes of a text: `begin` … `end` - 1.
struct TextPart {
    std::size_t begin = 0, end = 0;
};
/// So many lines of a text as it is wrapped, with the one in which this byte stands; as many as there are, if
/// there are no more. Throws InputError if the text is not UTF-8.
TextPart lines_around(const std::string& text, const TextStyle& style, std::size_t byte, int lines);

/// Writes a line over a picture, as large as it has room for: `bottom_px` is the middle of its lower edge.
/// On a dark band, so that it is read on any picture.
void write_on(LinearImage& picture, const std::string& text, glm::ivec2 bottom_px);

/// A fixation target in which gaze is steadiest: disc, cross and dot (shape ABC of Thaler et al., Vision
/// Research 76, 2013). `diameter_px` is that of the disc; 0.6 degrees there. The picture is square with an
/// even side.
LinearImage draw_fixation_target(double diameter_px, float grey, float background);

} // namespace overt
