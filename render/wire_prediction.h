/// What a display should receive for a picture, by definition: computed in double precision, pixel by pixel,
/// without tables and without anything of the encoder.
#pragma once

#include <array>

#include "experiment/protocol/protocol.h"
#include "render/linear_image.h"

namespace overt {

/// A picture on the background of a screen.
struct ShownPicture {
    const LinearImage* picture = nullptr; ///< null: the background alone. Multiplied by its alpha
    glm::ivec2 origin_px{0};
};

class WirePrediction {
  public:
    /// `display` says mode, size, background, gamma, dithering and filter; it must outlive the prediction.
    WirePrediction(const DisplaySettings& display, const ShownPicture& shown)
        : display_(&display), shown_(shown) {}

    /// Linear light of red, green and blue at a pixel of the screen; beyond its edges, the background.
    std::array<double, 3> light_at(int x, int y) const;

    /// What the display should light at pixel, or pair, (x, y): linear light, clipped to 0 … 1. Grey modes
    /// have three times the luminance; Bits++ the light of the nearest of 256 indices.
    std::array<double, 3> shown_light_at(int x, int y) const;

    /// The signal that makes it, in levels of 0 … `highest`, before rounding.
    double signal_of(double light, int highest) const;

  private:
    std::array<double, 3> pair_light_at(int pair, int y) const;

    const DisplaySettings* display_;
    ShownPicture shown_;
};

} // namespace overt
