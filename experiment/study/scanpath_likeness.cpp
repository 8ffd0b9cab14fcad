#include "experiment/study/scanpath_likeness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "experiment/base/parallel.h"
#include "experiment/base/random.h"
#include "experiment/statistics/pairwise_mean.h"
#include "experiment/statistics/scanpath_measures.h"

namespace overt {

namespace {

constexpr std::array likeness_names{"scanmatch",           "multimatch_shape",
                                    "multimatch_length",   "multimatch_direction",
                                    "multimatch_position", "multimatch_duration"};
using Likeness = std::array<std::optional<double>, likeness_names.size()>;

/// A trial's counted fixations that have a place.
struct TrialWay {
    std::vector<const StudyFixation*> fixations;
    std::vector<double> durations;
    std::vector<GazeStep> steps;
};

TrialWay way_of(std::vector<const StudyFixation*> fixations, const SurfaceDistances& distances,
                double mm_per_unit) {
    TrialWay way;
    for (std::size_t i = 0; i < fixations.size(); ++i) {
        way.durations.push_back(fixations[i]->duration_s);
        if (i == 0)
            continue;
        const glm::dvec3 step = mm_per_unit * (fixations[i]->position - fixations[i - 1]->position);
        const double along = distances.between(*fixations[i - 1], *fixations[i]);
        way.steps.push_back({std::isfinite(along) ? along : glm::length(step), step.x, step.y, step.z});
    }
    way.fixations = std::move(fixations);
    return way;
}

/// In an order by chance, the same for the same trial.
TrialWay shuffled(const TrialWay& way, const SurfaceDistances& distances, double mm_per_unit,
                  std::uint64_t seed, int trial) {
    std::vector<const StudyFixation*> fixations = way.fixations;
    RandomStream random(seed, "order of fixations", static_cast<std::uint64_t>(trial));
    for (std::size_t i = fixations.size(); i > 1; --i)
        std::swap(
            fixations[i - 1],
            fixations[std::min(i - 1, static_cast<std::size_t>(random.uniform() * static_cast<double>(i)))]);
    return way_of(std::move(fixations), distances, mm_per_unit);
}

/// What all ways on an object are measured by.
struct OnObject {
    const SurfaceDistances& distances;
    double threshold_mm = 0.0; ///< of ScanMatch
};

Likeness likeness_of(const TrialWay& a, const TrialWay& b, const OnObject& on) {
    const FixationDistance distance = [&](std::size_t of_a, std::size_t of_b) {
        return on.distances.between(*a.fixations[of_a], *b.fixations[of_b]);
    };
    Likeness found;
    if (on.threshold_mm > 0.0)
        found[0] = scan_match(a.durations, b.durations, distance, on.threshold_mm, scan_match_bin_s);
    if (on.distances.extent_mm() > 0.0) {
        if (const auto match = multi_match({a.durations, a.steps}, {b.durations, b.steps}, distance,
                                           on.distances.extent_mm())) {
            found[1] = match->shape;
            found[2] = match->length;
            found[3] = match->direction;
            found[4] = match->position;
            found[5] = match->duration;
        }
    }
    return found;
}

/// Trials of all observers on one object, alike in all but the compared column.
struct LikeTrials {
    int object = 0;
    std::vector<std::string> alike;
    auto operator<=>(const LikeTrials&) const = default;
};

/// By observer, and level.
using TrialsOfObservers = std::map<std::size_t, std::array<std::vector<int>, 2>>;

class WaysCompared {
  public:
    WaysCompared(const StudyResults& results, const ObjectDistances& distances, const StudyOptions& options)
        : results_(results), distances_(distances), options_(options), ways_(results.trials.size()),
          shuffled_(results.trials.size()) {
        std::vector<std::pair<double, double>> sums(distances.size());
        std::vector<double> counts(distances.size(), 0.0);
        for (int trial = 0; trial < static_cast<int>(ways_.size()); ++trial) {
            const auto index = static_cast<std::size_t>(trial);
            const auto object = static_cast<std::size_t>(results.trials[index].object);
            const StudyObject& shown = results.objects[object];
            if (results.trials[index].excluded || !distances[object] || !shown.mm_per_unit)
                continue;
            std::vector<const StudyFixation*> fixations;
            for_each_counted(results, trial, [&](const StudyFixation& fixation) {
                if (fixation.triangle)
                    fixations.push_back(&fixation);
            });
            ways_[index] = way_of(std::move(fixations), *distances[object], *shown.mm_per_unit);
            shuffled_[index] =
                shuffled(ways_[index], *distances[object], *shown.mm_per_unit, options.seed, trial);
            for (const GazeStep& step : ways_[index].steps) {
                sums[object].first += step.length;
                sums[object].second += step.length * step.length;
                ++counts[object];
            }
        }
        for (std::size_t object = 0; object < distances.size(); ++object) {
            const double mean = counts[object] > 0.0 ? sums[object].first / counts[object] : 0.0;
            const double variance =
                counts[object] > 0.0 ? sums[object].second / counts[object] - mean * mean : 0.0;
            thresholds_mm_.push_back(2.0 * std::sqrt(std::max(variance, 0.0)));
        }
        for (int trial = 0; trial < static_cast<int>(results.trials.size()); ++trial)
            observers_.try_emplace(observer_of(results, trial), observers_.size());
    }

