/// From the colours that pictures are kept in to the light of the display.
#pragma once

#include "experiment/protocol/protocol.h"
#include "render/image/linear_image.h"

namespace overt {

/// What the three numbers of a picture's pixel are; 1 is a white as bright as the display's in all of them
/// (XYZ: Y = 1).
enum class PictureColours { display, rec709, cie1931_xyz, cie2006_xyz };

/// What turns such numbers into the display's linear light. A colour that the display cannot show gives
/// numbers outside of 0 … 1. A display without a characterisation is taken to have the primaries of Rec. 709.
/// Throws InputError for CIE 2006 on a display whose spectra are not known.
glm::dmat3 display_from(PictureColours colours, const DisplaySettings& display);

/// What turns such numbers into XYZ, the observer's own, Y = 1 being white's. Not of the display's light.
glm::dmat3 xyz_from(PictureColours colours);

PictureColours colours_of(const FrameSequenceSettings& sequence);

/// In what a rendered frame is kept that an observer sees: Rec. 709 of CIE 1931, or XYZ_F of CIE 2006.
PictureColours rendered_colours(StandardObserver observer);

/// Each pixel's three numbers by the matrix; alpha stays.
void transform(LinearImage& picture, const glm::dmat3& matrix);

} // namespace overt
