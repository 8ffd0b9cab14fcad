/// The keys by which a simulated observer answers.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "devices/simulated/simulated_answers.h"
#include "experiment/ports/observer_input.h"

namespace overt {

/// Presses planned in advance, that come when their time has come. next() and window_opened() allocate and
/// throw nothing.
class SimulatedKeys {
  public:
    /// Where the eye points, in pixels to the right of and below the middle of the screen: clicks on places
    /// go there. Without it they go to the middle. Must neither throw nor allocate.
    void let_gaze_guide(std::function<glm::dvec2(SessionTime)> gaze_px) { gaze_px_ = std::move(gaze_px); }
    /// A key that is down by then is let go nevertheless, when that was planned.
    void clear() noexcept;
    /// Presses for these offers in turn, in place of all others, as clear() has it; they come after the
    /// window has opened.
    void plan(const SimulatedAnswers& answers, const std::vector<AnswerOffer>& offers, const Trial& trial);
    /// From now on inputs are told: of presses before the window.
    void awaited(SessionTime since) noexcept { awaited_ = since; }
    void window_opened(SessionTime at) noexcept { opened_ = at; }
    std::optional<ObserverInput> next(SessionTime now) noexcept;

  private:
    struct PlannedInput {
        ObserverInput input;
        SessionDuration after{};   ///< the window opened, or inputs were awaited
        bool is_from_gaze = false; ///< its place counts from where the eye points then
    };
    void press(std::vector<PlannedInput>& to, std::string_view key, SessionDuration after);
    void lean(const AnswerOffer& offer, const Attitude& attitude, SessionDuration& after);
    void point_at(double right_px, double down_px, SessionDuration after);
    void move_to(const AnswerOffer& offer, double number, SessionDuration& after);
    void set(const AnswerOffer& offer, const std::vector<int>& at, SessionDuration& after);
    void type(const std::string& text, SessionDuration& after);

    /// Of a key or button that is down, as its input at its time.
    static std::optional<ObserverInput> release_due(const std::vector<PlannedInput>& from, std::size_t next,
                                                    const std::optional<SessionTime>& since) noexcept;

    std::vector<PlannedInput> early_, planned_;
    std::size_t next_early_ = 0, next_ = 0;
    std::function<glm::dvec2(SessionTime)> gaze_px_;
    std::optional<ObserverInput> release_;
    std::optional<SessionTime> awaited_, opened_;
};

} // namespace overt