    /// Rows of two levels, of some trials.
    std::vector<ScanpathLikenessRow> rows(const std::vector<int>& trials, const std::vector<StudyKey>& keys,
                                          const std::string& a, const std::string& b) const {
        std::vector<Sums> sums(likeness_names.size(), Sums(observers_.size()));
        std::map<std::size_t, bool> compared;
        for (const auto& [like, of_observers] : like_trials(trials, a, b))
            compare(like.object, of_observers, sums, compared);
        std::vector<ScanpathLikenessRow> found;
        const std::string reason = "no two observers have ways of gaze on one object in both levels";
        for (std::size_t i = 0; i < likeness_names.size(); ++i) {
            ScanpathLikenessRow& row = found.emplace_back();
            row.measure = likeness_names[i];
            row.keys = keys;
            row.column = options_.compare;
            row.a = a;
            row.b = b;
            row.same_level = sums[i].same.estimate(options_.confidence, reason);
            row.other_level = sums[i].other.estimate(options_.confidence, reason);
            row.level_effect = sums[i].effect.estimate(options_.confidence, reason);
            row.shuffled = sums[i].shuffled.estimate(options_.confidence, reason);
            row.observers = static_cast<int>(compared.size());
        }
        return found;
    }

  private:
    struct Sums {
        explicit Sums(std::size_t observers)
            : same(observers), other(observers), effect(observers), shuffled(observers) {}
        PairwiseMean same, other, effect, shuffled;
    };

    std::map<LikeTrials, TrialsOfObservers> like_trials(const std::vector<int>& trials, const std::string& a,
                                                        const std::string& b) const {
        std::map<LikeTrials, TrialsOfObservers> found;
        for (const int trial : trials) {
            const StudyTrial& of = results_.trials[static_cast<std::size_t>(trial)];
            const std::string& level = of.key(options_.compare);
            if ((level != a && level != b) || ways_[static_cast<std::size_t>(trial)].fixations.empty())
                continue;
            LikeTrials like{of.object, {}};
            for (const std::string& column : options_.by) {
                if (column != options_.compare && column != "object")
                    like.alike.push_back(of.key(column));
            }
            found[std::move(like)][observers_.at(observer_of(results_, trial))][level == a ? 0 : 1].push_back(
                trial);
        }
        for (auto& [like, observers] : found)
            std::erase_if(observers,
                          [](const auto& one) { return one.second[0].empty() || one.second[1].empty(); });
        return found;
    }

