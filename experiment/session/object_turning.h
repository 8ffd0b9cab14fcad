/// Objects that the observer turns: inputs go in, the pose that each shows comes out.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "experiment/ports/given_answer.h"
#include "experiment/ports/observer_input.h"
#include "experiment/ports/turning_offer.h"
#include "experiment/protocol/protocol.h"
#include "experiment/trial.h"

namespace overt {

/// Of one attempt at a trial. An object stands as it was left from one show to the next. Held keys turn it by
/// their speed from the very time of the press to that of the release, drags by their way; the pose is the
/// nearest one. One thread; take(), go_to() and pose_of() allocate and throw nothing.
class ObjectTurning {
  public:
    /// What of the trial is in a motion of kind "observer"; the protocol must outlive the trial. Poses that
    /// are drawn come of streams by seed, trial and place: each attempt has the same.
    void begin_trial(const Protocol& protocol, const Trial& trial, std::uint64_t seed, bool is_practice);

    /// A show of these places begins, and what can be turned of them can be from now on: nothing is held.
    void begin_show(const std::vector<int>& places);
    void end_show() noexcept;
    /// Something can be turned now.
    bool is_active() const noexcept;
    /// The mouse turns something, so that its pointer has to be seen.
    bool shows_pointer() const noexcept;
    /// For observers who do not see the screen, one for each that can be turned now, and with keys one for
    /// its elevation.
    std::vector<TurningOffer> offers(int show, SessionTime since, double lasts_s) const;

    /// Whether the input turned something, or began or ended it: then it is nobody else's.
    bool take(const ObserverInput& input) noexcept;
    /// Turns what held keys turn up to this time.
    void go_to(SessionTime now) noexcept;

    struct Shown {
        AnimationFrameIndex frame;
        std::optional<SessionTime> input_at = {}; ///< of the latest input of this show that moved it
    };
    /// Nothing: the place is not turned by the observer.
    std::optional<Shown> pose_of(int place) const noexcept;

    /// All inputs that it took, with the motion's id for the answer's, the slot's for its item, and the angle
    /// after it, in degrees.
    void add_to(std::vector<AnswerInput>& inputs) const;
    int lost_inputs() const noexcept { return lost_inputs_; }

  private:
    struct Turned {
        const MotionSettings* motion = nullptr;
        int place = 0;
        std::string slot;
        // The image, in pixels from the middle of the screen.
        double left_px = 0.0, top_px = 0.0, width_px = 0.0, height_px = 0.0;
        glm::dvec2 at_deg{0.0}; ///< turn and elevation
        // Held keys turn it from there, since then.
        glm::dvec2 from_deg{0.0};
        SessionTime since{};
        bool is_lit = false;
        std::array<bool, 4> is_held{}; ///< of ObserverTurn::keys
        bool is_dragged = false;
        glm::dvec2 dragged_px{0.0}; ///< where the pointer was last
        std::optional<SessionTime> input_at = {};

        const ObserverTurn& by() const { return motion->by_observer; }
        bool by_keys() const { return by().with != TurnedWith::mouse; }
        bool by_mouse() const { return by().with != TurnedWith::keys; }
        bool is_at(double right_px, double down_px) const;
        double deg_per_px() const { return by().drag_deg / width_px; }
        glm::dvec2 within(glm::dvec2 deg) const noexcept;
        void let_go() noexcept;
        void go_to(SessionTime now) noexcept;
        void turn(glm::dvec2 by_deg, SessionTime at) noexcept;
    };
    struct Taken {
        ObserverInput input;
        std::size_t turned = 0;
        double angle_deg = 0.0;
    };
    bool take_key(Turned& turned, const ObserverInput& input) noexcept;
    bool take_pointer(Turned& turned, const ObserverInput& input) noexcept;
    void note(const ObserverInput& input, std::size_t turned) noexcept;

    std::vector<Turned> turned_;
    std::vector<Taken> taken_;
    int lost_inputs_ = 0;
};

} // namespace overt
