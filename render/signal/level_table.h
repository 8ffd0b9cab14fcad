/// From light to the level of a signal that makes it: the inverse of a display's gamma.
#pragma once

#include <bit>
#include <cstddef>
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
/// To find a level fast, light falls into buckets, 64 to each doubling. In each a parabola tells about which
/// level it is, and by how much at most it may be wrong, which is taken from the borders themselves when the
/// table is made. Where that leaves open which of two levels it is, the borders are searched.
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

    /// Tells a level: start + d (slope + d bend), d being the light's distance from the begin of the bucket,
    /// is nowhere in the bucket further than `margin` from where a border says that one level ends and the
    /// next begins. Where it is no nearer than that to a whole number, the number below it is the level.
    struct Piece {
        double start = 0.0, slope = 0.0, bend = 0.0, margin = 1e9;
        double at(double distance) const { return start + distance * (slope + distance * bend); }
    };
    static constexpr int untold = -1;

    /// What lies half-way between two levels, but for the rounding of the sums that led there, goes up.
    static constexpr double half = 0.5 + 1e-9;

  private:
    /// Bits of a double below those that number its bucket.
    static constexpr int below_bucket = 52 - 6;
    static std::int64_t bucket_of(double light) { return std::bit_cast<std::int64_t>(light) >> below_bucket; }
    static double begin_of(std::int64_t bucket) { return std::bit_cast<double>(bucket << below_bucket); }

    void tabulate(const std::function<double(double)>& curve);
    Piece piece_of(std::size_t bucket, double low, double high) const;
    int searched(double light) const noexcept;
    void find_fours(const double* lights, std::size_t count, int* levels) const noexcept;
    double light_of(int level) const noexcept { return lights_[static_cast<std::size_t>(level)]; }

    int levels_;
    bool linear_;
    std::vector<double> borders_;   ///< light at which level i + 1 begins to be nearer than i
    std::vector<double> lights_;    ///< of each level
    std::int64_t first_bucket_ = 0; ///< before the first border; all darker light counts to it
    std::vector<Piece> pieces_;     ///< of each bucket
    std::vector<int> firsts_;       ///< borders below each bucket, and all at the end
};

} // namespace overt
