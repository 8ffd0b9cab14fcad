/// The texts of a session on its screen: how large they are set, and whether they fit.
#pragma once

#include <string>

#include "experiment/ports/presenter.h"
#include "experiment/protocol/protocol.h"
#include "experiment/screen_geometry.h"
#include "render/image/linear_image.h"
#include "render/image/text_layout.h"

namespace overt {

/// How a screen's text comes out.
struct ScreenTextFit {
    TextMeasure measure;
    int line_height_px = 0;
    bool is_shrunk = false; ///< it is set smaller than the protocol says, so that all of it is seen
    bool fits = true;       ///< else not even the smallest letters are small enough, and its end is cut off
};

/// The texts stand in the middle eight tenths of the screen's width (a form: six tenths, wherever its lines
/// end) and nine tenths of its height: lines are wrapped at the one, and a text that is too high for the
/// other is set smaller. `is_form`: lines begin below each other. Throws InputError for a text that is not
/// UTF-8.
ScreenTextFit fit_screen_text(const std::string& text, bool is_form, const ScreenGeometry& geometry,
                              double text_height_deg);

/// The text as it is shown, of the colours of the screens on the display's background.
LinearImage draw_screen_text(const std::string& text, bool is_form, const ScreenGeometry& geometry,
                             const ScreenSettings& screens, double background);

/// A level meter: an outline, the mean level filled in, a line at the peak, and above it the warning. All on
/// the display's background, and always of the same size.
LinearImage draw_level_bar(const LevelBar& bar, const ScreenGeometry& geometry, const ScreenSettings& screens,
                           double background);

/// Where it stands: in the middle of the lowest tenth of the screen, where texts do not reach.
glm::ivec2 level_bar_origin(const ScreenGeometry& geometry, glm::ivec2 size_px);

} // namespace overt
