#include "experiment/study/difference_maps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

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
    for (const auto& [a, b] : observers) {
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
        ComparedFixations own{fixations_on(results, in_a, of.object), fixations_on(results, in_b, of.object)};
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

void test_differences(DifferenceMap& of, const LevelDifferences& differences, const FixationMaps& maps,
                      const StudyOptions& options) {
    ClusterTestSettings settings;
    settings.permutations = options.permutations;
    settings.seed = options.seed;
    const ClusterTest test =
        cluster_test(differences.of_observers, maps.visible_areas(), maps.adjacency(), settings);
    of.threshold_t = test.threshold_t;
    of.least_p = 1.0 / static_cast<double>(test.permutations);
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
    for (std::uint32_t v = 0; v < maps.geometry().vertex_count(); ++v) {
        const std::uint32_t sample = maps.samples().nearest(maps.geometry().node_of(v));
        of.cluster.push_back(sample == SurfaceSamples::none ? std::uint16_t{0} : numbers[sample]);
    }
}

} // namespace

void find_difference(DifferenceMap& of, const std::vector<ComparedFixations>& observers,
                     const FixationMaps& maps, const StudyOptions& options, const std::string& of_one) {
    of.observers = static_cast<int>(observers.size());
    if (of.observers == 1)
        of.absent = of_one;
    else
        test_differences(of, observer_differences(observers, maps), maps, options);
}

void correct_over_maps(std::vector<DifferenceMap>& maps) {
    const auto tested = static_cast<double>(
        std::ranges::count_if(maps, [](const DifferenceMap& map) { return map.absent.empty(); }));
    for (DifferenceMap& map : maps)
        for (DifferenceMap::Cluster& cluster : map.clusters)
            cluster.p_of_all = std::min(1.0, cluster.p * tested);
}

std::vector<DifferenceMap> difference_maps(const StudyResults& results, const ObjectFixationMaps& maps,
                                           const LevelLists& levels, const StudyOptions& options) {
    std::vector<DifferenceMap> rows;
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
                    const std::vector<ComparedFixations> compared_fixations =
                        compared_in(results, group, row);
                    if (compared_fixations.empty())
                        continue;
                    find_difference(row, compared_fixations, *maps[object], options,
                                    "one observer alone saw it in both levels");
                    rows.push_back(std::move(row));
                }
            }
        }
    }
    correct_over_maps(rows);
    return rows;
}

} // namespace overt
