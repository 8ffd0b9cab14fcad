#include "experiment/study/map_predictions.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <numeric>
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

/// A model's map on one object, as probable gaze.
struct ModelDensity {
    std::string name;
    std::vector<double> by_node;
    std::vector<double> density; ///< by sample; its integral over what is visible is 1
};

/// Of so small a share a model's prediction is the exposure: where a model has 0, a fixation would cost 50
/// bits.
constexpr double exposure_in_models = 0.01;

/// The model by itself, and times the exposure: gaze cannot go where nothing is seen.
std::vector<ModelDensity> densities_of(const ModelMap& model, const FixationMaps& maps) {
    std::vector<ModelDensity> found;
    const std::vector<double> at_samples = maps.at_samples(model.by_node);
    for (const bool is_exposed : {false, true}) {
        ModelDensity one{model.name + (is_exposed ? " x exposure" : ""), model.by_node, at_samples};
        for (std::size_t i = 0; is_exposed && i < one.density.size(); ++i)
            one.density[i] *= maps.exposure()[i];
        const double all = integral(one.density, maps.visible_areas());
        if (!(all > 0.0))
            continue;
        for (double& value : one.by_node)
            value /= all;
        for (std::size_t i = 0; i < one.density.size(); ++i)
            one.density[i] =
                (1.0 - exposure_in_models) * one.density[i] / all + exposure_in_models * maps.exposure()[i];
        found.push_back(std::move(one));
    }
    return found;
}

PredictingMap predicting_map(const ModelDensity& model, bool is_exposed, const Fixations& fixations,
                             const FixationMaps& maps) {
    PredictingMap map{model.density, maps.at_places(model.by_node, fixations)};
    const std::vector<double> exposure = maps.exposure_at(fixations);
    for (std::size_t i = 0; i < exposure.size(); ++i)
        map.at_fixations[i] =
            (1.0 - exposure_in_models) * map.at_fixations[i] * (is_exposed ? exposure[i] : 1.0) +
            exposure_in_models * exposure[i];
    return map;
}

/// A row to be made, and the group whose fixations predict; null: the exposure, or a model.
struct Prediction {
    MapPredictionRow row;
    const GroupMaps* told;
    const GroupMaps* by;
    const ModelDensity* model; ///< that predicts; null: none
    std::vector<Scores> scores;
    std::vector<std::string> observers; ///< whose scores these are
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
        else if (of.model)
            predicting =
                predicting_map(*of.model, of.model->name.ends_with(" x exposure"), observer.fixations, maps);
        else
            predicting.at_fixations = maps.exposure_at(observer.fixations);
        if (predicting.density.empty())
            continue;
        of.observers.push_back(observer.observer);
        of.scores.push_back(scores_of(observer, predicting, maps, !of.by && !of.model));
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
        const bool is_of_itself = !of.by && !of.model && estimates[i] == &row.gain_over_exposure;
        *estimates[i] = estimated_mean(values, options.bootstrap(),
                                       is_of_itself ? "the exposure is the baseline itself" : absent);
        if (of.by && i < Scores::without_sorting && estimates[i]->value)
            estimates[i]->interval = interval_of(of, i, *estimates[i]->value, options.confidence);
    }
}

/// The gain over even gaze as a share of that of the other observers' map: of the observers who have both.
void add_share_of_ceiling(Prediction& of, const Prediction& ceiling, const StudyOptions& options) {
    constexpr std::size_t gain_over_area = 3;
    std::vector<std::pair<double, double>> gains; ///< of this, and of the ceiling
    for (std::size_t i = 0; i < of.scores.size(); ++i) {
        const auto found = std::ranges::find(ceiling.observers, of.observers[i]);
        if (found == ceiling.observers.end())
            continue;
        const auto& own = of.scores[i].values[gain_over_area];
        const auto& most = ceiling.scores[static_cast<std::size_t>(found - ceiling.observers.begin())]
                               .values[gain_over_area];
        if (own && most)
            gains.emplace_back(*own, *most);
    }
    const StatisticOf share = [&](std::span<const std::uint32_t> chosen) -> std::optional<double> {
        double own = 0.0, most = 0.0;
        for (const std::uint32_t i : chosen) {
            own += gains[i].first;
            most += gains[i].second;
        }
        return most > 0.0 ? std::optional(own / most) : std::nullopt;
    };
    std::vector<std::uint32_t> all(gains.size());
    std::iota(all.begin(), all.end(), 0u);
    const std::optional<double> value = gains.empty() ? std::nullopt : share(all);
    if (!value) {
        of.row.share_of_ceiling = Estimate::none("other observers' maps tell no more than even gaze");
        return;
    }
    of.row.share_of_ceiling = Estimate::of(*value);
    if (&of != &ceiling)
        of.row.share_of_ceiling.interval =
            bootstrap_interval(static_cast<std::uint32_t>(gains.size()), share, options.bootstrap());
}

} // namespace

std::vector<MapPredictionRow> map_predictions(const StudyResults& results, const ObjectFixationMaps& maps,
                                              const StudyOptions& options,
                                              const std::vector<ModelMap>& models) {
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
        std::vector<ModelDensity> densities;
        for (const ModelMap& model : models) {
            if (model.object == object)
                std::ranges::move(densities_of(model, *own), std::back_inserter(densities));
        }
        std::vector<Prediction> predictions;
        const auto add = [&](const GroupMaps& told, MapPredictor by, const GroupMaps* from,
                             const ModelDensity* model = nullptr) {
            MapPredictionRow row;
            row.group = told.group;
            row.object = object;
            row.by = by;
            row.level = from ? from->level : model ? model->name : "";
            predictions.push_back({std::move(row), &told, from, model, {}, {}, {}});
        };
        for (const GroupMaps& told : groups) {
            add(told, MapPredictor::same_level, &told);
            for (const GroupMaps& other : groups) {
                if (differ_in_level_alone(results, told, other, options.compare))
                    add(told, MapPredictor::other_level, &other);
            }
            add(told, MapPredictor::exposure, nullptr);
            for (const ModelDensity& model : densities)
                add(told, MapPredictor::model, nullptr, &model);
        }
        parallel_for(static_cast<int>(predictions.size()), [&](int i) {
            reckon_prediction(predictions[static_cast<std::size_t>(i)], *own, options.seed);
        });
        std::size_t ceiling = 0; // of each group it comes first
        for (std::size_t i = 0; i < predictions.size(); ++i) {
            if (predictions[i].row.by == MapPredictor::same_level)
                ceiling = i;
            finish_row(predictions[i], options);
            add_share_of_ceiling(predictions[i], predictions[ceiling], options);
        }
        for (Prediction& prediction : predictions)
            rows.push_back(std::move(prediction.row));
    }
    std::stable_sort(rows.begin(), rows.end(), [](const MapPredictionRow& a, const MapPredictionRow& b) {
        return std::tie(a.group, a.object) < std::tie(b.group, b.object);
    });
    return rows;
}

} // namespace overt
