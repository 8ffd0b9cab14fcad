#include "experiment/statistics/cluster_test.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "experiment/base/parallel.h"
#include "experiment/base/random.h"
#include "experiment/statistics/distributions.h"
#include "experiment/statistics/threshold_free.h"

namespace overt {

namespace {

/// The differences, vertex by vertex, which a permutation reads through once.
class Differences {
  public:
    Differences(std::span<const std::vector<float>> differences, std::span<const double> areas)
        : observers_(differences.size()), areas_(areas) {
        for (std::uint32_t v = 0; v < areas.size(); ++v) {
            const bool is_zero = std::all_of(differences.begin(), differences.end(),
                                             [&](const auto& one) { return one[v] == 0.0f; });
            if (areas[v] > 0.0 && !is_zero)
                vertices_.push_back(v);
        }
        values_.reserve(vertices_.size() * observers_);
        squares_.reserve(vertices_.size());
        for (const std::uint32_t v : vertices_) {
            double squares = 0.0;
            for (const std::vector<float>& one : differences) {
                values_.push_back(one[v]);
                squares += static_cast<double>(one[v]) * one[v];
            }
            squares_.push_back(squares);
        }
    }

    /// Those that are not 0 for all observers.
    const std::vector<std::uint32_t>& vertices() const { return vertices_; }
    std::size_t observers() const { return observers_; }
    double area(std::uint32_t vertex) const { return areas_[vertex]; }

    /// Mean of the i-th of vertices() with these signs.
    double mean(std::size_t i, std::span<const double> signs) const {
        double sum = 0.0;
        for (std::size_t o = 0; o < observers_; ++o)
            sum += signs[o] * static_cast<double>(values_[i * observers_ + o]);
        return sum / static_cast<double>(observers_);
    }
    /// Mean over its standard error; signs leave the sum of squares as it is.
    double t_of(std::size_t i, double mean) const {
        const auto n = static_cast<double>(observers_);
        const double variance = (squares_[i] - n * mean * mean) / (n - 1.0);
        // All differences equal: as sure as rounding allows.
        const double least = 1e-12 * squares_[i] / n;
        return mean / std::sqrt(std::max(variance, least) / n);
    }

  private:
    std::size_t observers_;
    std::span<const double> areas_;
    std::vector<std::uint32_t> vertices_;
    std::vector<float> values_;
    std::vector<double> squares_;
};

/// Finds clusters in maps of t; used again for each permutation.
class ClusterSearch {
  public:
    ClusterSearch(const Differences& differences, const Adjacency& adjacency, double threshold)
        : differences_(differences), adjacency_(adjacency), threshold_(static_cast<float>(threshold)),
          t_(adjacency.vertices(), 0.0f) {}

    void reckon(std::span<const double> signs) {
        const std::vector<std::uint32_t>& vertices = differences_.vertices();
        for (std::size_t i = 0; i < vertices.size(); ++i)
            t_[vertices[i]] = static_cast<float>(differences_.t_of(i, differences_.mean(i, signs)));
    }

    const std::vector<float>& t() const { return t_; }

    /// Calls visit(vertices, mass, area) for each cluster. Forgets the map.
    template <class Visit> void for_each(const Visit& visit) {
        for (const std::uint32_t start : differences_.vertices()) {
            const float sign = std::copysign(1.0f, t_[start]);
            if (!(sign * t_[start] > threshold_))
                continue;
            cluster_.assign(1, start);
            double mass = take(start);
            double area = differences_.area(start);
            for (std::size_t next = 0; next < cluster_.size(); ++next) {
                const std::uint32_t v = cluster_[next];
                for (std::uint32_t i = adjacency_.begin[v]; i < adjacency_.begin[v + 1]; ++i) {
                    const std::uint32_t neighbour = adjacency_.neighbours[i];
                    if (sign * t_[neighbour] > threshold_) {
                        mass += take(neighbour);
                        area += differences_.area(neighbour);
                        cluster_.push_back(neighbour);
                    }
                }
            }
            visit(cluster_, mass, area);
        }
    }

  private:
    double take(std::uint32_t vertex) {
        const double mass = static_cast<double>(t_[vertex]) * differences_.area(vertex);
        t_[vertex] = 0.0f;
        return mass;
    }

