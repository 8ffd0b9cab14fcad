/// The screens of a session that are no stimuli: how large their texts are set, where everything stands, and
/// whether it fits.
#pragma once

#include <string>
#include <vector>

#include "experiment/ports/presenter.h"
#include "experiment/protocol/protocol.h"
#include "experiment/screen_geometry.h"
#include "render/image/ink_canvas.h"
#include "render/image/linear_image.h"
#include "render/image/text_layout.h"
#include "render/presenter/answer_drawing.h"

namespace overt {

/// How a screen's text comes out.
struct ScreenTextFit {
    TextMeasure measure; ///< of what stands in the middle: title, text and form
    int line_height_px = 0;
    bool is_shrunk = false; ///< it is set smaller than the protocol says, so that all of it is seen
    bool fits = true;       ///< else not even the smallest letters are small enough, and its end is cut off
};

/// Lines are no longer than about sixty letters (34 times their height) and eight tenths of the screen's
/// width, and end where the middle three quarters of its height end, or above the keys and below the frame's
/// title; what is too high for that is set smaller. A paragraph of more than two lines is set flush where its
/// script begins, the rest is centred. Keys, and how far this is, stand below. Throws InputError for a text
/// that is not UTF-8, or whose emphasis is not closed.
ScreenTextFit fit_screen(const Screen& screen, const ScreenGeometry& geometry, double text_height_deg);

/// A picture at its place on the screen; empty if nothing is drawn.
struct PlacedPicture {
    LinearImage picture;
    glm::ivec2 origin_px{0};
    std::vector<InkBox> texts = {};         ///< where each text of it stands on the screen
    std::vector<AnswerTarget> targets = {}; ///< of answers, on the screen
};

/// The screen as it is shown, in the grey of the texts on the display's background. `pictures`: of choices,
/// as they were read already. Throws InputError for a text that is not UTF-8 and a picture that cannot be
/// read.
PlacedPicture draw_screen(const Screen& screen, const ScreenGeometry& geometry, const ScreenSettings& screens,
                          double background, AnswerPictures& pictures);
/// The same, reading them.
PlacedPicture draw_screen(const Screen& screen, const ScreenGeometry& geometry, const ScreenSettings& screens,
                          double background);

/// A level meter: an outline, the mean level filled in, a line at the peak, and above it the warning. All on
/// the display's background, and always of the same size.
LinearImage draw_level_bar(const LevelBar& bar, const ScreenGeometry& geometry, const ScreenSettings& screens,
                           double background);

/// Where it stands: in the middle of the lowest tenth of the screen, where texts do not reach.
glm::ivec2 level_bar_origin(const ScreenGeometry& geometry, glm::ivec2 size_px);

} // namespace overt
