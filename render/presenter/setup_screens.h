/// The screens of a tracker's set-up: targets, what a validation found, the camera's image.
#pragma once

#include "render/presenter/screen_text.h"
#include "render/presenter/validation_layout.h"

namespace overt {

/// A fixation target with its middle at the place that the screen says, to the nearest two pixels.
PlacedPicture draw_target(const Screen& screen, const ScreenGeometry& geometry, float grey, float background);

/// The screen in outline: a ring for each target, a cross where gaze was measured (of the right eye upright,
/// of the left one oblique), a line between the two, and the error beside them; the words below.
void put_validation(InkCanvas& canvas, const ValidationLayout& layout);

/// The camera's image in the middle of a picture of the whole screen, as large as seven tenths of its height
/// allow, with its white in the grey of the texts; the title below.
void put_camera(LinearImage& onto, const Screen& screen, float grey);

} // namespace overt
