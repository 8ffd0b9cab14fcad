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
    std::size_t fixations = 0;
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
        made.fixations += own.size();
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

Scores scores_of(const ObserverMap& of, const std::vector<double>& predicting, const FixationMaps& maps,
                 bool is_exposure, std::uint64_t seed) {
    const std::span<const double> areas = maps.visible_areas();
    const std::vector<double> even(areas.size(), 1.0);
    std::vector<double> at_fixations, exposure_there, even_there(of.fixations.size(), 1.0);
    for (const StudyFixation* fixation : of.fixations) {
        at_fixations.push_back(maps.at(predicting, *fixation));
        exposure_there.push_back(maps.at(maps.exposure(), *fixation));
    }
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

/// The fixations of all but one observer, and the exposure as one more; empty if nobody else has any.
std::vector<double> predicting_map(const GroupMaps& from, const std::string& observer,
                                   const FixationMaps& maps) {
    std::vector<double> map = from.sum;
    std::size_t fixations = from.fixations;
    for (const ObserverMap& one : from.observers) {
        if (one.observer != observer)
            continue;
        fixations -= one.fixations.size();
        for (std::size_t v = 0; v < map.size(); ++v)
            map[v] = std::max(map[v] - one.map[v], 0.0);
    }
    if (fixations == 0)
        return {};
    for (std::size_t v = 0; v < map.size(); ++v)
        map[v] = (map[v] + maps.exposure()[v]) / static_cast<double>(fixations + 1);
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
            of.scores.push_back(
                scores_of(observer, {maps.exposure().begin(), maps.exposure().end()}, maps, true, seed));
            continue;
        }
        const std::vector<double> predicting = predicting_map(*of.by, observer.observer, maps);
        if (!predicting.empty())
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
