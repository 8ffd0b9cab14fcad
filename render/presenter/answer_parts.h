/// The parts that a screen of answers is laid out from: a drawing for each kind of item, and the button.
#pragma once

#include "render/presenter/answer_drawing.h"

namespace overt {

/// What the parts of one screen have in common.
struct AnswerLetters {
    TextStyle body;   ///< its height is the unit of every length
    int width_px = 0; ///< that a part may have
    AnswerPictures* pictures = nullptr;

    int ems(double count) const { return static_cast<int>(count * body.line_height_px); }
    /// Letters of options, ends and the like: `size` of the body's, set as they are written.
    TextStyle plain(double size, int wrap_px) const;
};

/// Words at their natural width, at most `wrap_px`; empty words have no size.
glm::ivec2 size_of(const std::string& words, const TextStyle& style);

/// How wide the widest word is that is not taken apart.
int widest_word_px(const std::string& words, const TextStyle& style);

/// A key as a cap, `key` as a protocol calls it: arrows as arrows, letters large.
AnswerDrawing lay_out_key_cap(const std::string& key, const AnswerLetters& letters, double strength);

/// A question, centred unless it has more than two lines. Empty: nothing.
AnswerDrawing lay_out_words(const std::string& words, const AnswerLetters& letters,
                            AnswerItem::Colour colour = AnswerItem::Colour::plain);

/// Options in boxes beside each other where they fit, also with their words in several lines; else in as many
/// rows as are needed. Of `keys`, without boxes.
AnswerDrawing lay_out_choice(const AnswerItem& item, int index, const AnswerLetters& letters);

/// Points on a line with their labels, below each other where a label's word is wider than its step.
AnswerDrawing lay_out_steps(const AnswerItem& item, int index, const AnswerLetters& letters);

/// A line with its ends and ticks; the marker stands there once the line was touched.
AnswerDrawing lay_out_line(const AnswerItem& item, int index, const AnswerLetters& letters);

/// What is typed, in a box: a number with its unit, or words in several lines of which those around the caret
/// are seen.
AnswerDrawing lay_out_entry(const AnswerItem& item, int index, const AnswerLetters& letters);

/// The button that accepts all.
AnswerDrawing lay_out_accept(const std::string& words, bool can_accept, const AnswerLetters& letters);

/// Words at both ends of a line of `length_px` that begins at `left_px`, or spread evenly over it, in the
/// rows from `top_px` on; gives the height of the highest.
int put_ends(AnswerDrawing& sheet, const std::vector<std::string>& ends, int left_px, int length_px,
             int top_px, const AnswerLetters& letters);
/// How long a line has to be so that its ends' words stand apart and within the width, if it can be.
int length_for_ends(const std::vector<std::string>& ends, int wanted_px, const AnswerLetters& letters);

} // namespace overt
