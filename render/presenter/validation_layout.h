/// Where everything of a validation's result stands on the screen, so that no two texts meet.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiment/ports/presenter.h"
#include "render/image/ink_canvas.h"
#include "render/image/text_layout.h"

namespace overt {

/// A text with its place, which is as large as measure_text() says.
struct PlacedText {
    std::string text;
    TextStyle style;
    glm::ivec2 origin_px{0}, size_px{0};
};

/// The screen of the validation, smaller, with its targets; the words below it.
struct ValidationLayout {
    struct Mark {
        Eye eye = Eye::right;
        glm::dvec2 target_px{0.0};
        std::optional<glm::dvec2> gaze_px; ///< at the edge of the screen drawn, if it was beyond it
        bool gaze_is_inside = false;
    };
    InkBox screen;                      ///< the outline of the screen; empty if there is no room for it
    double ring_px = 0.0, arm_px = 0.0; ///< radius of a target's ring, length of an arm of a cross
    std::vector<Mark> marks;
    std::vector<PlacedText> errors; ///< beside their targets
    int errors_left_out = 0;        ///< that find no place even in the smallest letters, the smallest ones
    PlacedText words;
};

/// In the rows from `top_px` to `bottom_px` of a screen. `letters`: of the words, set smaller where they
/// would take more than a third of the room. Errors stand beside their targets, of two eyes the left one's at
/// the left where there is room, in letters as large as lets all of them stand apart.
ValidationLayout lay_out_validation(const Screen& screen, glm::ivec2 screen_px, int top_px, int bottom_px,
                                    const TextStyle& letters);

} // namespace overt
