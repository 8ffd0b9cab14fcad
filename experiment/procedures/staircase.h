/// Up-down staircases (Levitt 1971), also with unequal steps (Kaernbach 1991; García-Pérez 1998).
///
/// `down_after` answers `yes` in a row lower the level, `up_after` answers `no` in a row raise it, and each
/// change begins the count anew. Until the first reversal a single answer is enough where `initial_rule` says
/// so. The step is the one of the list that has as many before it as there were reversals, and the new one
/// holds for the change at the reversal already. A reversal is of the trial whose answer caused it, at that
/// trial's level. At a limit the direction stays: a change that is cut short is no reversal.
#pragma once

#include <vector>

#include "experiment/procedures/level_track.h"

namespace overt {

enum class StepScale : std::uint8_t {
    linear, ///< added to the level
    db,     ///< the level is multiplied by 10^(step / 20)
    log,    ///< the level is multiplied by 10^step
    places  ///< so many places further in the list of levels, from the smallest up
};
template <>
inline constexpr auto names_of<StepScale> = enum_names<StepScale>("linear", "db", "log", "places");

/// When a track has ended that has been so long and turned round so often.
enum class StopRule : std::uint8_t { both, either };
template <> inline constexpr auto names_of<StopRule> = enum_names<StopRule>("both", "either");

struct StaircaseSettings {
    double start = 0.0;
    int up_after = 1;   ///< n, at least 1
    int down_after = 2; ///< m, at least 1
    StepScale scale = StepScale::linear;
    std::vector<double> steps = {1.0};               ///< positive; the last holds for ever
    std::vector<double> steps_down = {};             ///< empty: as `steps`, which then are those up alone
    std::optional<double> lowest = {}, highest = {}; ///< limits of the level
    std::vector<double> levels = {};                 ///< of `places`: rising; `start` is one of them
    bool initial_rule = true;                        ///< 1 up 1 down until the first reversal
    int trials = 0;                                  ///< 0: no such end
    int reversals = 0;                               ///< 0: no such end
    StopRule stop = StopRule::both;                  ///< where there are both ends
    int discard = 2;                                 ///< first reversals that the estimate leaves out
    UnansweredTrial missed = UnansweredTrial::repeat;
};

class Staircase : public LevelTrack {
  public:
    /// Settings as described there, with at least one end. Of levels that are multiplied, start > 0.
    explicit Staircase(StaircaseSettings settings);

    std::optional<double> next() const override;
    void tell(double shown, TrackAnswer answer) override;
    TrackState state() const override;

    /// Levels of the trials with a reversal, in order.
    const std::vector<double>& reversal_levels() const { return reversal_levels_; }

    /// The mean of the last reversals: of an even number, after leaving out the first `discard`; geometric
    /// where steps multiply. Nothing with fewer than two.
    std::optional<double> mean_of_reversals() const;

  private:
    enum class Direction : std::uint8_t { none, up, down };
    bool is_over() const;
    void move(Direction to);

    StaircaseSettings settings_;
    double level_;
    std::size_t place_ = 0; ///< of `places`
    Direction direction_ = Direction::none;
    int run_ = 0; ///< of equal answers since the last change: `yes` above 0, `no` below
    int trials_ = 0;
    std::vector<double> reversal_levels_;
    bool was_clipped_ = false, has_reversed_ = false;
};

/// The share of `yes` at which the level is as likely to move up as down, each weighted with its step, for a
/// staircase with steps of one size: where it settles. Equilibrium after Levitt (1971): with q = 1 - p a
/// change is downward with probability D = p^(m-1) (1 - q^n) / (p^(m-1) + q^(n-1) - p^(m-1) q^(n-1)), and D
/// times the step down equals 1 - D times the step up. 0 < result < 1.
double staircase_target(int up_after, int down_after, double step_up, double step_down);

} // namespace overt