    const Differences& differences_;
    const Adjacency& adjacency_;
    float threshold_;
    std::vector<float> t_;
    std::vector<std::uint32_t> cluster_;
};

/// Signs of the observers with these numbers, of so many in all.
void set_signs(std::span<double> signs, std::span<const std::size_t> numbers, std::size_t all,
               std::uint64_t permutation, bool is_exact, std::uint64_t seed) {
    RandomStream random(seed, "cluster test", permutation);
    std::vector<double> of_all(all, 1.0);
    for (std::size_t o = 0; o < all; ++o) {
        if (is_exact ? (permutation >> o & 1u) : permutation > 0 && (random.next_bits() & 1u))
            of_all[o] = -1.0;
    }
    for (std::size_t i = 0; i < numbers.size(); ++i)
        signs[i] = of_all[numbers[i]];
}

/// Of each vertex: how many flips have a value as large anywhere.
std::vector<float> p_without_threshold(const ClusterTest& test, const Adjacency& adjacency,
                                       std::span<const double> areas, std::vector<double> largest) {
    std::vector<float> enhanced;
    ThresholdFree(adjacency, areas).enhance(test.t, &enhanced);
    std::ranges::sort(largest);
    std::vector<float> p(test.t.size(), 1.0f);
    for (std::size_t v = 0; v < p.size(); ++v) {
        if (enhanced[v] == 0.0f)
            continue;
        // The value is rounded to a float, so that the observed flip's own largest counts as large as it is.
        const double size = std::abs(static_cast<double>(enhanced[v])) * (1.0 - 1e-6);
        const auto as_large = largest.end() - std::ranges::lower_bound(largest, size);
        p[v] = static_cast<float>(
            std::max(static_cast<double>(as_large) / static_cast<double>(largest.size()), test.least_p));
    }
    return p;
}

double share_of_as_large(const std::vector<double>& largest, double mass) {
    const double threshold = mass * (1.0 - 1e-9);
    return static_cast<double>(std::ranges::count_if(largest, [&](double one) { return one >= threshold; })) /
           static_cast<double>(largest.size());
}

} // namespace

ClusterTest cluster_test(std::span<const std::vector<float>> differences, std::span<const double> areas,
                         const Adjacency& adjacency, const ClusterTestSettings& settings) {
    const Differences all(differences, areas);
    const std::size_t observers = all.observers();
    ClusterTest test;
    test.threshold_t = student_quantile(1.0 - 0.5 * settings.threshold_p, static_cast<double>(observers - 1));
    std::vector<std::size_t> numbers = settings.observers;
    if (numbers.empty()) {
        numbers.resize(observers);
        std::iota(numbers.begin(), numbers.end(), std::size_t{0});
    }
    const std::size_t flipped_observers = std::max(settings.all_observers, observers);
    test.is_exact = flipped_observers < 63 && (std::uint64_t{1} << flipped_observers) <= settings.most_exact;
    // Flipping all signs gives the same clusters with the other sign: half of the flips are all.
    test.permutations = test.is_exact ? std::uint64_t{1} << (flipped_observers - 1)
                                      : static_cast<std::uint64_t>(settings.permutations);
    test.least_p = std::max(std::exp2(1.0 - static_cast<double>(observers)),
                            1.0 / static_cast<double>(test.permutations));

    std::vector<double> signs(observers, 1.0);
    ClusterSearch search(all, adjacency, test.threshold_t);
    search.reckon(signs);
    test.t = search.t();
    test.mean.assign(areas.size(), 0.0f);
    for (std::size_t i = 0; i < all.vertices().size(); ++i)
        test.mean[all.vertices()[i]] = static_cast<float>(all.mean(i, signs));
    search.for_each([&](const std::vector<std::uint32_t>& vertices, double mass, double area) {
        test.clusters.push_back({vertices, mass, area, 1.0});
        std::sort(test.clusters.back().vertices.begin(), test.clusters.back().vertices.end());
    });
    std::stable_sort(test.clusters.begin(), test.clusters.end(),
                     [](const Cluster& a, const Cluster& b) { return std::abs(a.mass) > std::abs(b.mass); });
    constexpr std::uint64_t at_a_time = 16;
    std::vector<double>& largest = test.largest;
    largest.assign(test.permutations, 0.0);
    std::vector<double> largest_free(settings.threshold_free ? test.permutations : 0, 0.0);
    parallel_for(
        static_cast<int>((test.permutations + at_a_time - 1) / at_a_time),
        [&](int turn) {
            ClusterSearch permuted(all, adjacency, test.threshold_t);
            std::optional<ThresholdFree> free;
            if (settings.threshold_free)
                free.emplace(adjacency, areas);
            std::vector<double> flipped(observers);
            const std::uint64_t begin = static_cast<std::uint64_t>(turn) * at_a_time;
            for (std::uint64_t i = begin; i < std::min(test.permutations, begin + at_a_time); ++i) {
                set_signs(flipped, numbers, flipped_observers, i, test.is_exact, settings.seed);
                permuted.reckon(flipped);
                if (free)
                    largest_free[i] = free->enhance(permuted.t(), nullptr);
                permuted.for_each([&](const auto&, double mass, double) {
                    largest[i] = std::max(largest[i], std::abs(mass));
                });
            }
        },
        settings.most_threads);
    for (Cluster& cluster : test.clusters) {
        // Random flips of many can by chance be fewer of these few than all.
        cluster.p = std::max(share_of_as_large(largest, std::abs(cluster.mass)), test.least_p);
    }
    if (settings.threshold_free)
        test.free_p = p_without_threshold(test, adjacency, areas, std::move(largest_free));
    return test;
}

std::vector<std::vector<double>> p_over_tests(std::span<const ClusterTest> tests) {
    std::vector<double> scales, largest;
    for (const ClusterTest& test : tests) {
        const double sum = std::accumulate(test.largest.begin(), test.largest.end(), 0.0);
        scales.push_back(sum > 0.0 ? static_cast<double>(test.largest.size()) / sum : 0.0);
        largest.resize(std::max(largest.size(), test.largest.size()), 0.0);
        for (std::size_t i = 0; i < test.largest.size(); ++i)
            largest[i] = std::max(largest[i], scales.back() * test.largest[i]);
    }
    std::vector<std::vector<double>> p;
    for (std::size_t i = 0; i < tests.size(); ++i) {
        std::vector<double>& own = p.emplace_back();
        for (const Cluster& cluster : tests[i].clusters)
            own.push_back(
                std::max(share_of_as_large(largest, scales[i] * std::abs(cluster.mass)), cluster.p));
    }
    return p;
}

} // namespace overt
