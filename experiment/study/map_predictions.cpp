#include "experiment/study/map_predictions.h"

#include <algorithm>
#include <array>
#include <set>
#include <tuple>
#include <utility>

#include "experiment/base/parallel.h"
#include "experiment/statistics/area_under_curve.h"
#include "experiment/statistics/bootstrap.h"
#include "experiment/statistics/map_similarity.h"
#include "experiment/study/study_maps.h"

namespace overt {

namespace {

/// One observer's fixations in a group, on one object.
struct ObserverMap {
    std::string observer;
    Fixations fixations;
    std::vector<double> map; ///< their sum
};

/// All that a group has on one object.
struct GroupMaps {
    int group = 0;
    std::string level; ///< of the compared column; empty if it makes no groups
    std::vector<ObserverMap> observers;
    std::vector<double> sum;
};

GroupMaps maps_of_group(const StudyResults& results, int group, int object, const FixationMaps& maps,
                        const std::string& compared) {
    const StudyGroup& of = results.groups[static_cast<std::size_t>(group)];
    GroupMaps made;
    made.group = group;
    for (const StudyKey& key : of.keys) {
        if (key.column == compared)
            made.level = key.value;
    }
    made.sum.assign(maps.areas().size(), 0.0);
    for (const auto& [observer, trials] : by_observer(results, of.trials)) {
        Fixations own = fixations_on(results, trials, object);
        if (own.empty())
            continue;
        std::vector<double> map = maps.sum_of(own);
        for (std::size_t v = 0; v < map.size(); ++v)
            made.sum[v] += map[v];
        made.observers.push_back({observer, std::move(own), std::move(map)});
    }
    return made;
}

/// Whether all keys but the compared one are alike.
bool differ_in_level_alone(const StudyResults& results, const GroupMaps& a, const GroupMaps& b,
                           const std::string& compared) {
    const auto& in_a = results.groups[static_cast<std::size_t>(a.group)].keys;
    const auto& in_b = results.groups[static_cast<std::size_t>(b.group)].keys;
    if (a.level.empty() || a.level == b.level)
        return false;
    for (std::size_t i = 0; i < in_a.size(); ++i) {
        if (in_a[i].column != compared && !(in_a[i] == in_b[i]))
            return false;
    }
    return true;
}

/// What one observer's fixations give. Those that need no sorting come first: KL, NSS, both gains; then AUC
/// after Judd and after Borji.
struct Scores {
    static constexpr std::size_t count = 6, without_sorting = 4;
    std::array<std::optional<double>, count> values;
};

/// A map that predicts: on the surface, and at the fixations that are to be told.
struct PredictingMap {
    std::vector<double> density, at_fixations;
};

Scores scores_of(const ObserverMap& of, const PredictingMap& by, const FixationMaps& maps, bool is_exposure) {
    const std::span<const double> areas = maps.visible_areas();
    const std::vector<double> even(areas.size(), 1.0), even_there(of.fixations.size(), 1.0);
    const auto& [predicting, at_fixations] = by;
    Scores scores;
    scores.values = {kl_divergence(predicting, of.map, areas),
                     nss(predicting, areas, at_fixations),
                     is_exposure ? std::nullopt
                                 : information_gain(predicting, maps.exposure(), areas, at_fixations,
                                                    maps.exposure_at(of.fixations)),
                     information_gain(predicting, even, areas, at_fixations, even_there),
                     std::nullopt,
                     std::nullopt};
    return scores;
}

void add_areas_under_curves(Scores& scores, const PredictingMap& by, const FixationMaps& maps,
                            std::uint64_t seed) {
    scores.values[4] = auc_judd(by.density, maps.visible_areas(), by.at_fixations);
    scores.values[5] = auc_borji(by.density, maps.visible_areas(), by.at_fixations, seed);
}

/// Maps that tell one observer's fixations, of some of the observers of a group and the exposure as one
/// fixation more.
class Predictors {
  public:
    Predictors(const GroupMaps& from, const ObserverMap& told, const FixationMaps& maps)
        : from_(from), told_(told), maps_(maps), exposure_there_(maps.exposure_at(told.fixations)) {
        for (const ObserverMap& one : from.observers)
            there_.push_back(one.observer == told.observer ? std::vector<double>()
                                                           : maps.sum_at(one.fixations, told.fixations));
    }

