#include "experiment/study/time_clusters.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "experiment/statistics/cluster_test.h"
#include "experiment/study/area_shares.h"

namespace overt {

namespace {

/// Time of fixation by stretch: on the area, and on all of the object.
struct TimeOnArea {
    std::vector<double> inside, all;
    explicit TimeOnArea(int stretches) : inside(static_cast<std::size_t>(stretches), 0.0), all(inside) {}
};

void add_trial(TimeOnArea& to, const StudyResults& results, int trial, const std::string& area,
               double step_s) {
    for_each_counted(results, trial, [&](const StudyFixation& fixation) {
        const std::optional<bool> is_inside = is_on_area(results, fixation, area);
        if (!is_inside)
            return;
        const double end = fixation.onset_s + fixation.duration_s;
        for (std::size_t i = static_cast<std::size_t>(std::max(fixation.onset_s, 0.0) / step_s);
             i < to.all.size() && static_cast<double>(i) * step_s < end; ++i) {
            const double from = std::max(fixation.onset_s, static_cast<double>(i) * step_s),
                         until = std::min(end, static_cast<double>(i + 1) * step_s);
            to.all[i] += std::max(until - from, 0.0);
            to.inside[i] += *is_inside ? std::max(until - from, 0.0) : 0.0;
        }
    });
}

/// By observer the differences by stretch, of those who have both levels on an object with the area.
std::map<std::string, std::vector<float>> differences_in_time(const StudyResults& results,
                                                              const std::string& area, const std::string& a,
                                                              const std::string& b, int stretches,
                                                              const StudyOptions& options) {
    using Alike = std::vector<std::string>;
    std::map<std::pair<std::string, Alike>, std::pair<TimeOnArea, TimeOnArea>> cells;
    for (int trial = 0; trial < static_cast<int>(results.trials.size()); ++trial) {
        const StudyTrial& of = results.trials[static_cast<std::size_t>(trial)];
        const std::string& level = of.key(options.compare);
        if (of.excluded || (level != a && level != b))
            continue;
        Alike alike{std::to_string(of.object)};
        for (const std::string& column : options.by) {
            if (column != options.compare && column != "object")
                alike.push_back(of.key(column));
        }
        auto& [in_a, in_b] = cells
                                 .try_emplace({observer_of(results, trial), std::move(alike)},
                                              TimeOnArea(stretches), TimeOnArea(stretches))
                                 .first->second;
        add_trial(level == a ? in_a : in_b, results, trial, area, options.time_step_s);
    }
    std::map<std::string, std::vector<std::pair<double, int>>> sums;
    for (const auto& [cell, levels] : cells) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(stretches); ++i) {
            const auto& [in_a, in_b] = levels;
            if (!(in_a.all[i] > 0.0) || !(in_b.all[i] > 0.0))
                continue;
            auto& own = sums.try_emplace(cell.first, static_cast<std::size_t>(stretches), std::pair(0.0, 0))
                            .first->second[i];
            own.first += in_a.inside[i] / in_a.all[i] - in_b.inside[i] / in_b.all[i];
            ++own.second;
        }
    }
    std::map<std::string, std::vector<float>> differences;
    for (const auto& [observer, of] : sums) {
        for (const auto& [sum, count] : of)
            differences[observer].push_back(static_cast<float>(count > 0 ? sum / count : 0.0));
    }
    return differences;
}

/// Each stretch beside the next.
struct Chain {
    std::vector<std::uint32_t> begin{0}, neighbours;
    explicit Chain(int stretches) {
        for (int i = 0; i < stretches; ++i) {
            if (i > 0)
                neighbours.push_back(static_cast<std::uint32_t>(i - 1));
            if (i + 1 < stretches)
                neighbours.push_back(static_cast<std::uint32_t>(i + 1));
            begin.push_back(static_cast<std::uint32_t>(neighbours.size()));
        }
    }
};

} // namespace

double longest_presentation_s(const StudyResults& results) {
    double end_s = 0.0;
    for (const StudyTrial& trial : results.trials)
        end_s = std::max(end_s, trial.excluded ? 0.0 : trial.presentation_s);
    return end_s;
}

int stretches_of_time(const StudyResults& results, double time_step_s) {
    constexpr int most_stretches = 120;
    return std::min(most_stretches,
                    static_cast<int>(std::ceil(longest_presentation_s(results) / time_step_s - 1e-3)));
}

std::vector<TimeClusterRow> time_clusters(const StudyResults& results, const LevelLists& levels,
                                          const StudyOptions& options) {
    const int stretches = stretches_of_time(results, options.time_step_s);
    const std::vector<std::string> compared = levels_of(results, options.compare, levels);
    if (stretches < 1)
        return {};
    const Chain chain(stretches);
    const std::vector<double> seconds(static_cast<std::size_t>(stretches), options.time_step_s);
    std::map<std::string, std::size_t> observers;
    for (int trial = 0; trial < static_cast<int>(results.trials.size()); ++trial)
        observers.try_emplace(observer_of(results, trial), observers.size());

    struct Tested {
        TimeClusterRow row;
        std::optional<std::size_t> test; ///< index of its test
    };
    std::vector<Tested> tested;
    std::vector<ClusterTest> tests;
    for (const std::string& area : results.compared_areas) {
        for (std::size_t a = 0; a < compared.size(); ++a) {
            for (std::size_t b = a + 1; b < compared.size(); ++b) {
                Tested& one = tested.emplace_back();
                one.row.area = area;
                one.row.column = options.compare;
                one.row.a = compared[a];
                one.row.b = compared[b];
                std::vector<std::vector<float>> differences;
                ClusterTestSettings settings;
                settings.permutations = options.permutations;
                settings.seed = options.seed;
                settings.all_observers = observers.size();
                for (auto& [observer, of] :
                     differences_in_time(results, area, compared[a], compared[b], stretches, options)) {
                    settings.observers.push_back(observers.at(observer));
                    differences.push_back(std::move(of));
                }
                one.row.observers = static_cast<int>(differences.size());
                if (differences.size() < 2) {
                    one.row.absent = "fewer than two observers have fixations in both levels";
                    continue;
                }
                one.test = tests.size();
                tests.push_back(
                    cluster_test(differences, seconds, {chain.begin, chain.neighbours}, settings));
            }
        }
    }
    const std::vector<std::vector<double>> of_all = p_over_tests(tests);
    std::vector<TimeClusterRow> rows;
    for (Tested& one : tested) {
        if (!one.test) {
            rows.push_back(std::move(one.row));
            continue;
        }
        const ClusterTest& test = tests[*one.test];
        one.row.threshold_t = test.threshold_t;
        one.row.least_p = test.least_p;
        if (test.clusters.empty())
            rows.push_back(one.row);
        for (std::size_t i = 0; i < test.clusters.size(); ++i) {
            const Cluster& cluster = test.clusters[i];
            TimeClusterRow& row = rows.emplace_back(one.row);
            row.number = static_cast<int>(i) + 1;
            row.from_s = cluster.vertices.front() * options.time_step_s;
            row.to_s = (cluster.vertices.back() + 1) * options.time_step_s;
            row.mass = cluster.mass;
            for (const std::uint32_t stretch : cluster.vertices)
                row.difference += test.mean[stretch] / static_cast<double>(cluster.vertices.size());
            row.p = cluster.p;
            row.p_of_all = of_all[*one.test][i];
        }
    }
    return rows;
}

} // namespace overt
