/// What makes gaze on the screen of what a tracker measures: a function from points to points, fitted to
/// targets whose places are known.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "experiment/calibration/calibration_settings.h"
#include "experiment/screen_geometry.h"
#include "experiment/units.h"

namespace overt {

/// A target and what was measured while it was looked at; both in pixels of the screen, where an uncalibrated
/// tracker's may be far off.
struct CalibrationPair {
    ScreenPoint measured;
    ScreenPoint target;
};

/// Polynomial: each coordinate is a weighted sum of 1, x, y (of fewer than eight pairs) or of 1, x, y, xy,
/// x², y². Homography: both are quotients of such sums of first order. Fitted by iteratively reweighted least
/// squares with Huber's weights (k = 1.345 robust standard deviations, Holland and Welsch 1977), so that one
/// bad pair does not bend it. Does nothing before it is fitted.
class GazeFit {
  public:
    GazeFit() = default;

    /// At least three pairs (four for a homography). Throws InputError for gaze in a line or at one place, to
    /// which no function can be fitted.
    GazeFit(std::span<const CalibrationPair> pairs, CalibrationModel model, const ScreenGeometry& screen);

    ScreenPoint operator()(ScreenPoint measured) const noexcept;

    /// Such as "polynomial of second order, 9 targets".
    const std::string& description() const noexcept { return description_; }

  private:
    std::array<double, 6> terms_of(ScreenPoint measured) const noexcept;

    bool is_fitted_ = false, is_homography_ = false;
    double half_width_px_ = 1.0;
    ScreenPoint centre_;
    std::array<double, 6> x_{}, y_{}; ///< of 1, x, y, xy, x², y², in half widths of the screen
    std::array<double, 2> below_{};   ///< of x and y in the quotient's denominator
    std::string description_;
};

/// For each pair, by how much the fit to all others misses its target; what is far above the others' was not
/// looked at. 0 for a pair without which the others' gaze lies in a line or at one place: nothing can be said
/// of it. Of pairs that are too few to leave one out, nothing. Throws nothing for any gaze.
std::vector<Degrees> misses_left_out(std::span<const CalibrationPair> pairs, CalibrationModel model,
                                     const ScreenGeometry& screen);

} // namespace overt
