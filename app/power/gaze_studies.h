/// Studies simulated at gaze level: which places of the surface observers fixate, without pictures and
/// sessions.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "app/inputs/protocol_inputs.h"
#include "devices/simulated/gaze_script.h"
#include "devices/simulated/gaze_targets.h"
#include "devices/simulated/observed_scene.h"
#include "experiment/power/power_effect.h"
#include "experiment/study/read/study_reader.h"
#include "experiment/study/results/study_options.h"

namespace overt {

/// What besides the effects decides where gaze is found.
struct GazeStudySettings {
    double head_share_sd = 0.0; ///< see SimulatedObservers
    double accuracy_deg = 0.3;  ///< standard deviation along each axis of a trial's constant error
    KernelWidth sigma;          ///< of maps
};

/// The settings that the protocol has.
GazeStudySettings gaze_study_settings(const Protocol& protocol);

/// Observers, schedules, plans and scripts of gaze are those of simulated sessions (ScheduleMaker,
/// gaze_plan, GazeScript). Each fixation is one measurement, halfway through it: what of the surface lies
/// under the gaze with the trial's constant error, in the object's angle at that time, or within the mean
/// error of a validation. The noise of samples and the detection of fixations are left out.
///
/// Constant after it was made, and may be used by several threads.
class GazeStudies {
  public:
    /// `experiment` must outlive this. The protocol's own simulated effects are left out: only `effects`
    /// hold. Where levels of `task` are compared, areas are as attractive in one as in the other but for the
    /// effect; where the effect of the task is tested (PowerTest::factor), in all. Effects on WSS need
    /// plant_spread() besides. Throws InputError if an object has no mesh.
    GazeStudies(const Experiment& experiment, std::vector<PowerEffect> effects,
                const GazeStudySettings& settings);

    /// What a GazePlan::spread has to be for an effect on WSS; `of_log` is how much it has to change with the
    /// logarithm of the ratio.
    void plant_spread(std::size_t effect, double spread, double of_log);

    /// Sessions, trials and fixations of observers 1 … `observers`, as read_study() gives them: a function of
    /// the seed; of several slots, each is a trial. `wanted`: only those for which it is true of the trial
    /// with this stimulus alone, each as it would be among all.
    StudyResults study(std::uint64_t seed, int observers,
                       const std::function<bool(const Trial&)>& wanted = {}) const;

    /// By object in a view, only the scale.
    const std::vector<ObjectSurface>& surfaces() const { return surfaces_; }
    /// Objects with their scale, without trials.
    const StudyResults& frame() const { return frame_; }
    const LevelLists& levels() const { return levels_; }
    const std::vector<PowerEffect>& effects() const { return effects_; }
    /// What observers look at, without their own inclinations.
    const ObservedScene& scene() const { return scene_; }
    /// Whether an effect is planted in a trial.
    bool holds_in(std::size_t effect, const Trial& trial) const {
        return scene_.effects[effect].holds_in(trial.task, trial.stimulus);
    }

  private:
    ObservedScene scene_of(std::uint64_t observer_seed) const;
    /// A show of a trial: what it lights, and what the observer does meanwhile.
    struct LookedAt {
        std::vector<int> places;                 ///< of Trial::shown
        SessionDuration onset{}, end{};          ///< since the trial's first
        std::vector<ObservedPresentation> shown; ///< by index of `places`
        std::vector<ScriptedFixation> fixations;
    };
    std::vector<LookedAt> shows_of(const Trial& trial, std::uint64_t seed, const ObservedScene& planned,
                                   GazeScript& script) const;
    /// The presentation of what the trial shows in one place, as the analysis of a session has it.
    void add_presentation(const Trial& trial, int place, std::uint64_t seed,
                          const std::vector<LookedAt>& shows, StudyResults& results) const;
    StudyFixation fixation_at(const ObservedPresentation& on, std::size_t object, ScreenPoint gaze,
                              const ObjectPose& angle) const;
    std::optional<SurfacePoint> surface_near(const GazeTargets& targets, const ScreenGeometry& screen,
                                             glm::dvec2 image, const ObjectPose& angle) const;

    const Experiment& experiment_;
    Factors factors_;
    std::vector<PowerEffect> effects_;
    GazeStudySettings settings_;
    ObserverSettings observer_;
    ObservedScene scene_;
    std::vector<PursuedTurn> turns_;    ///< by motion
    std::vector<double> spread_of_log_; ///< by effect
    std::vector<std::unique_ptr<GazeTargets>> targets_;
    std::vector<ObjectSurface> surfaces_;
    StudyResults frame_;
    LevelLists levels_;
};

} // namespace overt
