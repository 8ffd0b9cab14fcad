/// Halves of observers, or of fixations, for reliability and noise ceilings.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

namespace overt {

/// What the correlation of two halves says of a measurement that is `factor` times as long as a half: factor
/// r / (1 + (factor - 1) r) (Spearman 1910, Brown 1910). r > -1 / (factor - 1).
double spearman_brown(double r, double factor = 2.0);

/// 0 … count-1 in two halves, at random by seed and index; of an odd number the first half has one less.
std::pair<std::vector<std::uint32_t>, std::vector<std::uint32_t>>
random_halves(std::uint32_t count, std::uint64_t seed, std::uint64_t index);

} // namespace overt
