/// The sum of implicit steps that HeatTimes weighs, of several right-hand sides at once.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "experiment/surface/heat_times.h"
#include "experiment/surface/sparse_factor.h"

namespace overt {

/// The densities after weighted times, by Clenshaw's recurrence in 2 S - 1, with S = (masses) (factor)^-1 for
/// one step. `factor` is that of the masses plus a step of the flow. `multiply(densities)` replaces densities
/// by their masses. `add_sources(masses, k)` adds what has the weight of the k-th step to masses. All are in
/// the order of SparseFactor::solve. Allocates.
template <class Multiply, class AddSources>
std::vector<double> heat_densities(const SparseFactor& factor, const Multiply& multiply,
                                   const AddSources& add_sources) {
    std::vector<double> mass(SparseFactor::together * factor.size(), 0.0), before(mass.size(), 0.0), after;
    for (std::size_t k = HeatTimes::steps; k-- > 0;) {
        if (k + 1 < HeatTimes::steps) {
            const double twice = k > 0 ? 2.0 : 1.0;
            after = mass;
            factor.solve(after);
            multiply(after);
            for (std::size_t i = 0; i < mass.size(); ++i)
                before[i] = twice * (2.0 * after[i] - mass[i]) - before[i];
            std::swap(mass, before);
        }
        add_sources(mass, k);
    }
    factor.solve(mass);
    return mass;
}

} // namespace overt
