/// QUEST+ (Watson, Journal of Vision 17(3):10, 2017): the posterior of all parameters of a psychometric
/// function on a grid, and next the level after whose answer the least uncertainty about them is expected.
///
/// Share of `yes` with F as named: gamma + (1 - gamma - lambda) F. Where two levels promise exactly the same,
/// the first of the list is taken. Double precision throughout: the best and the second best often differ by
/// 1e-5 bits only.
#pragma once

#include <vector>

#include "experiment/procedures/level_track.h"

namespace overt {

enum class QuestFunction : std::uint8_t {
    weibull_db, ///< 1 - exp(-10^(slope (x - threshold) / 20)), levels in decibels
    normal,     ///< normal probability of (x - threshold) / slope: the slope is a standard deviation
    logistic    ///< 1 / (1 + exp(-slope (x - threshold)))
};
template <>
inline constexpr auto names_of<QuestFunction> = enum_names<QuestFunction>("weibull", "normal", "logistic");

/// Values of a parameter and how probable they are beforehand.
struct ParameterGrid {
    std::vector<double> values;     ///< at least one
    std::vector<double> prior = {}; ///< weights, one for each value; empty: all alike
};

struct QuestPlusSettings {
    QuestFunction function = QuestFunction::weibull_db;
    std::vector<double> levels; ///< of the stimulus, at least one
    /// Of a second dimension of the stimulus, along which the threshold changes in a straight line: threshold
    /// + tilt times this. All pairs are candidates, the second running fastest. Empty: there is none.
    std::vector<double> second_levels = {};
    ParameterGrid threshold, slope, guess{{0.5}}, lapse{{0.02}}, tilt{{0.0}};
    int trials = 0;                          ///< 0: no such end
    std::optional<double> entropy_bits = {}; ///< the track ends when no more uncertainty is left than this
    UnansweredTrial missed = UnansweredTrial::repeat;
};

/// What the posterior says of a parameter.
struct ParameterEstimate {
    double mean = 0.0, sd = 0.0;
    double mode = 0.0; ///< its value at the most probable point of the grid
};

class QuestPlus : public LevelTrack {
  public:
    explicit QuestPlus(QuestPlusSettings settings);

    std::optional<double> next() const override;
    /// Where there is a second dimension, `shown` must be the level of next(); the second is second_next().
    void tell(double shown, TrackAnswer answer) override;
    TrackState state() const override;

    /// Of the second dimension; nothing where there is none, or the track has ended.
    std::optional<double> second_next() const;
    /// The entropy that is expected after the next answer, in bits, for the level that is next.
    double expected_entropy_bits() const { return expected_bits_; }
    double entropy_bits() const;

    enum class Parameter : std::uint8_t { threshold, slope, guess, lapse, tilt };
    ParameterEstimate estimate(Parameter of) const;
    /// The interval that leaves out as much of the posterior below as above, by linear interpolation between
    /// the values of the grid. 0 < confidence < 1.
    std::pair<double, double> interval(Parameter of, double confidence) const;

  private:
    struct Point {
        double threshold, slope, guess, lapse, tilt;
    };
    double value_of(const Point& point, Parameter of) const;
    bool is_over() const;
    void choose();
    std::size_t level_count() const;
    double yes_at(const Point& point, double level, double second) const;

    QuestPlusSettings settings_;
    std::vector<Point> points_;
    std::vector<double> posterior_;
    std::vector<double> yes_; ///< level by level: share of `yes` at each point
    std::size_t chosen_ = 0;
    double expected_bits_ = 0.0;
    int trials_ = 0;
};

} // namespace overt
