#include "experiment/statistics/split_half.h"

#include <algorithm>
#include <numeric>

#include "experiment/base/random.h"

namespace overt {

double spearman_brown(double r, double factor) { return factor * r / (1.0 + (factor - 1.0) * r); }

std::pair<std::vector<std::uint32_t>, std::vector<std::uint32_t>>
random_halves(std::uint32_t count, std::uint64_t seed, std::uint64_t index) {
    std::vector<std::uint32_t> all(count);
    std::iota(all.begin(), all.end(), 0u);
    RandomStream random(seed, "halves", index);
    random.shuffle(std::span(all));
    const auto middle = all.begin() + count / 2;
    std::vector<std::uint32_t> first(all.begin(), middle), second(middle, all.end());
    std::sort(first.begin(), first.end());
    std::sort(second.begin(), second.end());
    return {std::move(first), std::move(second)};
}

} // namespace overt
