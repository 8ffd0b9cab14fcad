/// A characterised channel's curve, written down a second time for the prediction: it shares nothing with
/// ChannelCurve but the numbers that define it.
#pragma once

#include <array>
#include <vector>

#include "experiment/colour/channel_curve.h"

namespace overt {

/// Inverted by definition: by a closed formula, or between measured points by halving. The points' roots of
/// light are joined by cubics that never fall (Fritsch and Butland, SIAM J. Sci. Stat. Comput. 5, 1984), here
/// as Bézier polygons.
class PredictedCurve {
  public:
    PredictedCurve() = default; ///< light is the signal
    explicit PredictedCurve(const ChannelCurve& measured);

    /// The smallest signal with at least this light, 0 … 1 both.
    double signal_of(double light) const;
    double light_of(double signal) const;

  private:
    struct Piece {
        double begin = 0.0, end = 1.0;
        std::array<double, 4> polygon{}; ///< of light^(1 / exponent)
    };
    double exponent_ = 1.0, offset_ = 0.0, black_ = 0.0;
    std::vector<Piece> pieces_; ///< none: a power
};

} // namespace overt
