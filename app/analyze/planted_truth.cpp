#include "app/analyze/planted_truth.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "devices/simulated/gaze_plan.h"
#include "devices/simulated/gaze_script.h"
#include "devices/simulated/gaze_targets.h"
#include "experiment/base/parallel.h"
#include "experiment/base/random.h"
#include "experiment/scene/areas.h"
#include "experiment/statistics/point_spread.h"

namespace overt {

namespace {

template <class Entry> int number_of(const std::string& id, const std::vector<Entry>& entries) {
    const auto found = std::ranges::find(entries, id, [](const Entry& entry) { return entry.id; });
    return found == entries.end() ? -1 : static_cast<int>(found - entries.begin());
}

/// The truth of one trial after another.
class Plans {
  public:
    explicit Plans(const Experiment& experiment)
        : protocol_(&experiment.protocol),
          scene_(make_observed_scene(experiment.protocol, experiment.objects,
                                     screen_geometry_of(experiment.protocol))),
          turns_(turns_of(scene_)) {
        for (const ObservedObject& object : scene_.objects) {
            areas_.emplace_back();
            targets_.emplace_back();
            if (!object.mesh || object.mesh->triangles.empty())
                continue;
            areas_.back() = Areas(object.mesh->part_names);
            targets_.back() = std::make_unique<GazeTargets>(object, scene_);
        }
    }

    /// Whether gaze is meant for an area by itself.
    bool plans(const std::string& area) const { return area_in(scene_, area) >= 0; }

    /// Nothing if the protocol does not have the trial's task, object and material.
    std::optional<double> share(const StudyTrial& trial, const std::string& area, std::uint64_t seed) const {
        const std::optional<Known> known = known_of(trial);
        if (!known)
            return std::nullopt;
        const std::size_t object = scene_.index_of(known->shown);
        const std::optional<std::size_t> own = areas_[object].find(area);
        const GazePlan plan = gaze_plan(scene_, seed, known->task, known->shown.stimulus);
        double elsewhere = 1.0, spots = 0.0;
        for (int i = 0; i < plan.spot_count; ++i) {
            const GazePlan::Spot& spot = plan.spots[static_cast<std::size_t>(i)];
            elsewhere -= spot.share;
            if (own && targets_[object] &&
                areas_[object].holds(*own, targets_[object]->part_of_spot(spot.effect)))
                spots += spot.share;
        }
        return elsewhere * plan.shares[static_cast<std::size_t>(area_in(scene_, area))] + spots;
    }

    /// The places, in the object's coordinates, at which an observer means to look in presentations of a
    /// trial, as many as there are repeats; none if its object or its task is not known.
    std::vector<glm::dvec3> meant_places(const StudyTrial& trial, std::uint64_t seed, int repeats) const {
        std::vector<glm::dvec3> places;
        for (int repeat = 0; repeat < repeats; ++repeat) {
            const auto number = static_cast<std::uint64_t>(repeat);
            for (const SurfacePoint& place :
                 places_of_script(trial, seed, trial.number,
                                  RandomStream(seed, "meant places", number).next_bits(), planned_end(trial)))
                places.push_back(place.position);
        }
        return places;
    }

    /// Whether scripts follow from what a study tells of its trials: nothing that is answered guides gaze.
    bool has_scripts() const {
        return std::ranges::none_of(protocol_->tasks, [](const Task& task) {
            return std::ranges::any_of(task.answers, [](const TaskAnswer& answer) {
                return answer.truth.look_share || !answer.truth.look_area.empty();
            });
        });
    }

    /// The places, with their parts, at which the observer of this seed looked in the trial; none if its
    /// object or its task is not known. It is the trial's only presentation.
    std::vector<SurfacePoint> drawn_places(const StudyTrial& trial, std::uint64_t seed) const {
        return places_of_script(trial, seed, trial.number - 1, seed, from_seconds(trial.presentation_s));
    }

  private:
    /// Of the script that is drawn by `script_seed` and `number`, for a plan of the observer of `seed`.
    std::vector<SurfacePoint> places_of_script(const StudyTrial& trial, std::uint64_t seed, int number,
                                               std::uint64_t script_seed, SessionDuration end) const {
        std::vector<SurfacePoint> places;
        const std::optional<Known> known = known_of(trial);
        const GazeTargets* const targets = known ? targets_[scene_.index_of(known->shown)].get() : nullptr;
        if (!targets)
            return places;
        const Stimulus& stimulus = known->shown.stimulus;
        GazeScript script(scene_, observer_);
        script.compose(scene_, targets, turns_[static_cast<std::size_t>(stimulus.motion)], observer_,
                       script_seed, number, gaze_plan(scene_, seed, known->task, stimulus));
        // The first was under way at the onset.
        for (const ScriptedFixation& fixation : script.fixations())
            if (fixation.target && fixation.begin > SessionDuration{} && fixation.begin < end)
                places.push_back(*fixation.target);
        return places;
    }

    SessionDuration planned_end(const StudyTrial& trial) const {
        const std::optional<Known> known = known_of(trial);
        return known ? from_seconds(scene_.animation_of(known->shown.stimulus.motion).duration_s)
                     : SessionDuration{};
    }

