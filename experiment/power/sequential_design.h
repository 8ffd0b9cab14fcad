/// Studies that are looked at while they grow, and end as soon as the effect is found: at which p they may.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "experiment/statistics/estimate.h"

namespace overt {

/// How the level of the test is spent as a study grows (Lan and DeMets, Biometrika 70, 1983, 659-663), half
/// of it on each side, by the share t of its observers. Like O'Brien and Fleming's bounds, which are strict
/// at the beginning: 2 - 2 Phi(z(a / 2) / sqrt(t)) of a = alpha / 2. Like Pocock's, which are nearly the same
/// at all looks: a ln(1 + (e - 1) t).
enum class AlphaSpending : std::uint8_t { obrien_fleming, pocock };

/// As --sequential names it.
std::string_view name_of(AlphaSpending spending);

/// By look, the p at which a study may end there so that without an effect no more than alpha of all studies
/// find one at any look. `observers`: after which numbers of them is looked, rising; at least one. Each
/// look's p is two-sided. By recursion over the distribution of a normal mean that has not crossed a bound so
/// far (Armitage, McPherson and Rowe, J. R. Stat. Soc. A 132, 1969, 235-244), with 0 < alpha < 1.
std::vector<double> sequential_levels(std::span<const int> observers, double alpha, AlphaSpending spending);

/// What studies with looks came to.
struct SequentialOutcome {
    std::vector<double> levels;  ///< by look
    std::vector<int> found;      ///< by look: studies that had found the effect up to it
    double mean_observers = 0.0; ///< with which studies ended
    Interval interval;           ///< Wilson's, 95 %, of the share found at any look
};

} // namespace overt
