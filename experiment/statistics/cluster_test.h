/// Where on a surface two conditions differ, corrected for having looked everywhere: the permutation test by
/// the largest cluster (Maris and Oostenveld 2007, J. Neurosci. Methods 164, 177-190), on any graph.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace overt {

/// Who is next to whom: the neighbours of vertex v are neighbours[begin[v]] … neighbours[begin[v + 1] - 1].
struct Adjacency {
    std::span<const std::uint32_t> begin; ///< one more than vertices
    std::span<const std::uint32_t> neighbours;
    std::size_t vertices() const { return begin.empty() ? 0 : begin.size() - 1; }
};

struct ClusterTestSettings {
    double threshold_p = 0.05; ///< two-sided, of a single vertex: what belongs to a cluster
    int permutations = 1000;   ///< random ones, where there are too many for all
    std::uint64_t most_exact = 4096;
    std::uint64_t seed = 1;
    int most_threads = 0;        ///< 0: all processors; the result is the same
    bool threshold_free = false; ///< ClusterTest::free_p is asked for, too
    /// Of several tests whose flips are to be the same: by difference the observer's number, and how many
    /// observers there are in all tests. Empty: those of this test.
    std::vector<std::size_t> observers;
    std::size_t all_observers = 0;
};

struct Cluster {
    std::vector<std::uint32_t> vertices; ///< rising
    double mass = 0.0;                   ///< sum of t times area; negative where the differences are
    double area = 0.0;
    double p = 1.0; ///< that chance alone makes a cluster of this size anywhere, in either direction
};

struct ClusterTest {
    std::vector<float> mean; ///< by vertex, over observers
    std::vector<float> t;    ///< by vertex; 0 where all differences are equal to 0 or there is no area
    double threshold_t = 0.0;
    std::vector<Cluster> clusters; ///< by falling size of their mass
    std::uint64_t permutations = 0;
    bool is_exact = false;
    double least_p = 1.0; ///< that so many observers can give
    /// By vertex: p of its value without a threshold (ThresholdFree), corrected for having looked everywhere;
    /// 1 where t is 0. Empty: not asked for.
    std::vector<float> free_p = {};
    std::vector<double>
        largest; ///< by flip the size of the largest cluster's mass; the first is the observed one
};

/// `differences`: of each observer one number by vertex (a less b); at least two observers. t is the mean
/// divided by its standard error; clusters are connected vertices beyond the threshold of the same sign. The
/// null: each observer's map of differences may as well have the other sign. All sign flips are made where
/// they are few enough; else random ones, of which the observed one is the first. No p is below `least_p`.
/// Vertices without area are left out.
ClusterTest cluster_test(std::span<const std::vector<float>> differences, std::span<const double> areas,
                         const Adjacency& adjacency, const ClusterTestSettings& settings);

/// Corrects over several tests that were made with the same flips: by test and cluster the p that chance
/// alone makes a cluster of this size in any of them. So that large objects do not decide alone, masses are
/// compared after division by the mean over all flips of the largest of their test.
std::vector<std::vector<double>> p_over_tests(std::span<const ClusterTest> tests);

} // namespace overt
