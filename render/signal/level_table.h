/// From light to the level of a signal that makes it: the inverse of a display's gamma.
#pragma once

#include <functional>
#include <vector>

namespace overt {

/// Levels 0 … n of a signal, of which level i makes the light curve(i / n), such as (i / n)^gamma. The light
/// at the borders between levels is tabulated in double precision, so that what comes out is floor(n * s +
/// 0.5) with s the smallest signal that makes the light, a billionth of a level short of a tie going up with
/// it, without the error of an inverted curve, at the price of a search in a few neighbours.
class LevelTable {
  public:
    /// `levels`: the highest level n, 1 … 65535. `gamma` > 0.
    LevelTable(int levels, double gamma);

    /// `curve` goes from 0 at 0 to 1 at 1 and never falls.
    LevelTable(int levels, const std::function<double(double)>& curve);

    /// The nearest level. Light outside of 0 … 1 is clipped; not a number counts as 0.
    int level_of(double light) const noexcept;

    /// Where a light lies between the light of two neighbouring levels: level 7 and a quarter of the light's
    /// way to level 8 is 7.25. Clipped as above.
    double position_of(double light) const noexcept;

    int levels() const { return levels_; }

    /// Levels make light in proportion: the level of light x in 0 … 1 is floor(x * levels() + half).
    bool is_linear() const { return linear_; }
    /// What lies half-way between two levels, but for the rounding of the sums that led there, goes up.
    static constexpr double half = 0.5 + 1e-9;

  private:
    void tabulate(const std::function<double(double)>& curve);
    double light_of(int level) const noexcept { return lights_[static_cast<std::size_t>(level)]; }

    int levels_;
    bool linear_;
    std::vector<double> borders_; ///< light at which level i begins to be nearer than i - 1, from i = 1 on
    std::vector<double> lights_;  ///< of each level
    std::vector<int> first_of_range_; ///< borders below each 65536th of the light
};

} // namespace overt