    /// Of all but the one who is told, and the one with this label; empty if nobody else has any fixations.
    PredictingMap without(const std::string& left_out) const {
        PredictingMap map{from_.sum, exposure_there_};
        std::size_t fixations = 0;
        for (std::size_t i = 0; i < from_.observers.size(); ++i) {
            const ObserverMap& one = from_.observers[i];
            if (one.observer == told_.observer || one.observer == left_out) {
                for (std::size_t v = 0; v < map.density.size(); ++v)
                    map.density[v] = std::max(map.density[v] - one.map[v], 0.0);
                continue;
            }
            fixations += one.fixations.size();
            for (std::size_t f = 0; f < map.at_fixations.size(); ++f)
                map.at_fixations[f] += there_[i][f];
        }
        if (fixations == 0)
            return {};
        const double count = static_cast<double>(fixations + 1);
        for (std::size_t v = 0; v < map.density.size(); ++v)
            map.density[v] = (map.density[v] + maps_.exposure()[v]) / count;
        for (double& value : map.at_fixations)
            value /= count;
        return map;
    }

  private:
    const GroupMaps& from_;
    const ObserverMap& told_;
    const FixationMaps& maps_;
    std::vector<double> exposure_there_;
    std::vector<std::vector<double>> there_; ///< what each observer's map has at the fixations
};

/// A row to be made, and the group whose fixations predict; null: the exposure.
struct Prediction {
    MapPredictionRow row;
    const GroupMaps* told;
    const GroupMaps* by;
    std::vector<Scores> scores;
    /// By observer who is left out, of those who tell or are told: means of the scores that need no sorting.
    std::vector<Scores> without;
};

/// Scores again with each observer left out, of whom nothing is told and who tells nothing.
void leave_each_out(Prediction& of, const FixationMaps& maps, const std::vector<Predictors>& predictors) {
    std::set<std::string> observers;
    for (const GroupMaps* group : {of.told, of.by}) {
        for (const ObserverMap& one : group->observers)
            observers.insert(one.observer);
    }
    for (const std::string& left_out : observers) {
        std::array<std::pair<double, int>, Scores::without_sorting> sums{};
        for (std::size_t i = 0; i < predictors.size(); ++i) {
            const ObserverMap& told = of.told->observers[i];
            if (told.observer == left_out)
                continue;
            const PredictingMap predicting = predictors[i].without(left_out);
            if (predicting.density.empty())
                continue;
            const Scores scores = scores_of(told, predicting, maps, false);
            for (std::size_t which = 0; which < sums.size(); ++which) {
                if (scores.values[which]) {
                    sums[which].first += *scores.values[which];
                    ++sums[which].second;
                }
            }
        }
        Scores& means = of.without.emplace_back();
        for (std::size_t which = 0; which < sums.size(); ++which) {
            if (sums[which].second > 0)
                means.values[which] = sums[which].first / sums[which].second;
        }
    }
}

void reckon_prediction(Prediction& of, const FixationMaps& maps, std::uint64_t seed) {
    std::vector<Predictors> predictors;
    for (const ObserverMap& observer : of.told->observers) {
        PredictingMap predicting{{maps.exposure().begin(), maps.exposure().end()}, {}};
        if (of.by)
            predicting = predictors.emplace_back(*of.by, observer, maps).without(observer.observer);
        else
            predicting.at_fixations = maps.exposure_at(observer.fixations);
        if (predicting.density.empty())
            continue;
        of.scores.push_back(scores_of(observer, predicting, maps, !of.by));
        add_areas_under_curves(of.scores.back(), predicting, maps, seed);
    }
    if (of.by)
        leave_each_out(of, maps, predictors);
}

/// The interval of a mean whose predicting maps vary with the observers, too.
std::optional<Interval> interval_of(const Prediction& of, std::size_t which, double mean, double confidence) {
    std::vector<double> without;
    for (const Scores& scores : of.without) {
        if (scores.values[which])
            without.push_back(*scores.values[which]);
    }
    std::optional<Interval> interval = jackknife_interval(mean, without, confidence);
    if (interval && which == 0) // KL is a distance
        interval->low = std::max(interval->low, 0.0);
    return interval;
}

void finish_row(Prediction& of, const StudyOptions& options) {
    MapPredictionRow& row = of.row;
    row.observers = static_cast<int>(of.scores.size());
    for (const ObserverMap& observer : of.told->observers)
        row.fixations += static_cast<int>(observer.fixations.size());
    std::string absent = "no fixation was counted";
    if (!of.told->observers.empty())
        absent = "no other observer has fixations there";
    const std::array<Estimate*, Scores::count> estimates{
        &row.kl, &row.nss, &row.gain_over_exposure, &row.gain_over_area, &row.auc_judd, &row.auc_borji};
    for (std::size_t i = 0; i < estimates.size(); ++i) {
        std::vector<double> values;
        for (const Scores& scores : of.scores) {
            if (scores.values[i])
                values.push_back(*scores.values[i]);
        }
        const bool is_of_itself = !of.by && estimates[i] == &row.gain_over_exposure;
        *estimates[i] = estimated_mean(values, options.bootstrap(),
                                       is_of_itself ? "the exposure is the baseline itself" : absent);
        if (of.by && i < Scores::without_sorting && estimates[i]->value)
            estimates[i]->interval = interval_of(of, i, *estimates[i]->value, options.confidence);
    }
}

} // namespace

std::vector<MapPredictionRow> map_predictions(const StudyResults& results, const ObjectFixationMaps& maps,
                                              const StudyOptions& options) {
    std::vector<MapPredictionRow> rows;
    for (int object = 0; object < static_cast<int>(maps.size()); ++object) {
        const FixationMaps* own = maps[static_cast<std::size_t>(object)].get();
        if (!own || own->exposure().empty())
            continue;
        std::vector<GroupMaps> groups;
        for (int group = 0; group < static_cast<int>(results.groups.size()); ++group) {
            const std::vector<int> shown =
                objects_of(results, results.groups[static_cast<std::size_t>(group)]);
            if (std::binary_search(shown.begin(), shown.end(), object))
                groups.push_back(maps_of_group(results, group, object, *own, options.compare));
        }
        std::vector<Prediction> predictions;
        const auto add = [&](const GroupMaps& told, MapPredictor by, const GroupMaps* from) {
            MapPredictionRow row;
            row.group = told.group;
            row.object = object;
            row.by = by;
            row.level = from ? from->level : "";
            predictions.push_back({std::move(row), &told, from, {}, {}});
        };
        for (const GroupMaps& told : groups) {
            add(told, MapPredictor::same_level, &told);
            for (const GroupMaps& other : groups) {
                if (differ_in_level_alone(results, told, other, options.compare))
                    add(told, MapPredictor::other_level, &other);
            }
            add(told, MapPredictor::exposure, nullptr);
        }
        parallel_for(static_cast<int>(predictions.size()), [&](int i) {
            reckon_prediction(predictions[static_cast<std::size_t>(i)], *own, options.seed);
        });
        for (Prediction& prediction : predictions) {
            finish_row(prediction, options);
            rows.push_back(std::move(prediction.row));
        }
    }
    std::stable_sort(rows.begin(), rows.end(), [](const MapPredictionRow& a, const MapPredictionRow& b) {
        return std::tie(a.group, a.object) < std::tie(b.group, b.object);
    });
    return rows;
}

} // namespace overt
