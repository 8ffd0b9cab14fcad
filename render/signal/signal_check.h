/// Whether a display receives what it should: decoded bytes against the prediction.
#pragma once

#include <string>

#include "render/signal/signal_decoder.h"
#include "render/signal/signal_prediction.h"

namespace overt {

struct SignalFindings {
    std::int64_t compared = 0;  ///< values: three for each pixel or pair, one in grey modes
    std::int64_t different = 0; ///< from the predicted level, or with dithering from both levels around it
    int largest_difference = 0; ///< in levels of the mode
    std::string first;          ///< where the first difference is, and what was received there
    /// With dithering, over 64 x 64 patches in which the light is the same everywhere: the largest difference
    /// between the mean that was received and the light's code of 16 bits, in such codes.
    double largest_mean_error = 0.0;

    SignalFindings& operator+=(const SignalFindings& other);
};

/// Compares all of a screen but the rows reserved for messages. Throws GraphicsError if the bytes cannot be
/// decoded in the display's mode.
SignalFindings check_signal(const SignalScreen& screen, const DisplaySettings& display,
                            const ShownPicture& shown);

} // namespace overt
