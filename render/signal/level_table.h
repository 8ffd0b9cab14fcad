/// From light to the level of a signal that makes it: the inverse of a display's gamma.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace overt {

/// Levels 0 … n of a signal, of which level i makes the light curve(i / n), such as (i / n)^gamma. The light
/// at the borders between levels is tabulated in double precision, so that what comes out is floor(n * s +
/// 0.5) with s the smallest signal that makes the light, a billionth of a level short of a tie going up with
/// it, without the error of an inverted curve. Light falls into buckets, 128 to each doubling; within one the
/// levels are taken to lie evenly, which is right or next to right, and the borders there decide.
class LevelTable {
  public:
    /// `levels`: the highest level n, 1 … 65535. `gamma` > 0.
    LevelTable(int levels, double gamma);

    /// `curve` goes from 0 at 0 to 1 at 1 and never falls.
    LevelTable(int levels, const std::function<double(double)>& curve);

    /// The nearest level. Light outside of 0 … 1 is clipped; not a number counts as 0.
    int level_of(double light) const noexcept {
        const double inside = clipped(light);
        if (linear_)
            return static_cast<int>(inside * levels_ + half);
        return level_inside(inside);
    }

    /// The same of a table that is not linear, for light from 0 to 1.
    int level_inside(double light) const noexcept {
        const auto bits = std::bit_cast<std::uint64_t>(light);
        const std::uint64_t number = bits >> below_bucket;
        if (number < first_bucket_)
            return light > 0.0 ? level_after_zero_ : 0;
        const Bucket& bucket = buckets_[number - first_bucket_];
        const std::uint64_t within = bits & ((std::uint64_t{1} << below_bucket) - 1);
        const int guess =
            bucket.first + static_cast<int>((within >> 16) * static_cast<std::uint64_t>(bucket.count) >>
                                            (below_bucket - 16));
        // The level whose lower border is below this light, and whose upper one is not.
        // The level whose lower border is below this light, and whose upper one is not: the guess or one
        // beside it, taken without a branch, for which of them it is nobody can foretell.
        const double* border = bounded_.data() + guess;
        border +=
            static_cast<std::ptrdiff_t>(border[1] < light) - static_cast<std::ptrdiff_t>(light <= border[0]);
        if (border[0] < light && light <= border[1]) [[likely]]
            return static_cast<int>(border - bounded_.data());
        return searched(light);
    }

    /// Where a light lies between the light of two neighbouring levels: level 7 and a quarter of the light's
    /// way to level 8 is 7.25. Clipped as above.
    double position_of(double light) const noexcept;

    int levels() const { return levels_; }

    /// Levels make light in proportion: the level of light x in 0 … 1 is floor(x * levels() + half).
    bool is_linear() const { return linear_; }
    /// What lies half-way between two levels, but for the rounding of the sums that led there, goes up.
    static constexpr double half = 0.5 + 1e-9;

  private:
    /// Bits of a double below those that number its bucket.
    static constexpr int below_bucket = 52 - 7;
    /// Borders that begin in the bucket, from the first on.
    struct Bucket {
        int first = 0, count = 0;
    };

    void tabulate(const std::function<double(double)>& curve);
    int searched(double light) const noexcept;
    double light_of(int level) const noexcept { return lights_[static_cast<std::size_t>(level)]; }
    /// Also for what is not a number.
    static double clipped(double light) { return light > 0.0 ? (light < 1.0 ? light : 1.0) : 0.0; }

    int levels_;
    bool linear_;
    /// Light at which level i begins to be nearer than i - 1; before the first and behind the last, what is
    /// below and above all light.
    std::vector<double> bounded_;
    std::vector<double> lights_; ///< of each level
    std::vector<Bucket> buckets_;
    std::uint64_t first_bucket_ = 0;
    int level_after_zero_ = 0; ///< of light that is hardly any
};

} // namespace overt
