#include "render/signal/level_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "experiment/base/error.h"
#include "render/image/processor_clones.h"

namespace overt {

namespace {

/// Also for what is not a number.
inline double clipped(double light) {
    const double above = light > 0.0 ? light : 0.0;
    return above < 1.0 ? above : 1.0;
}

// Four lights are reckoned with together; a compiler has them in registers of whatever width there is, and
// nothing is rounded differently by one processor than by another.
using Four = double __attribute__((vector_size(32)));
using FourInts = std::int32_t __attribute__((vector_size(16)));
using FourLongs = std::uint64_t __attribute__((vector_size(32)));

/// To least … 1; what is not a number is `least`.
inline __attribute__((always_inline)) void take_clipped(const double* lights, double least, Four& light) {
    std::memcpy(&light, lights, sizeof light);
    const Four zero{}, low = zero + least, one = zero + 1.0;
    light = light > low ? light : low;
    light = light < one ? light : one;
}

/// `count`: a multiple of 4.
OVERT_PROCESSOR_CLONES("avx2")
void linear_levels(const double* lights, std::size_t count, double levels, int* into) {
    const Four all_levels = Four{} + levels, all_halves = Four{} + LevelTable::half;
    for (std::size_t i = 0; i < count; i += 4) {
        Four light;
        take_clipped(lights + i, 0.0, light);
        const FourInts level = __builtin_convertvector(light * all_levels + all_halves, FourInts);
        std::memcpy(into + i, &level, sizeof level);
    }
}

/// The level of each, or LevelTable::untold; `count`: a multiple of 4. `first_bucket` begins at `least`.
OVERT_PROCESSOR_CLONES("avx2")
void told_levels(const double* lights, std::size_t count, const LevelTable::Piece* pieces, double least,
                 std::uint64_t first_bucket, int below_bucket, int* into) {
    const FourLongs first = FourLongs{} + first_bucket;
    for (std::size_t i = 0; i < count; i += 4) {
        Four light, begin;
        take_clipped(lights + i, least, light);
        FourLongs bits;
        std::memcpy(&bits, &light, sizeof bits);
        const FourLongs number = bits >> below_bucket;
        bits = number << below_bucket;
        std::memcpy(&begin, &bits, sizeof begin);
        std::uint64_t bucket[4];
        const FourLongs buckets = number - first;
        std::memcpy(bucket, &buckets, sizeof bucket);
        Four a, b, c, d;
        std::memcpy(&a, pieces + bucket[0], sizeof a);
        std::memcpy(&b, pieces + bucket[1], sizeof b);
        std::memcpy(&c, pieces + bucket[2], sizeof c);
        std::memcpy(&d, pieces + bucket[3], sizeof d);
        // From four pieces to four numbers of each kind.
        const Four ab_even = __builtin_shufflevector(a, b, 0, 4, 2, 6),
                   ab_odd = __builtin_shufflevector(a, b, 1, 5, 3, 7);
        const Four cd_even = __builtin_shufflevector(c, d, 0, 4, 2, 6),
                   cd_odd = __builtin_shufflevector(c, d, 1, 5, 3, 7);
        const Four start = __builtin_shufflevector(ab_even, cd_even, 0, 1, 4, 5);
        const Four slope = __builtin_shufflevector(ab_odd, cd_odd, 0, 1, 4, 5);
        const Four bend = __builtin_shufflevector(ab_even, cd_even, 2, 3, 6, 7);
        const Four margin = __builtin_shufflevector(ab_odd, cd_odd, 2, 3, 6, 7);
        const Four distance = light - begin;
        const Four place = start + distance * (slope + distance * bend);
        const FourInts low = __builtin_convertvector(place - margin, FourInts);
        const FourInts high = __builtin_convertvector(place + margin, FourInts);
        const FourInts level = low == high ? low : FourInts{} + LevelTable::untold;
        std::memcpy(into + i, &level, sizeof level);
    }
}

} // namespace

LevelTable::LevelTable(int levels, double gamma) : levels_(levels), linear_(gamma == 1.0) {
    OVERT_EXPECTS(levels >= 1 && levels <= 65535 && gamma > 0.0);
    if (!linear_)
        tabulate([gamma](double signal) { return std::pow(signal, gamma); });
}

LevelTable::LevelTable(int levels, const std::function<double(double)>& curve)
    : levels_(levels), linear_(false) {
    OVERT_EXPECTS(levels >= 1 && levels <= 65535 && curve(0.0) == 0.0 && curve(1.0) == 1.0);
    tabulate(curve);
}

void LevelTable::tabulate(const std::function<double(double)>& curve) {
    // The last digit of a curve may fall where the curve does not.
    const auto add = [](std::vector<double>& lights, double light) {
        lights.push_back(lights.empty() ? light : std::max(lights.back(), light));
    };
    for (int level = 0; level <= levels_; ++level)
        add(lights_, curve(static_cast<double>(level) / levels_));
    for (int level = 1; level <= levels_; ++level)
        add(borders_, curve((level - half) / levels_));

    // A curve may be flat at its beginning: where the light of borders is 0, nothing is to be found.
    const auto lit = std::upper_bound(borders_.begin(), borders_.end(), 0.0);
    first_bucket_ =
        std::max<std::int64_t>(bucket_of(lit == borders_.end() ? 1.0 : std::min(*lit, 1.0)) - 1, 0);
    const std::int64_t last_bucket = bucket_of(1.0);
    for (std::int64_t number = first_bucket_; number <= last_bucket; ++number) {
        const double low = number == first_bucket_ ? 0.0 : begin_of(number);
        firsts_.push_back(
            static_cast<int>(std::lower_bound(borders_.begin(), borders_.end(), low) - borders_.begin()));
    }
    firsts_.push_back(levels_);
    for (std::int64_t number = first_bucket_; number <= last_bucket; ++number) {
        // The first is as good as empty: what there is in it is searched.
        pieces_.push_back(number == first_bucket_
                              ? Piece{}
                              : piece_of(static_cast<std::size_t>(number - first_bucket_), begin_of(number),
                                         std::min(begin_of(number + 1), 1.0)));
    }
}

/// Through three places between the borders, and then held against each border in the bucket.
LevelTable::Piece LevelTable::piece_of(std::size_t bucket, double low, double high) const {
    const int first = firsts_[bucket], beyond = firsts_[bucket + 1];
    const auto border = [&](int number) { return borders_[static_cast<std::size_t>(number)]; };
    const auto place_of = [&](double light) {
        const auto from = borders_.begin() + first, to = borders_.begin() + beyond;
        const int next = first + static_cast<int>(std::lower_bound(from, to, light) - from);
        const double before = next == 0 ? 0.0 : border(next - 1);
        const double step = (next == levels_ ? 1.0 : border(next)) - before;
        return step > 0.0 ? next + (light - before) / step : next;
    };
    const double begin = place_of(low), middle = place_of(0.5 * (low + high)), end = place_of(high);
    const double width = high - low;
    Piece piece{begin, 0.0, 0.0, 0.0};
    if (width > 0.0) {
        piece.slope = (4.0 * middle - 3.0 * begin - end) / width;
        piece.bend = 2.0 * (begin - 2.0 * middle + end) / (width * width);
    }
    // A parabola that rises at both ends rises between them: then the borders and the ends stand for all.
    if (!std::isfinite(piece.bend) || piece.slope < 0.0 || piece.slope + 2.0 * width * piece.bend < 0.0)
        return {};
    double off = std::max({0.0, first - piece.at(0.0), piece.at(width) - (beyond + 1)});
    for (int number = first; number < beyond && border(number) <= high; ++number)
        off = std::max(off, std::abs(piece.at(border(number) - low) - (number + 1)));
    // Far more than what rounding adds to numbers up to 65,536.
    constexpr double rounding = 1e-7, most = 0.3;
    piece.margin = off + rounding;
    return piece.margin <= most ? piece : Piece{};
}

/// The smallest level that makes this light, 0 … 1.
int LevelTable::searched(double light) const noexcept {
    const auto bucket = static_cast<std::size_t>(std::max<std::int64_t>(bucket_of(light) - first_bucket_, 0));
    return static_cast<int>(
        std::lower_bound(borders_.begin() + firsts_[bucket], borders_.begin() + firsts_[bucket + 1], light) -
        borders_.begin());
}

int LevelTable::level_of(double light) const noexcept {
    std::array<double, 4> lights{light};
    std::array<int, 4> levels{};
    find_fours(lights.data(), 4, levels.data());
    return levels[0];
}

void LevelTable::levels_of(std::span<const double> lights, int* levels) const noexcept {
    const std::size_t whole = lights.size() / 4 * 4;
    find_fours(lights.data(), whole, levels);
    for (std::size_t i = whole; i < lights.size(); ++i)
        levels[i] = level_of(lights[i]);
}

void LevelTable::find_fours(const double* lights, std::size_t count, int* levels) const noexcept {
    if (linear_) {
        linear_levels(lights, count, levels_, levels);
        return;
    }
    told_levels(lights, count, pieces_.data(), begin_of(first_bucket_),
                static_cast<std::uint64_t>(first_bucket_), below_bucket, levels);
    for (std::size_t i = 0; i < count; i += 4) {
        // `untold` alone is negative.
        if ((levels[i] | levels[i + 1] | levels[i + 2] | levels[i + 3]) >= 0) [[likely]]
            continue;
        for (std::size_t k = i; k < i + 4; ++k) {
            if (levels[k] == untold)
                levels[k] = searched(clipped(lights[k]));
        }
    }
}

double LevelTable::position_of(double light) const noexcept {
    const double inside = clipped(light);
    if (linear_)
        return inside * levels_;
    int level = level_of(inside);
    if (light_of(level) > inside)
        --level;
    if (level == levels_)
        return levels_;
    const double step = light_of(level + 1) - light_of(level);
    return step > 0.0 ? level + (inside - light_of(level)) / step : level;
}

} // namespace overt
