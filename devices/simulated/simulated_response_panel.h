/// The key and the voice of a simulated observer, and the keys of a simulated operator.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "devices/simulated/operator_script.h"
#include "devices/simulated/simulated_keys.h"
#include "devices/simulated/simulated_observer.h"
#include "devices/simulated/simulated_turns.h"
#include "experiment/ports/clock.h"
#include "experiment/ports/pressed_on.h"
#include "experiment/ports/response_panel.h"
#include "experiment/ports/session_phase.h"

namespace overt {

/// Presses the key "next" when the observer has read or answered, and again each second for as long as that
/// has no effect (a protocol may set a least time). Agrees to take part. A pause ends when it has lasted five
/// seconds.
class SimulatedResponsePanel final : public ResponsePanel {
  public:
    /// Clock and observer must outlive this. `answers`: what is answered by keys, which must outlive it, too;
    /// null: nothing.
    SimulatedResponsePanel(const Clock& clock, const SimulatedObserver& observer,
                           const std::vector<ScriptedOperatorKey>& script = {},
                           const SimulatedAnswers* answers = nullptr);

    void await(Awaited what, SessionTime since, const Trial* trial) override;
    std::optional<ResponsePress> poll() noexcept override;
    void offer(const std::vector<AnswerOffer>& answers) override;
    void offer_turning(const TurningOffer& turning) override;
    void window_opened(SessionTime at) noexcept override { keys_.window_opened(at); }
    /// What the script has the observer do, at its own times; else what the planted truth has it press.
    std::optional<ObserverInput> next_input() noexcept override;
    std::string answer() override { return answer_; }
    void entered(SessionPhase phase, int trial) noexcept override;

    /// Records what the observer pressed.
    void write_down(SessionLog& log) override;
    /// Names the keys of the script for which the session had no moment.
    std::vector<std::string> closing_warnings() const override;

  private:
    struct Operator {
        ScriptedOperatorKey scripted;
        std::optional<SessionTime> due = {}; ///< nothing: its phase has not come yet
        bool is_done = false;
        bool is_answering = false; ///< its inputs are told when their times come
        std::size_t inputs_told = 0;
    };
    /// A key of the observer's, to be recorded.
    struct Noted {
        SessionTime at;
        SessionPhase screen = SessionPhase::trial;
        int trial = -1;
        const ScriptedOperatorKey* scripted = nullptr; ///< null: the usual one
        bool goes_on = true;
    };
    /// Of the script: an operator's, or one of the observer's that goes on.
    std::optional<ResponsePress> scripted_press() noexcept;
    void note(SessionTime at, const ScriptedOperatorKey* scripted, bool goes_on) noexcept;

    const Clock* clock_;
    const SimulatedObserver* observer_;
    const SimulatedAnswers* answers_;
    SimulatedKeys keys_;
    SimulatedTurns turns_;
    std::vector<AnswerOffer> offers_;
    const Trial* asked_in_ = nullptr;
    std::vector<Operator> operators_;
    int texts_read_ = 0;
    std::optional<SessionTime> next_press_;
    ResponsePress pressed_with_;               ///< what next_press_ is
    std::optional<SessionTime> resumes_at_;    ///< the operator's pause
    std::optional<char32_t> operators_answer_; ///< to the question that a scripted key leads to
    int furthest_trial_ = -1;
    int own_decisions_ = 0; ///< since its begin, to questions that no scripted key led to
    std::string answer_;
    PressedOn pressed_on_;
    Awaited awaited_ = Awaited::key;
    std::array<Noted, 64> noted_{}; ///< with room for those of a presentation
    std::size_t noted_count_ = 0;
};

} // namespace overt
