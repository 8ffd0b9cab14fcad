/// The mean over pairs of observers, and how far it can be trusted.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "experiment/statistics/estimate.h"

namespace overt {

/// Numbers of two observers each. Pairs that share an observer depend on each other, so an interval that took
/// them, or the observers' means over them, for independent would be up to twice too narrow. It is that of
/// the jackknife for such means (Arvesen 1969, Annals of Mathematical Statistics 40(6), 2076-2100): with U
/// the mean over all pairs and U_k that over pairs without observer k, Student's interval of the numbers n U
/// - (n - 1) U_k.
class PairwiseMean {
  public:
    explicit PairwiseMean(std::size_t observers);

    /// One of the numbers of two different observers; of several the mean counts.
    void add(std::size_t a, std::size_t b, double value);

    /// Absent for the `reason` without a number; without an interval below four observers who have one.
    Estimate estimate(double confidence, const std::string& reason) const;

  private:
    struct Numbers {
        double sum = 0.0;
        int count = 0;
    };
    std::size_t observers_;
    std::vector<Numbers> numbers_; ///< by a and b, a < b
};

} // namespace overt
