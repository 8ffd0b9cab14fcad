/// What a display should receive for a picture, by definition: computed in double precision, pixel by pixel,
/// without tables of levels and without anything of the encoder.
#pragma once

#include <array>

#include "experiment/protocol/protocol.h"
#include "render/image/linear_image.h"
#include "render/signal/predicted_curve.h"

namespace overt {

struct ModeCoding;
struct ReceivedLight;

/// A picture on the background of a screen.
struct ShownPicture {
    const LinearImage* picture = nullptr; ///< null: the background alone. Multiplied by its alpha
    glm::ivec2 origin_px{0};
};

class SignalPrediction {
  public:
    /// `display` says mode, size, background, gamma, dithering and filter; it must outlive the prediction.
    SignalPrediction(const DisplaySettings& display, const ShownPicture& shown);

    /// Linear light of red, green and blue at a pixel of the screen; beyond its edges, the background.
    std::array<double, 3> light_at(int x, int y) const;

    /// The luminance of light_at(), of the channels as measured, or by Rec. 709; clipped to 0 … 1.
    double luminance_at(int x, int y) const;

    /// Linear light of a pair of pixels, by the display's filter.
    std::array<double, 3> pair_light_at(int pair, int y) const;

    /// What the display should light at pixel, or pair, (x, y), as the mode's coding predicts it: linear
    /// light, clipped to 0 … 1.
    std::array<double, 3> shown_light_at(int x, int y) const;

    /// The smallest signal that makes this light of a channel, or of one signal for all three this luminance,
    /// before rounding, in levels of what was received.
    double signal_of(std::size_t channel, double light, const ReceivedLight& received) const;

  private:
    double grey_signal_of(double light) const;

    const DisplaySettings* display_;
    const ModeCoding* coding_;
    ShownPicture shown_;
    std::array<double, 3> luminance_shares_{0.2126, 0.7152, 0.0722}; ///< Rec. 709, if not measured
    std::array<PredictedCurve, 3> curves_;                           ///< of a characterised display
};

} // namespace overt
