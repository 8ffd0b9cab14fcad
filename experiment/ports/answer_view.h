/// How answers look while they are given: what a presenter draws, and where it was drawn.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "experiment/base/enum_names.h"
#include "experiment/units.h"

namespace overt {

/// One of the things to choose from, or a step of a scale.
struct AnswerOption {
    std::string label;   ///< UTF-8, in the language of the protocol; may be empty on a scale
    std::string key;     ///< that chooses it, as it is written on the keyboard; empty: none is shown
    std::string picture; ///< a file, absolute; empty: the label alone
    bool is_chosen = false;
};

/// A question with its means of answering, one of those on a screen from top to bottom.
struct AnswerItem {
    enum class Kind : std::uint8_t {
        keys,   ///< the question alone, or with its keys named
        choice, ///< options, beside each other where they fit, else below each other
        steps,  ///< options as points on a line: Likert scales and categories
        line,   ///< a line without steps: a visual analogue scale
        number, ///< what was typed so far
        text,   ///< the same, of several lines
        notice  ///< words alone: feedback, points, a message
    };
    Kind kind = Kind::keys;
    std::string question = {}; ///< with emphasis as in Screen::text; may be empty
    std::vector<AnswerOption> options =
        {}; ///< of choice and steps, in the order in which they are shown (left to right)
    std::vector<std::string> ends =
        {};        ///< words at the ends of a line or steps (two), or spread evenly over it (more)
    int ticks = 0; ///< of a line; 0: none
    std::optional<double> marker = {}; ///< of a line, 0 (left end) to 1; nothing until it was first touched
    std::optional<std::string> marker_label = {}; ///< its value, where the observer is to see it
    std::string typed = {};
    std::size_t caret = 0;         ///< in `typed`, bytes
    std::string unit = {};         ///< behind a number
    bool is_here = true;           ///< keys go here
    bool is_right_to_left = false; ///< the scale begins at the right; how words run follows from the words
    std::string message = {};      ///< what is missing or wrong, below it
    enum class Colour : std::uint8_t { plain, good, bad };
    Colour colour = Colour::plain; ///< of a notice
};

/// What stands on the screen while answers are given.
struct AnswerView {
    std::vector<AnswerItem> items;
    std::string accept;                ///< words of the button that accepts all; empty: there is none
    bool can_accept = false;           ///< nothing required is missing
    bool shows_pointer = false;        ///< items are answered with the mouse
    std::optional<double> up_deg = {}; ///< of its middle, from the middle of the screen; nothing: in the
                                       ///< middle. Beside a stimulus it stands where the protocol says
};

/// What of an answer lies under a place of the screen: where it was drawn decides what a click means.
struct AnswerPlace {
    int item = -1;                    ///< index into AnswerView::items; -1: none
    int option = -1;                  ///< index into its options; -1: none
    std::optional<double> along = {}; ///< of a line: from 0 at its left end to 1
    bool is_accept = false;           ///< the button that accepts
};

} // namespace overt
