/// QUEST (Watson and Pelli, Perception & Psychophysics 33, 1983), in the form of the Psychophysics Toolbox:
/// the threshold's posterior on a grid, and the next level at a quantile of it.
///
/// Levels are common logarithms. Weibull function with the chance `delta` of a blind answer:
/// p(x) = delta gamma + (1 - delta) (1 - (1 - gamma) exp(-10^(beta (x - T + eps)))), and eps such that
/// p(T) = p_threshold. The order of the quantile follows from the function's least and greatest values alone.
#pragma once

#include <vector>

#include "experiment/procedures/level_track.h"

namespace overt {

struct QuestSettings {
    double guess = 0.0;        ///< mean of the threshold's prior, log10
    double guess_sd = 2.0;     ///< its standard deviation, > 0
    double p_threshold = 0.82; ///< share of `yes` at threshold, between gamma and 1
    double beta = 3.5;         ///< slope
    double delta = 0.01;       ///< share of blind answers
    double gamma = 0.5;        ///< share of `yes` far below threshold
    double grain = 0.01;       ///< of the grid
    double range = 5.0;        ///< of the grid, about `guess`
    int trials = 40;
    std::vector<double> levels = {}; ///< that there are, log10: the nearest is next; empty: any
    UnansweredTrial missed = UnansweredTrial::repeat;
};

class Quest : public LevelTrack {
  public:
    explicit Quest(const QuestSettings& settings);

    std::optional<double> next() const override;
    void tell(double shown, TrackAnswer answer) override;
    TrackState state() const override;

    double mean() const; ///< of the threshold, log10
    double sd() const;
    double mode() const;
    /// Of the threshold, by linear interpolation of the cumulated posterior. 0 < order < 1.
    double quantile(double order) const;
    double quantile_order() const { return order_; } ///< that next() takes
    double shift() const { return shift_; }          ///< eps

  private:
    double yes_at(double distance) const;

    QuestSettings settings_;
    int half_; ///< points of the grid on either side of the guess
    double shift_ = 0.0, order_ = 0.5;
    std::vector<double> posterior_;
    int trials_ = 0;
};

/// The one of `levels` that is nearest to `level`, the first of two; at least one.
double nearest_level(const std::vector<double>& levels, double level);

} // namespace overt