    struct Known {
        int task = 0;
        PlacedStimulus shown;
    };
    std::optional<Known> known_of(const StudyTrial& trial) const {
        Known known{number_of(trial.key("task"), protocol_->tasks), {}};
        for (std::size_t list = 0; list < stimulus_lists.size(); ++list) {
            const std::vector<std::string_view> ids = ids_in_list(*protocol_, list);
            const std::string& id = trial.key(std::string(stimulus_lists[list].name));
            const auto found = std::ranges::find(ids, id);
            // Trials have no column of a list with one entry only, unless it is always named.
            if (found == ids.end() && (ids.size() > 1 || id != no_level))
                return std::nullopt;
            if (found != ids.end())
                known.shown.stimulus.*stimulus_lists[list].index = static_cast<int>(found - ids.begin());
        }
        known.shown.slot = std::max(0, number_of(trial.key("slot"), protocol_->slots));
        return known.task < 0 ? std::nullopt : std::optional(known);
    }

    const Protocol* protocol_;
    ObservedScene scene_;
    std::vector<PursuedTurn> turns_; ///< by motion
    ObserverSettings observer_;
    std::vector<std::unique_ptr<GazeTargets>> targets_; ///< as the scene has objects; null without a mesh
    std::vector<Areas> areas_;                          ///< likewise
};

bool is_of(const StudyTrial& trial, const std::vector<StudyKey>& keys) {
    return std::ranges::all_of(keys, [&](const StudyKey& key) { return trial.key(key.column) == key.value; });
}

/// Of a trial: what its observer's fixations scatter by is stable to about a percent.
constexpr int repeats = 20;

void add_planted_spreads(StudyResults& results, const Plans& plans, const ObserverSeeds& seeds) {
    std::vector<std::vector<glm::dvec3>> places(results.trials.size());
    parallel_for(static_cast<int>(places.size()), [&](int t) {
        const StudyTrial& trial = results.trials[static_cast<std::size_t>(t)];
        const auto seed = seeds.find(trial.key("observer"));
        if (!trial.excluded && seed != seeds.end())
            places[static_cast<std::size_t>(t)] = plans.meant_places(trial, seed->second, repeats);
    });
    for (DistributionRow& row : results.distributions) {
        const auto& mm = results.objects[static_cast<std::size_t>(row.object)].mm_per_unit;
        std::vector<glm::dvec3> all;
        for (const int t : results.groups[static_cast<std::size_t>(row.group)].trials)
            if (results.trials[static_cast<std::size_t>(t)].object == row.object)
                all.insert(all.end(), places[static_cast<std::size_t>(t)].begin(),
                           places[static_cast<std::size_t>(t)].end());
        if (const std::optional<PointSpread> spread = point_spread(all); spread && mm)
            row.planted_wss_mm2 = spread->wss() * *mm * *mm;
    }
}

/// Sets AreaRow::drawn. Each trial shows one thing.
void add_drawn_shares(StudyResults& results, const Plans& plans, const ObserverSeeds& seeds) {
    std::vector<std::vector<SurfacePoint>> places(results.trials.size());
    parallel_for(static_cast<int>(places.size()), [&](int t) {
        const StudyTrial& trial = results.trials[static_cast<std::size_t>(t)];
        const auto seed = seeds.find(trial.key("observer"));
        if (!trial.excluded && seed != seeds.end())
            places[static_cast<std::size_t>(t)] = plans.drawn_places(trial, seed->second);
    });
    for (AreaRow& row : results.area_rows) {
        if (!row.planted)
            continue;
        struct Count {
            double inside = 0.0, all = 0.0;
        };
        std::map<std::string, Count> observers;
        for (std::size_t t = 0; t < places.size(); ++t) {
            const StudyTrial& trial = results.trials[t];
            const Areas& areas = results.objects[static_cast<std::size_t>(trial.object)].areas;
            const std::optional<std::size_t> area = areas.find(row.area);
            if (trial.excluded || !area || !is_of(trial, row.keys))
                continue;
            Count& count = observers[trial.key("observer")];
            for (const SurfacePoint& place : places[t]) {
                count.inside += areas.holds(*area, place.part);
                count.all += 1.0;
            }
        }
        std::erase_if(observers, [](const auto& one) { return one.second.all == 0.0; });
        double sum = 0.0;
        for (const auto& [label, count] : observers)
            sum += count.inside / count.all;
        if (!observers.empty())
            row.drawn = sum / static_cast<double>(observers.size());
    }
}

/// Whether no trial has more than one presentation.
bool shows_one_thing(const StudyResults& results) {
    std::set<std::pair<int, int>> seen;
    return std::ranges::all_of(results.trials, [&](const StudyTrial& trial) {
        return seen.emplace(trial.session, trial.number).second;
    });
}

} // namespace

void add_planted_truth(StudyResults& results, const Experiment& experiment, const ObserverSeeds& seeds) {
    const Plans plans(experiment);
    add_planted_spreads(results, plans, seeds);
    for (AreaRow& row : results.area_rows) {
        if (!plans.plans(row.area))
            continue;
        struct Mean {
            double sum = 0.0;
            int count = 0;
        };
        std::map<std::string, Mean> observers;
        bool is_known = true;
        for (const StudyTrial& trial : results.trials) {
            const StudyObject& object = results.objects[static_cast<std::size_t>(trial.object)];
            if (trial.excluded || !is_of(trial, row.keys) || !object.areas.has(row.area))
                continue;
            const std::string& label = trial.key("observer");
            const auto seed = seeds.find(label);
            const auto share =
                seed == seeds.end() ? std::nullopt : plans.share(trial, row.area, seed->second);
            is_known = is_known && share;
            if (!share)
                break;
            observers[label].sum += *share;
            ++observers[label].count;
        }
        if (!is_known || observers.empty())
            continue;
        double sum = 0.0;
        for (const auto& [label, mean] : observers)
            sum += mean.sum / mean.count;
        row.planted = sum / static_cast<double>(observers.size());
    }
    if (plans.has_scripts() && shows_one_thing(results))
        add_drawn_shares(results, plans, seeds);
}

} // namespace overt
