/// What an observer does during one presentation: where it looks, in which order, and for how long.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "devices/simulated/gaze_plan.h"
#include "devices/simulated/gaze_targets.h"
#include "devices/simulated/observed_scene.h"
#include "experiment/maps/surface_point.h"
#include "experiment/session_time.h"

namespace overt {

/// How long fixations last and how the eyes wander.
struct ObserverSettings {
    double fixation_median_s = 0.25;
    double fixation_log_sd = 0.45;
    double shortest_fixation_s = 0.08;
    double longest_fixation_s = 1.5;
    /// Its peak velocity of 62 deg/s (main_sequence.h) is twice what an EyeLink's parser asks of a saccade,
    /// so that noise and pursuit, which raise that threshold, rarely have two fixations taken for one.
    Degrees shortest_saccade{0.75};
    Degrees drift{0.03};   ///< standard deviation of the slow wandering along each axis
    Degrees tremor{0.002}; ///< standard deviation of the tremor along each axis
    double blinks_per_minute = 12.0;
};

/// The smooth turn that the eye pursues: the animation's steps joined by straight lines, so that halfway
/// through the time for which a frame is lit the eye is at that frame's angle. Between two such instants the
/// eye is at most half a step from what is lit. Where the observer turns the object, nobody knows how
/// beforehand: until it is seen, it stands as the motion's angle says.
class PursuedTurn {
  public:
    explicit PursuedTurn(const ObservedScene& scene, int motion = 0);

    int motion() const noexcept { return motion_; }

    /// `since_lit` counts from the instant at which the first frame's light reached the place looked at.
    ObjectPose angle_at(SessionDuration since_lit) const noexcept;

    /// The step lit then, 0 … steps-1; the first and the last stay.
    int step_at(SessionDuration since_lit) const noexcept;
    const ObjectPose& angle_of_step(int step) const noexcept {
        return angles_[static_cast<std::size_t>(step) % angles_.size()];
    }

  private:
    std::vector<ObjectPose> angles_; ///< of one period
    SessionDuration frame_period_;
    int steps_ = 0; ///< shown in one presentation
    int motion_ = 0;
    std::optional<int> only_step_; ///< of what has no plan: as it stands before it is shown
};

/// How an object was turned that the observer turns: the eye goes with what is lit.
class SeenTurn {
  public:
    virtual ~SeenTurn() = default;
    /// As PursuedTurn::angle_at().
    virtual ObjectPose angle_at(SessionDuration since_lit) const noexcept = 0;
};

/// Of all motions of a scene.
std::vector<PursuedTurn> turns_of(const ObservedScene& scene);

/// A stretch of time during which the eye stays with one place. Times count from the presentation's onset.
struct ScriptedFixation {
    SessionDuration begin{}, end{};
    std::optional<SurfacePoint> target; ///< what is pursued; nothing: `place` on the screen is looked at
    ScreenPoint place;
    SessionDuration light_delay{}; ///< from vertical blank to the light of the row looked at
    std::size_t shown = 0;         ///< what of the things shown the target is on
};

/// One of the things that a trial shows: what there is to look at, where, and how.
struct ObservedPresentation {
    const GazeTargets* targets = nullptr; ///< nullptr for an object without a mesh
    ScreenGeometry screen;                ///< with the image where it is shown
    GazePlan plan;
    const PursuedTurn* turn = nullptr; ///< with `targets`, never null
    const SeenTurn* seen = nullptr;    ///< of what has no plan: as it stands before it is shown; else null
    int slot = 0;                      ///< index into the protocol's
    double weight = 1.0;               ///< how often a fixation is on it, beside the others' weights
};

/// The fixations of one presentation in order; between the end of one and the begin of the next lies a
/// saccade. The first is at the middle of the screen, where the observer looked before the onset, and is not
/// chosen: in an analysis it drops out as begun before the onset.
class GazeScript {
  public:
    /// Sets aside room for the scene's longest presentation.
    GazeScript(const ObservedScene& scene, const ObserverSettings& settings);

    /// Writes the script of a trial: a function of its arguments alone. `targets` is nullptr for an object
    /// without a mesh. Allocates nothing; some thousand rays are cast.
    ///
    /// Each fixation goes where the plan says, by chance: to a spot, to an area or elsewhere, at a point
    /// that is visible in every frame lit from the saccade's start to the fixation's end, and at least the
    /// shortest saccade away or, if none of 200 is, the farthest of them. If 200 points of a spot are not
    /// visible, head or elsewhere is tried; if 200 of these, the other of the two, and at last the middle of
    /// the screen.
    void compose(const ObservedScene& scene, const GazeTargets* targets, const PursuedTurn& turn,
                 const ObserverSettings& settings, std::uint64_t seed, int trial,
                 const GazePlan& plan) noexcept {
        const ObservedPresentation only{targets, scene.screen, plan, &turn};
        compose(scene, {&only, 1}, settings, seed, trial);
    }
    /// The same of several things shown at once (one at least): each fixation is on one of them, as probable
    /// as its weight says.
    void compose(const ObservedScene& scene, std::span<const ObservedPresentation> shown,
                 const ObserverSettings& settings, std::uint64_t seed, int trial) noexcept;

    const std::vector<ScriptedFixation>& fixations() const { return fixations_; }

    /// Index of the fixation under way or just left at a time since onset.
    std::size_t fixation_at(SessionDuration since_onset) const noexcept;

  private:
    std::vector<ScriptedFixation> fixations_;
    SessionDuration horizon_; ///< the script goes on a while after the presentation's planned end
};

/// By which number GazeScript::compose() draws the script of a trial's show, from 0: each is looked at anew.
int script_number(int trial, int show);

/// How much farther to the right than place_of() the other eye has the target of a fixation.
double other_eye_right_px(const ScriptedFixation& fixation, SessionDuration since_onset,
                          std::span<const ObservedPresentation> shown) noexcept;

/// Where a fixation's target is on the screen, as the eye pursues it.
ScreenPoint place_of(const ScriptedFixation& fixation, SessionDuration since_onset,
                     std::span<const ObservedPresentation> shown) noexcept;
/// The same of the only thing shown.
ScreenPoint place_of(const ScriptedFixation& fixation, SessionDuration since_onset,
                     const ObservedScene& scene, const GazeTargets* targets,
                     const PursuedTurn& turn) noexcept;

} // namespace overt
