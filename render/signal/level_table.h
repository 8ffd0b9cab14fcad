/// From light to the level of a signal that makes it: the inverse of a display's gamma.
#pragma once

#include <bit>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace overt {

/// Levels 0 … n of a signal, of which level i makes the light curve(i / n), such as (i / n)^gamma. The light
/// at the borders between levels is tabulated in double precision, so that what comes out is floor(n * s +
/// 0.5) with s the smallest signal that makes the light, a billionth of a level short of a tie going up with
/// it, without the error of an inverted curve.
///
/// To find a level fast, light is rounded to a float, and floats fall into buckets, 128 to each doubling. In
/// each a straight line tells the level or the one below it, which the border between the two decides. That
/// the line does so is checked for each bucket and each border when the table is made; where it does not, and
/// where a float is the same as that of the border, the borders are searched in double precision.
class LevelTable {
  public:
    /// `levels`: the highest level n, 1 … 65535. `gamma` > 0.
    LevelTable(int levels, double gamma);

    /// `curve` goes from 0 at 0 to 1 at 1 and never falls.
    LevelTable(int levels, const std::function<double(double)>& curve);

    /// The nearest level. Light outside of 0 … 1 is clipped; not a number counts as 0.
    int level_of(double light) const noexcept;

    /// The same of many; `levels` has room for as many. What takes the time when stimuli are loaded.
    void levels_of(std::span<const double> lights, int* levels) const noexcept;

    /// Where a light lies between the light of two neighbouring levels: level 7 and a quarter of the light's
    /// way to level 8 is 7.25. Clipped as above.
    double position_of(double light) const noexcept;

    int levels() const { return levels_; }

    /// Tells a level from light.
    struct Line {
        float start = 0.0f, slope = 0.0f;
    };

    /// What lies half-way between two levels, but for the rounding of the sums that led there, goes up.
    static constexpr double half = 0.5 + 1e-9;

  private:
    /// Bits of a float below those that number its bucket.
    static constexpr int below_bucket = 23 - 7;
    static int bucket_of(float light) { return std::bit_cast<std::int32_t>(light) >> below_bucket; }

    void tabulate(const std::function<double(double)>& curve);
    void draw_line(std::size_t bucket, float low, float high);
    bool tells_levels(std::size_t bucket, float low, float high) const;
    int told_level(std::size_t bucket, float light) const;
    int searched(double light) const noexcept;
    void find_levels(const double* lights, int count, int* levels) const noexcept;
    void search_unsure(const double* lights, int count, int* levels) const noexcept;
    double light_of(int level) const noexcept { return lights_[static_cast<std::size_t>(level)]; }

    int levels_;
    bool linear_;
    std::vector<double> borders_;     ///< light at which level i + 1 begins to be nearer than i
    std::vector<float> near_borders_; ///< the same rounded; behind the last what is above all light, and NaN
    std::vector<double> lights_;      ///< of each level
    int first_bucket_ = 0;            ///< before the first border; all darker light counts to it
    std::vector<Line> lines_;         ///< of each bucket
    std::vector<int> firsts_;         ///< borders below each bucket, and below 1 at the end
};

} // namespace overt
