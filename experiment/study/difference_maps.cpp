#include "experiment/study/difference_maps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "experiment/study/study_maps.h"

namespace overt {

namespace {

/// The share of an observer's time of fixation, by vertex and mm^2.
std::vector<double> share_of_time(const FixationMaps& maps, const Fixations& fixations) {
    std::vector<double> map = maps.durations_of(fixations);
    double seconds = 0.0;
    for (const StudyFixation* fixation : fixations)
        seconds += fixation->duration_s;
    for (double& value : map)
        value /= seconds;
    return map;
}

/// The weights of one observer's fixations in a map of shares of time.
void add_shares(std::vector<SurfaceWeight>& weights, const Fixations& fixations) {
    double seconds = 0.0;
    for (const StudyFixation* fixation : fixations)
        seconds += fixation->duration_s;
    for (const StudyFixation* fixation : fixations)
        weights.push_back(weight_of(*fixation, fixation->duration_s / seconds));
}

/// What observers who saw an object in both levels give.
struct LevelDifferences {
    std::vector<std::vector<float>> of_observers;    ///< by sample
    std::vector<std::vector<SurfaceWeight>> sums{2}; ///< of the first level and of the second
};

LevelDifferences observer_differences(const std::vector<ComparedFixations>& observers,
                                      const FixationMaps& maps) {
    LevelDifferences found;
    for (const auto& [observer, a, b] : observers) {
        const std::vector<double> share_a = share_of_time(maps, a), share_b = share_of_time(maps, b);
        std::vector<float>& difference = found.of_observers.emplace_back();
        for (std::size_t v = 0; v < share_a.size(); ++v)
            difference.push_back(static_cast<float>(share_a[v] - share_b[v]));
        add_shares(found.sums[0], a);
        add_shares(found.sums[1], b);
    }
    return found;
}

/// Those of a group who saw the object in both levels.
std::vector<ComparedFixations> compared_in(const StudyResults& results, const StudyGroup& group,
                                           const DifferenceMap& of) {
    std::vector<ComparedFixations> compared;
    for (const auto& [observer, trials] : by_observer(results, group.trials)) {
        std::vector<int> in_a, in_b;
        for (const int trial : trials) {
            const std::string& level = results.trials[static_cast<std::size_t>(trial)].key(of.column);
            if (level == of.a)
                in_a.push_back(trial);
            else if (level == of.b)
                in_b.push_back(trial);
        }
        ComparedFixations own{observer, fixations_on(results, in_a, of.object),
                              fixations_on(results, in_b, of.object)};
        if (!own.a.empty() && !own.b.empty())
            compared.push_back(std::move(own));
    }
    return compared;
}

DifferenceMap::Cluster cluster_of(const Cluster& found, const FixationMaps& maps,
                                  std::span<const float> mean) {
    DifferenceMap::Cluster cluster;
    cluster.mass = found.mass;
    cluster.area_mm2 = found.area;
    cluster.p = found.p;
    std::array<double, 256> of_part{};
    double weights = 0.0;
    for (const std::uint32_t v : found.vertices) {
        const double difference = maps.areas()[v] * static_cast<double>(mean[v]),
                     weight = std::abs(difference);
        cluster.centroid_mm += weight * maps.position_mm(v);
        weights += weight;
        cluster.difference += difference;
        of_part[maps.part(v)] += weight;
    }
    if (weights > 0.0)
        cluster.centroid_mm /= weights;
    cluster.part = static_cast<PartIndex>(std::max_element(of_part.begin(), of_part.end()) - of_part.begin());
    return cluster;
}

/// What the test without a threshold says of the map and its clusters.
void add_threshold_free(DifferenceMap& of, const ClusterTest& test, std::span<const double> areas,
                        double confidence) {
    if (test.free_p.empty())
        return;
    float least = 1.0f;
    double area_mm2 = 0.0;
    for (std::size_t v = 0; v < test.free_p.size(); ++v) {
        least = std::min(least, test.free_p[v]);
        if (static_cast<double>(test.free_p[v]) <= 1.0 - confidence + 1e-9)
            area_mm2 += areas[v];
    }
    of.free_least_p = static_cast<double>(least);
    of.free_area_mm2 = area_mm2;
    for (std::size_t i = 0; i < of.clusters.size(); ++i) {
        float in_cluster = 1.0f;
        for (const std::uint32_t v : test.clusters[i].vertices)
            in_cluster = std::min(in_cluster, test.free_p[v]);
        of.clusters[i].free_p = static_cast<double>(in_cluster);
    }
}

ClusterTest test_differences(DifferenceMap& of, const LevelDifferences& differences, const FixationMaps& maps,
                             const ClusterTestSettings& settings, double confidence) {
    const ClusterTest test =
        cluster_test(differences.of_observers, maps.visible_areas(), maps.adjacency(), settings);
    of.threshold_t = test.threshold_t;
    of.least_p = test.least_p;
    const std::vector<std::vector<double>> sums = maps.at_vertices(differences.sums);
    for (std::size_t v = 0; v < sums[0].size(); ++v)
        of.difference.push_back(static_cast<float>((sums[0][v] - sums[1][v]) / of.observers));
    std::vector<std::uint16_t> numbers(test.mean.size(), 0);
    constexpr std::size_t most_clusters = std::numeric_limits<std::uint16_t>::max();
    for (std::size_t i = 0; i < std::min(test.clusters.size(), most_clusters); ++i) {
        of.clusters.push_back(cluster_of(test.clusters[i], maps, test.mean));
        for (const std::uint32_t v : test.clusters[i].vertices)
            numbers[v] = static_cast<std::uint16_t>(i + 1);
    }
    add_threshold_free(of, test, maps.visible_areas(), confidence);
    for (std::uint32_t v = 0; v < maps.geometry().vertex_count(); ++v) {
        const std::uint32_t sample = maps.samples().nearest(maps.geometry().node_of(v));
        of.cluster.push_back(sample == SurfaceSamples::none ? std::uint16_t{0} : numbers[sample]);
    }
    return test;
}

/// Numbers of all who take part in any map that is tested.
std::map<std::string, std::size_t> numbers_of_observers(const std::vector<ComparedLevels>& compared) {
    std::map<std::string, std::size_t> numbers;
    for (const ComparedLevels& one : compared) {
        for (const ComparedFixations& own : one.observers) {
            if (one.observers.size() > 1)
                numbers.try_emplace(own.observer, numbers.size());
        }
    }
    return numbers;
}

} // namespace

std::vector<DifferenceMap> find_differences(std::vector<ComparedLevels> compared,
                                            const ObjectFixationMaps& maps, const StudyOptions& options,
                                            const std::string& of_one) {
    const std::map<std::string, std::size_t> numbers = numbers_of_observers(compared);
    std::vector<DifferenceMap> found;
    std::vector<ClusterTest> tests;
    for (ComparedLevels& one : compared) {
        DifferenceMap& map = found.emplace_back(std::move(one.map));
        map.observers = static_cast<int>(one.observers.size());
        tests.emplace_back();
        if (map.observers == 1) {
            map.absent = of_one;
            continue;
        }
        ClusterTestSettings settings;
        settings.permutations = options.permutations;
        settings.threshold_free = options.threshold_free;
        settings.seed = options.seed;
        settings.all_observers = numbers.size();
        for (const ComparedFixations& own : one.observers)
            settings.observers.push_back(numbers.at(own.observer));
        const FixationMaps& on = *maps[static_cast<std::size_t>(map.object)];
        tests.back() =
            test_differences(map, observer_differences(one.observers, on), on, settings, options.confidence);
        for (Cluster& cluster : tests.back().clusters)
            cluster.vertices.clear(); // no longer asked for
    }
    const std::vector<std::vector<double>> p = p_over_tests(tests);
    for (std::size_t i = 0; i < found.size(); ++i) {
        for (std::size_t j = 0; j < found[i].clusters.size(); ++j)
            found[i].clusters[j].p_of_all = p[i][j];
    }
    return found;
}

std::vector<DifferenceMap> difference_maps(const StudyResults& results, const ObjectFixationMaps& maps,
                                           const LevelLists& levels, const StudyOptions& options) {
    std::vector<ComparedLevels> all;
    const std::vector<std::string> others = columns_beside_compared(options),
                                   compared = levels_of(results, options.compare, levels);
    std::vector<StudyGroup> groups = make_groups(results, {}, levels);
    if (!others.empty())
        std::ranges::copy(make_groups(results, others, levels), std::back_inserter(groups));
    for (std::size_t object = 0; object < maps.size(); ++object) {
        if (!maps[object])
            continue;
        for (const StudyGroup& group : groups) {
            for (std::size_t a = 0; a < compared.size(); ++a) {
                for (std::size_t b = a + 1; b < compared.size(); ++b) {
                    DifferenceMap row;
                    row.keys = group.keys;
                    row.object = static_cast<int>(object);
                    row.column = options.compare;
                    row.a = compared[a];
                    row.b = compared[b];
                    std::vector<ComparedFixations> observers = compared_in(results, group, row);
                    if (!observers.empty())
                        all.push_back({std::move(row), std::move(observers)});
                }
            }
        }
    }
    return find_differences(std::move(all), maps, options, "one observer alone saw it in both levels");
}

} // namespace overt
