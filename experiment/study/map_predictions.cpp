#include "experiment/study/map_predictions.h"

#include <algorithm>
#include <array>

#include "experiment/base/parallel.h"
#include "experiment/statistics/area_under_curve.h"
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

/// What one observer's fixations give.
struct Scores {
    static constexpr std::size_t count = 6;
    std::array<std::optional<double>, count> values; ///< KL, NSS, AUC-Judd, AUC-Borji, both gains
};

/// A map that predicts: on the surface, and at the fixations that are to be told.
struct PredictingMap {
    std::vector<double> density, at_fixations;
};

Scores scores_of(const ObserverMap& of, const PredictingMap& by, const FixationMaps& maps, bool is_exposure,
                 std::uint64_t seed) {
    const std::span<const double> areas = maps.visible_areas();
    const std::vector<double> even(areas.size(), 1.0), even_there(of.fixations.size(), 1.0),
        exposure_there = maps.exposure_at(of.fixations);
    const auto& [predicting, at_fixations] = by;
    Scores scores;
    scores.values = {kl_divergence(predicting, of.map, areas),
                     nss(predicting, areas, at_fixations),
                     auc_judd(predicting, areas, at_fixations),
                     auc_borji(predicting, areas, at_fixations, seed),
                     is_exposure
                         ? std::nullopt
                         : information_gain(predicting, maps.exposure(), areas, at_fixations, exposure_there),
                     information_gain(predicting, even, areas, at_fixations, even_there)};
    return scores;
}

/// The fixations of all observers but the one that is told, and the exposure as one more; empty if nobody
/// else has any.
PredictingMap predicting_map(const GroupMaps& from, const ObserverMap& told, const FixationMaps& maps) {
    PredictingMap map{from.sum, {}};
    Fixations predicting;
    for (const ObserverMap& one : from.observers) {
        if (one.observer != told.observer) {
            predicting.insert(predicting.end(), one.fixations.begin(), one.fixations.end());
            continue;
        }
        for (std::size_t v = 0; v < map.density.size(); ++v)
            map.density[v] = std::max(map.density[v] - one.map[v], 0.0);
    }
    if (predicting.empty())
        return {};
    map.at_fixations = maps.sum_at(predicting, told.fixations);
    const std::vector<double> exposure_there = maps.exposure_at(told.fixations);
    const double count = static_cast<double>(predicting.size() + 1);
    for (std::size_t v = 0; v < map.density.size(); ++v)
        map.density[v] = (map.density[v] + maps.exposure()[v]) / count;
    for (std::size_t i = 0; i < map.at_fixations.size(); ++i)
        map.at_fixations[i] = (map.at_fixations[i] + exposure_there[i]) / count;
    return map;
}

/// A row to be made, and the group whose fixations predict; null: the exposure.
struct Prediction {
    MapPredictionRow row;
    const GroupMaps* told;
    const GroupMaps* by;
    std::vector<Scores> scores;
};

void reckon_prediction(Prediction& of, const FixationMaps& maps, std::uint64_t seed) {
    for (const ObserverMap& observer : of.told->observers) {
        if (!of.by) {
            const PredictingMap exposure{{maps.exposure().begin(), maps.exposure().end()},
                                         maps.exposure_at(observer.fixations)};
            of.scores.push_back(scores_of(observer, exposure, maps, true, seed));
            continue;
        }
        const PredictingMap predicting = predicting_map(*of.by, observer, maps);
        if (!predicting.density.empty())
            of.scores.push_back(scores_of(observer, predicting, maps, false, seed));
    }
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
        &row.kl, &row.nss, &row.auc_judd, &row.auc_borji, &row.gain_over_exposure, &row.gain_over_area};
    for (std::size_t i = 0; i < estimates.size(); ++i) {
        std::vector<double> values;
        for (const Scores& scores : of.scores) {
            if (scores.values[i])
                values.push_back(*scores.values[i]);
        }
        const bool is_of_itself = !of.by && estimates[i] == &row.gain_over_exposure;
        *estimates[i] = estimated_mean(values, options.bootstrap(),
                                       is_of_itself ? "the exposure is the baseline itself" : absent);
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
            predictions.push_back({std::move(row), &told, from, {}});
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
