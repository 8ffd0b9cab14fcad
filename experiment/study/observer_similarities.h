/// How alike the maps of two observers are, who saw the same level or different ones.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "experiment/statistics/estimate.h"

namespace overt {

/// CC and both SIMs of two maps (map_similarity.h).
struct Similarities {
    static constexpr std::size_t count = 3;
    std::array<std::optional<double>, count> values; ///< CC, SIM as the MIT benchmark's, SIM as pysaliency's
};
Similarities similarities(std::span<const double> a, std::span<const double> b,
                          std::span<const double> areas);

/// The least that one of them can be; the most is 1.
constexpr double least_similarity(std::size_t which) { return which == 0 ? -1.0 : 0.0; }

/// The estimate with an interval that leaves out what a similarity cannot be.
Estimate within(Estimate estimate, double least);

/// An observer's maps of two levels on one object, each of as many fixations.
struct LikeMaps {
    std::size_t observer = 0, cell = 0; ///< the cell: what else is the same
    int object = 0;
    std::span<const double> a, b, areas;
};

/// One of the similarities, means over pairs of observers.
struct ObserverSimilarities {
    Estimate other_level; ///< level a of one, level b of the other
    Estimate same_level;  ///< level a of both, and level b of both
    Estimate difference;  ///< of the same level less of the other
};

/// Compares each two observers on each object in each cell. Where the levels make no difference, maps of the
/// same level are as alike as maps of different ones, whatever observers, trials and their errors of
/// calibration are like: no two maps are of one observer, and exchanging an observer's levels turns one
/// into the other. So the one is the ceiling of the other, and `difference` is 0 then.
///
/// `observers`: more than the numbers of observers. Reckons on all processors.
std::array<ObserverSimilarities, Similarities::count>
observer_similarities(std::span<const LikeMaps> maps, std::size_t observers, double confidence);

} // namespace overt