    /// Mean over each two trials of both; `other` of the second observer are shuffled or not.
    Likeness mean_likeness(const std::vector<int>& of_one, const std::vector<int>& of_other,
                           const std::vector<TrialWay>& other_ways, const OnObject& on) const {
        std::array<std::pair<double, int>, likeness_names.size()> sums{};
        for (const int one : of_one) {
            for (const int other : of_other) {
                const Likeness found = likeness_of(ways_[static_cast<std::size_t>(one)],
                                                   other_ways[static_cast<std::size_t>(other)], on);
                for (std::size_t i = 0; i < found.size(); ++i) {
                    if (found[i]) {
                        sums[i].first += *found[i];
                        ++sums[i].second;
                    }
                }
            }
        }
        Likeness means;
        for (std::size_t i = 0; i < means.size(); ++i) {
            if (sums[i].second > 0)
                means[i] = sums[i].first / sums[i].second;
        }
        return means;
    }

    void compare(int object, const TrialsOfObservers& observers, std::vector<Sums>& sums,
                 std::map<std::size_t, bool>& compared) const {
        const OnObject on{*distances_[static_cast<std::size_t>(object)],
                          thresholds_mm_[static_cast<std::size_t>(object)]};
        using Trials = TrialsOfObservers::const_iterator;
        std::vector<std::pair<Trials, Trials>> pairs;
        for (Trials one = observers.begin(); one != observers.end(); ++one) {
            for (Trials other = std::next(one); other != observers.end(); ++other)
                pairs.emplace_back(one, other);
        }
        struct OfPair {
            std::array<Likeness, 2> same, other, shuffled;
        };
        std::vector<OfPair> found(pairs.size());
        parallel_for(static_cast<int>(pairs.size()), [&](int i) {
            const auto& [one, other] = pairs[static_cast<std::size_t>(i)];
            OfPair& of = found[static_cast<std::size_t>(i)];
            for (const std::size_t level : {std::size_t{0}, std::size_t{1}}) {
                of.same[level] = mean_likeness(one->second[level], other->second[level], ways_, on);
                of.other[level] = mean_likeness(one->second[level], other->second[1 - level], ways_, on);
                of.shuffled[level] = mean_likeness(one->second[level], other->second[level], shuffled_, on);
            }
        });
        for (std::size_t i = 0; i < pairs.size(); ++i) {
            const std::size_t one = pairs[i].first->first, other = pairs[i].second->first;
            for (std::size_t which = 0; which < likeness_names.size(); ++which) {
                const auto both = [&](const std::array<Likeness, 2>& of) -> std::optional<double> {
                    return of[0][which] && of[1][which] ? std::optional(0.5 * (*of[0][which] + *of[1][which]))
                                                        : std::nullopt;
                };
                const std::optional<double> same = both(found[i].same), different = both(found[i].other),
                                            by_chance = both(found[i].shuffled);
                if (!same || !different || !by_chance)
                    continue;
                sums[which].same.add(one, other, *same);
                sums[which].other.add(one, other, *different);
                sums[which].effect.add(one, other, *same - *different);
                sums[which].shuffled.add(one, other, *by_chance);
                compared[one] = compared[other] = true;
            }
        }
    }

    const StudyResults& results_;
    const ObjectDistances& distances_;
    const StudyOptions& options_;
    std::vector<TrialWay> ways_, shuffled_; ///< by trial
    std::vector<double> thresholds_mm_;     ///< by object
    std::map<std::string, std::size_t> observers_;
};

} // namespace

std::vector<ScanpathLikenessRow> scanpath_likeness(const StudyResults& results,
                                                   const ObjectDistances& distances, const LevelLists& levels,
                                                   const StudyOptions& options) {
    const std::vector<std::string> compared = levels_of(results, options.compare, levels);
    if (compared.size() < 2)
        return {};
    const WaysCompared ways(results, distances, options);
    std::vector<StudyGroup> groups = make_groups(results, columns_beside_compared(options), levels);
    if (groups.size() > 1)
        groups.push_back(make_groups(results, {}, levels).front());
    std::vector<ScanpathLikenessRow> rows;
    for (const StudyGroup& group : groups) {
        for (std::size_t a = 0; a < compared.size(); ++a) {
            for (std::size_t b = a + 1; b < compared.size(); ++b) {
                for (ScanpathLikenessRow& row :
                     ways.rows(group.trials, group.keys, compared[a], compared[b])) {
                    if (row.observers > 1)
                        rows.push_back(std::move(row));
                }
            }
        }
    }
    return rows;
}

} // namespace overt
