/// An observer with known eyes: sees the flips, looks at places of the object's surface, and can be asked
/// for the truth at any time.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "devices/simulated/eye_movements.h"
#include "devices/simulated/gaze_script.h"
#include "devices/simulated/gaze_targets.h"
#include "devices/simulated/observed_scene.h"
#include "experiment/maps/surface_point.h"
#include "experiment/ports/presentation_listener.h"
#include "experiment/ports/presenter.h"

namespace overt {

enum class EyeState : std::uint8_t { fixation, saccade, blink };

/// Where an eye points, and whether it is open.
struct TrueGaze {
    ScreenPoint place; ///< of the eye that is analysed
    EyeState state = EyeState::fixation;
    double other_eye_right_px =
        0.0; ///< how much farther to the right the other eye points, in its own picture
};

/// All that is known about an instant.
struct GazeTruth {
    TrueGaze gaze;
    std::optional<SurfacePoint> target; ///< what the fixation under way pursues
    /// Really lit then on the row looked at: of the thing that has the gaze in its image, else of the first.
    std::optional<AnimationFrameIndex> frame;
    std::optional<SurfacePoint> surface; ///< what is under the gaze in that frame, by ray casting
    std::optional<std::size_t> shown;    ///< which of the things that are lit has it in its image
    std::optional<int> slot;             ///< in which slot that is: index into the protocol's
};

/// What an observer answers, and how long after the question.
struct SimulatedAnswer {
    SessionDuration after{};                      ///< when the key is pressed
    SessionDuration voice_after{}, voice_until{}; ///< when it is spoken
    std::string text;
};

/// Deterministic: where it looks is a function of the seed, the trial and the onset; blinks and the eye's
/// small wandering are functions of the seed and the session time.
///
/// Three truths, which the settings drift = tremor = 0 bring together: the target is what the observer means
/// to look at; the gaze pursues it along the smooth turn (PursuedTurn), not along the steps in which it is
/// shown; the surface is what the frame lit at that instant has under the gaze. In the middle of the time for
/// which a frame is lit they are the same place, in between they differ by up to half a step of the turn. A
/// measurement is compared with `surface`, which is exact at every instant, missed refreshes included.
///
/// Used on the session's thread, also by the simulated devices. Between a presentation's first and last flip
/// nothing is allocated.
class SimulatedObserver final : public PresentationListener {
  public:
    /// Throws GraphicsError if an object's rays cannot be cast. The scene's meshes must outlive this.
    SimulatedObserver(ObservedScene scene, std::uint64_t seed, const ObserverSettings& settings = {});

    /// How each trial's answer changes where the observer looks before it; without, it does not. Told before
    /// the first presentation.
    void let_answers_guide(std::function<GazeFavour(const Trial& lit)> favour) {
        favour_ = std::move(favour);
    }

    /// Casts some thousand rays, which takes about a millisecond. Where a show follows another directly, room
    /// for it is made as well.
    void presentation_begins(const Trial& lit, int show) noexcept override;
    void flipped(const FlipRecord& flip) noexcept override;
    void slot_flipped(const SlotFlip& flip) noexcept override;
    /// Ends a presentation: 150 ms later the eye returns to the middle of the screen. Of a target, it goes
    /// there 200 ms after its onset, and stays until another screen is shown.
    void screen_shown(const Screen& screen, SessionTime onset) noexcept override;

    /// Where the eye points. A moment that the display has not yet come to is taken as if nothing changed.
    TrueGaze gaze_at(SessionTime time) const noexcept;
    GazeTruth truth_at(SessionTime time) const noexcept;

    /// When and what is answered: log-normal around some seconds, by the task's id.
    SimulatedAnswer answer_to(const Trial& trial) const;
    /// How long the `count`-th text is read before a key is pressed.
    SessionDuration reading_time(int count) const;

    const ObservedScene& scene() const { return scene_; }

    /// The fixations planned for a trial that was presented, or nullptr.
    const GazeScript* script_of(int trial) const;

  private:
    struct SeenFlip {
        SessionTime vertical_blank;
        AnimationFrameIndex frame;
    };
    struct Presentation;
    /// Of one of the things that a presentation shows, by its flips.
    struct FlippedTurn final : SeenTurn {
        const Presentation* of = nullptr;
        std::size_t shown = 0;
        const std::vector<ObjectPose>* angle_of_frame = nullptr;
        ObjectPose angle_at(SessionDuration since_lit) const noexcept override;
    };
    struct Presentation {
        Presentation(const ObservedScene& scene, const ObserverSettings& settings);
        int trial = -1;
        std::vector<ObservedPresentation> shown;
        std::vector<FlippedTurn> turned; ///< as `shown`; with room for all
        GazeScript script;
        std::vector<SeenFlip> flips;
        /// What the others of `shown` had at each of them, flip by flip.
        std::vector<AnimationFrameIndex> beside;
        AnimationFrameIndex frame_of(std::size_t of_shown, std::size_t flip) const;
        /// The last flip up to then, which is not before the onset.
        std::size_t flip_at(SessionTime blank) const;
        std::optional<SessionTime> end; ///< onset of the screen that followed
        SessionTime leaves;             ///< begin of the saccade back to the middle
        SessionTime back;
        ScreenPoint left_place;
        SessionTime onset() const { return flips.front().vertical_blank; }
    };
    struct Looking {
        ScreenPoint place;
        EyeState state = EyeState::fixation;
        const ScriptedFixation* fixation = nullptr;
        double other_eye_right_px = 0.0;
    };

    /// Where an eye without a presentation goes.
    struct Place {
        SessionTime since; ///< begin of the way there
        ScreenPoint from, to;
    };
    void look_at(ScreenPoint place, SessionTime onset);
    Looking resting(SessionTime time) const noexcept;
    void prepare_next();
    const Presentation* presentation_at(SessionTime time) const noexcept;
    Looking looking_at(const Presentation& presentation, SessionTime time) const noexcept;
    Looking scripted(const Presentation& presentation, SessionDuration since_onset) const noexcept;
    void plan_return(Presentation& presentation) const noexcept;
    /// Whose pictures are lit by the scan-out that began then; null: none.
    const Presentation* lit_by(SessionTime blank) const noexcept;

    ObservedScene scene_;
    std::uint64_t seed_;
    ObserverSettings settings_;
    std::function<GazeFavour(const Trial& lit)> favour_;
    /// A motion as it is seen.
    struct Motion {
        PursuedTurn turn;
        std::vector<ObjectPose> angle_of_frame;
    };
    std::vector<Motion> motions_;
    FixationalMotion wandering_;
    BlinkTrain blinks_;
    glm::dvec2 px_per_deg_;
    std::vector<std::unique_ptr<GazeTargets>> targets_; ///< as the scene has objects; nullptr without a mesh
    std::vector<std::unique_ptr<Presentation>> presentations_; ///< in order; the last ones still empty
    std::size_t begun_ = 0;                                    ///< presentations that have begun
    std::vector<Place> places_; ///< in order of their times; none: always in the middle
};

} // namespace overt
