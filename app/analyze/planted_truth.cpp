#include "app/analyze/planted_truth.h"

#include <algorithm>
#include <memory>
#include <optional>

#include "devices/simulated/gaze_plan.h"
#include "devices/simulated/gaze_targets.h"

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
          scene_(make_observed_scene(experiment.protocol, experiment.sculptures,
                                     screen_geometry_of(experiment.protocol))) {
        for (const ObservedSculpture& sculpture : scene_.sculptures) {
            spot_on_head_.emplace_back(scene_.effects.size(), false);
            if (scene_.effects.empty() || !sculpture.mesh || sculpture.mesh->triangles.empty())
                continue;
            const GazeTargets targets(sculpture, scene_);
            for (std::size_t effect = 0; effect < scene_.effects.size(); ++effect)
                spot_on_head_.back()[effect] =
                    sculpture.mesh->part_names[targets.part_of_spot(static_cast<int>(effect))] == "head";
        }
    }

    /// Nothing if the protocol does not have the trial's task, sculpture and material.
    std::optional<double> head_share(const StudyTrial& trial, std::uint64_t seed) const {
        const int task = number_of(trial.key("task"), protocol_->tasks);
        const Condition condition{number_of(trial.key("sculpture"), protocol_->sculptures),
                                  number_of(trial.key("material"), protocol_->materials)};
        if (task < 0 || condition.sculpture < 0 || condition.material < 0)
            return std::nullopt;
        const GazePlan plan = gaze_plan(scene_, seed, task, condition);
        double share = plan.head_share, elsewhere = 1.0, spots = 0.0;
        for (int i = 0; i < plan.spot_count; ++i) {
            const GazePlan::Spot& spot = plan.spots[static_cast<std::size_t>(i)];
            elsewhere -= spot.share;
            if (spot_on_head_[static_cast<std::size_t>(condition.sculpture)]
                             [static_cast<std::size_t>(spot.effect)])
                spots += spot.share;
        }
        share = elsewhere * share + spots;
        return share;
    }

  private:
    const Protocol* protocol_;
    ObservedScene scene_;
    std::vector<std::vector<bool>> spot_on_head_; ///< by sculpture and effect
};

bool is_of(const StudyTrial& trial, const std::vector<StudyKey>& keys) {
    return std::ranges::all_of(keys, [&](const StudyKey& key) { return trial.key(key.column) == key.value; });
}

} // namespace

void add_planted_truth(StudyResults& results, const Experiment& experiment, const ObserverSeeds& seeds) {
    const Plans plans(experiment);
    for (HeadFractionRow& row : results.head_fractions) {
        struct Mean {
            double sum = 0.0;
            int count = 0;
        };
        std::map<std::string, Mean> observers;
        bool is_known = true;
        for (const StudyTrial& trial : results.trials) {
            if (trial.excluded || !is_of(trial, row.keys))
                continue;
            const std::string& label = trial.key("observer");
            const auto seed = seeds.find(label);
            const auto share = seed == seeds.end() ? std::nullopt : plans.head_share(trial, seed->second);
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
}

} // namespace overt
