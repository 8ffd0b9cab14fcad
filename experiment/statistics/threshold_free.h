/// Clusters without a threshold (TFCE; Smith and Nichols 2009, NeuroImage 44(1), 83-98), on any graph.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "experiment/statistics/cluster_test.h"

namespace overt {

/// A map of t put into one that says of each vertex how much of what lies around it supports it: the integral
/// over heights h from 0 to the vertex's t of area(h)^E h^H, where area(h) is that of the connected vertices
/// of the same sign that are at least as high. E = 0.5 and H = 2, as the authors advise; exact, not in steps
/// of h. Used again for each permutation; one thread.
class ThresholdFree {
  public:
    /// Both must outlive this.
    ThresholdFree(const Adjacency& adjacency, std::span<const double> areas);

    /// Gives the largest value of either sign, without its sign. `enhanced`: by vertex, with the sign of t;
    /// null: not asked for. Vertices whose t is 0 have 0, and belong to nothing.
    double enhance(std::span<const float> t, std::vector<float>* enhanced);

  private:
    std::uint32_t root_of(std::uint32_t vertex) const;
    void settle(std::uint32_t root, double height);
    double of_sign(std::span<const float> t, float sign, std::vector<float>* enhanced);

    const Adjacency& adjacency_;
    std::span<const double> areas_;
    std::vector<std::uint32_t> order_, parent_, members_;
    /// Of a root what all its members have in common, up to `height_`; of the others, less that of their
    /// parent.
    std::vector<double> sum_;
    std::vector<double> area_, height_, best_; ///< of roots; the best beyond the root's sum
    std::vector<bool> is_in_;
};

} // namespace overt
