#include "render/signal/level_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "experiment/base/error.h"
#include "render/image/processor_clones.h"

namespace overt {

namespace {

constexpr int unsure = -1;

/// Also for what is not a number.
inline double clipped(double light) {
    const double above = light > 0.0 ? light : 0.0;
    return above < 1.0 ? above : 1.0;
}

// The loops over many lights. Nothing in them may be rounded differently by one processor than by another, or
// would change a level if it were. Four lights are reckoned with together; a compiler has them in registers
// of whatever width there is.
using Four = double __attribute__((vector_size(32)));
using FourFloats = float __attribute__((vector_size(16)));
using FourInts = std::int32_t __attribute__((vector_size(16)));

inline __attribute__((always_inline)) void take_clipped(const double* lights, Four& light) {
    std::memcpy(&light, lights, sizeof light);
    const Four zero{}, one = Four{} + 1.0;
    light = light > zero ? light : zero;
    light = light < one ? light : one;
}

/// `count`: a multiple of 4, as in the next.
OVERT_PROCESSOR_CLONES("avx2")
void linear_levels(const double* lights, int count, double levels, int* into) {
    const Four all_levels = Four{} + levels, all_halves = Four{} + LevelTable::half;
    for (int i = 0; i < count; i += 4) {
        Four light;
        take_clipped(lights + i, light);
        const FourInts level = __builtin_convertvector(light * all_levels + all_halves, FourInts);
        std::memcpy(into + i, &level, sizeof level);
    }
}

/// Light as floats, and their buckets.
OVERT_PROCESSOR_CLONES("avx2")
void find_buckets(const double* lights, int count, int first_bucket, int below_bucket, float* floats,
                  int* buckets) {
    const FourInts first = FourInts{} + first_bucket, zero{};
    for (int i = 0; i < count; i += 4) {
        Four inside;
        take_clipped(lights + i, inside);
        const FourFloats light = __builtin_convertvector(inside, FourFloats);
        FourInts bucket;
        std::memcpy(&bucket, &light, sizeof bucket);
        bucket = (bucket >> below_bucket) - first;
        bucket = bucket > zero ? bucket : zero;
        std::memcpy(floats + i, &light, sizeof light);
        std::memcpy(buckets + i, &bucket, sizeof bucket);
    }
}

/// What the lines tell, and the borders above it. In a loop of its own, without clones: what is looked up in
/// tables at many places is not faster with wider registers, and compilers make it slower.
void look_up(const float* floats, const int* buckets, int count, const LevelTable::Line* lines,
             const float* borders, int* lowers, float* next_borders) {
    for (int i = 0; i < count; ++i) {
        const LevelTable::Line line = lines[buckets[i]];
        const int lower = static_cast<int>(line.start + line.slope * floats[i]);
        lowers[i] = lower;
        next_borders[i] = borders[lower];
    }
}

/// From the lower level to the level, or `unsure`.
OVERT_PROCESSOR_CLONES("avx2", "avx512f")
void decide(const float* floats, const float* next_borders, int count, int* levels) {
    for (int i = 0; i < count; ++i) {
        const int above = floats[i] > next_borders[i] ? 1 : 0, below = floats[i] < next_borders[i] ? 1 : 0;
        levels[i] = above + below == 1 ? levels[i] + above : unsure;
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
    for (const double border : borders_)
        near_borders_.push_back(static_cast<float>(border));
    near_borders_.push_back(2.0f);
    near_borders_.push_back(std::numeric_limits<float>::quiet_NaN());

    // A curve may be flat at its beginning: where the light of borders is 0, nothing is to be found.
    const auto lit = std::upper_bound(near_borders_.begin(), near_borders_.end() - 2, 0.0f);
    first_bucket_ = bucket_of(std::min(*lit, 1.0f)) - 1;
    const int buckets = bucket_of(1.0f) - first_bucket_ + 1;
    for (int bucket = 0; bucket < buckets; ++bucket) {
        const auto from = [&](int number) {
            return number <= 0 ? 0.0f : std::bit_cast<float>((first_bucket_ + number) << below_bucket);
        };
        const float low = from(bucket), high = std::min(std::nextafter(from(bucket + 1), 0.0f), 1.0f);
        firsts_.push_back(static_cast<int>(
            std::lower_bound(near_borders_.begin(), near_borders_.end() - 2, low) - near_borders_.begin()));
        draw_line(static_cast<std::size_t>(bucket), low, high);
    }
    firsts_.push_back(levels_);
}

/// Through the levels at both ends of a bucket, half a level too low; if that does not tell the levels in it,
/// flat, which does if there is one border in it or none; if that does not either, to a border that is none.
void LevelTable::draw_line(std::size_t bucket, float low, float high) {
    const auto place_of = [&](float light) {
        const auto next = std::lower_bound(borders_.begin(), borders_.end(), static_cast<double>(light));
        const auto level = static_cast<double>(next - borders_.begin());
        const double from = next == borders_.begin() ? 0.0 : *(next - 1);
        const double step = (next == borders_.end() ? 1.0 : *next) - from;
        return step > 0.0 ? level + (static_cast<double>(light) - from) / step : level;
    };
    const double begin = place_of(low), width = static_cast<double>(high) - static_cast<double>(low);
    const double slope = width > 0.0 ? std::max(0.0, place_of(high) - begin) / width : 0.0;
    const auto first = static_cast<float>(firsts_[bucket]);
    const std::array<Line, 3> lines{
        {{static_cast<float>(begin - 0.5 - slope * static_cast<double>(low)), static_cast<float>(slope)},
         {first, 0.0f},
         {static_cast<float>(levels_ + 1), 0.0f}}};
    lines_.emplace_back();
    for (const Line& line : lines) {
        lines_[bucket] = line;
        if (tells_levels(bucket, low, high))
            return;
    }
}

/// The level below or at that of a light, as look_up() has it.
int LevelTable::told_level(std::size_t bucket, float light) const {
    const float place = lines_[bucket].start + lines_[bucket].slope * light;
    return place > -1.0f && place < static_cast<float>(levels_ + 1) ? static_cast<int>(place) : unsure;
}

/// Whether for each float of a bucket the line tells the level, or the one below it, of all light that is
/// rounded to this float; and of a float that is that of a border, the one below it. Since a line never
/// falls, the bucket's ends, its borders and the floats beside them stand for all.
bool LevelTable::tells_levels(std::size_t bucket, float low, float high) const {
    if (!std::isfinite(lines_[bucket].start) || !std::isfinite(lines_[bucket].slope))
        return false;
    const int none_left = levels_;
    const auto border = [&](int number) { return near_borders_[static_cast<std::size_t>(number)]; };
    // Between borders, where `level` of them are below.
    const auto is_told = [&](float light, int level) {
        const int told = told_level(bucket, light);
        return told != unsure && (told == level || told == level - 1);
    };
    int first = firsts_[bucket];
    if (border(first) != low && !is_told(low, first))
        return false;
    while (first < none_left && border(first) <= high) {
        const float light = border(first);
        int beyond = first + 1;
        while (beyond < none_left && border(beyond) == light)
            ++beyond;
        const int told = told_level(bucket, light);
        const float before = std::nextafter(light, 0.0f), after = std::nextafter(light, 2.0f);
        if (told < first || told >= beyond)
            return false;
        if (before >= low && (first == 0 || border(first - 1) != before) && !is_told(before, first))
            return false;
        if (after <= high && border(beyond) != after && !is_told(after, beyond))
            return false;
        first = beyond;
    }
    return (first > 0 && border(first - 1) == high) || is_told(high, first);
}

/// The smallest level that makes this light, 0 … 1.
int LevelTable::searched(double light) const noexcept {
    const int bucket = std::max(bucket_of(static_cast<float>(light)) - first_bucket_, 0);
    const auto number = static_cast<std::size_t>(bucket);
    // A border whose float is in a bucket before this one is below the light; behind it, above.
    return static_cast<int>(
        std::lower_bound(borders_.begin() + firsts_[number], borders_.begin() + firsts_[number + 1], light) -
        borders_.begin());
}

/// Where levels are not sure, which the signs of some together tell quickly.
void LevelTable::search_unsure(const double* lights, int count, int* levels) const noexcept {
    constexpr int some = 16;
    for (int begin = 0; begin < count; begin += some) {
        const int end = std::min(begin + some, count);
        int signs = 0;
        for (int i = begin; i < end; ++i)
            signs |= levels[i];
        if (signs >= 0) [[likely]]
            continue;
        for (int i = begin; i < end; ++i) {
            if (levels[i] == unsure)
                levels[i] = searched(clipped(lights[i]));
        }
    }
}

int LevelTable::level_of(double light) const noexcept {
    int level = 0;
    levels_of({&light, 1}, &level);
    return level;
}

void LevelTable::levels_of(std::span<const double> lights, int* levels) const noexcept {
    const auto all = static_cast<int>(lights.size()), whole = all / 4 * 4;
    constexpr int most = 256;
    for (int begin = 0; begin < whole; begin += most)
        find_levels(lights.data() + begin, std::min(most, whole - begin), levels + begin);
    if (whole < all) {
        std::array<double, 4> rest{};
        std::array<int, 4> rest_levels{};
        std::copy(lights.begin() + whole, lights.end(), rest.begin());
        find_levels(rest.data(), 4, rest_levels.data());
        std::copy_n(rest_levels.begin(), all - whole, levels + whole);
    }
}

/// Of a multiple of 4, at most 256.
void LevelTable::find_levels(const double* lights, int count, int* levels) const noexcept {
    if (linear_) {
        linear_levels(lights, count, levels_, levels);
        return;
    }
    std::array<float, 256> floats, next_borders;
    std::array<int, 256> buckets;
    find_buckets(lights, count, first_bucket_, below_bucket, floats.data(), buckets.data());
    look_up(floats.data(), buckets.data(), count, lines_.data(), near_borders_.data(), levels,
            next_borders.data());
    decide(floats.data(), next_borders.data(), count, levels);
    search_unsure(lights, count, levels);
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
