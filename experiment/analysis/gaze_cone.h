/// A measured gaze is not a line but a cone: where the observer may have looked, given how accurate the
/// tracker is.
#pragma once

#include <cstddef>
#include <vector>

#include "experiment/maps/surface_point.h"
#include "experiment/screen_geometry.h"

namespace overt {

/// A surface point that may have been looked at, and with what probability.
struct WeightedSurfacePoint {
    SurfacePoint point;
    double weight = 0.0;
};

/// Directions around a gaze, normally distributed about it in visual angle, the same to all sides.
///
/// The width comes from the accuracy that a validation gives, the mean distance of gaze and target. For
/// errors that are normal with the same standard deviation sigma on both axes that mean is sigma sqrt(pi / 2)
/// (of the Rayleigh distribution), so sigma = 0.798 accuracy; 95 % of the cone then lie within 1.95 times the
/// accuracy.
///
/// The cone is a fixed set of directions of equal weight: the i-th of n at that distance within which the
/// distribution has (i + 1/2) / n of its mass, each turned by the golden angle against the one before, which
/// spreads them evenly. There is no chance in it: the same gaze gives the same numbers.
class GazeCone {
  public:
    static constexpr Degrees usual_accuracy{0.5};
    static constexpr int usual_directions = 1024;

    /// `accuracy`: >= 0; with 0 all of it is at the gaze itself.
    GazeCone(const ScreenGeometry& screen, Degrees accuracy = usual_accuracy,
             int directions = usual_directions);

    Degrees sigma() const { return sigma_; }

    /// Probabilities of what a gaze was on, in multiples of 1 / directions. What `of_object` is less than 1
    /// is the probability of the background, and of what lies beyond the image.
    struct Shares {
        double of_object = 0.0;
        std::vector<double> of_part; ///< by PartIndex; their sum is of_object
    };

    /// `parts`: how many the object has. Each direction goes by the centre of its pixel, unless the cone is
    /// only a few pixels wide.
    Shares shares(const SurfaceLookup& lookup, PoseIndex pose, ScreenPoint gaze, std::size_t parts) const;

    /// The points of the surface that may have been looked at. The sum of their weights is the probability of
    /// the object.
    std::vector<WeightedSurfacePoint> on_surface(const SurfaceLookup& lookup, PoseIndex pose,
                                                 ScreenPoint gaze) const;

  private:
    /// A direction, relative to the gaze: sines and cosine of the angle between them.
    struct Direction {
        double across, along, forward;
    };
    template <class Visit> void for_each_place(ScreenPoint gaze, const Visit& visit) const;

    ScreenGeometry screen_;
    Degrees sigma_;
    bool is_narrow_;
    std::vector<Direction> directions_;
};

} // namespace overt
