/// The keys by which a simulated observer answers: what is answered comes of the protocol's planted truth.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiment/base/random.h"
#include "experiment/factors.h"
#include "experiment/ports/answer_offer.h"
#include "experiment/ports/observer_input.h"
#include "experiment/protocol/protocol.h"

namespace overt {

/// The truth behind simulated answers, by `simulated` of [[task.answer]] (AnswerTruth). A function of the
/// seed, the trial and the answer.
class SimulatedAnswers {
  public:
    /// The protocol must outlive this.
    SimulatedAnswers(const Protocol& protocol, std::uint64_t seed);

    struct Intended {
        bool is_missing = false, is_early = false, is_late = false;
        SessionDuration after{};           ///< the window opened
        int choice = 0;                    ///< index into the offer's values
        std::optional<double> number = {}; ///< of scales and numbers
        /// Of a point, from the middle of the screen: normally distributed about the middle of the first
        /// image that is shown, with an eighth of its height for standard deviation.
        double right_px = 0.0, down_px = 0.0;
    };
    Intended answer(const AnswerOffer& offer, const Trial& trial) const;

  private:
    std::optional<double> level(const Trial& trial, const Stimulus& stimulus, std::string_view factor) const;
    int choose(const AnswerOffer& offer, const Trial& trial, const AnswerTruth& truth,
               RandomStream& random) const;
    std::optional<double> judge(const AnswerOffer& offer, const Trial& trial, const AnswerTruth& truth,
                                RandomStream& random) const;

    const Protocol& protocol_;
    Factors factors_;
    std::uint64_t seed_;
};

/// Presses planned in advance, that come when their time has come. next() and window_opened() allocate and
/// throw nothing.
class SimulatedKeys {
  public:
    void clear() noexcept;
    /// Presses for these offers in turn; they come after the window has opened.
    void plan(const SimulatedAnswers& answers, const std::vector<AnswerOffer>& offers, const Trial& trial);
    /// From now on inputs are told: of presses before the window.
    void awaited(SessionTime since) noexcept { awaited_ = since; }
    void window_opened(SessionTime at) noexcept { opened_ = at; }
    std::optional<ObserverInput> next(SessionTime now) noexcept;

  private:
    struct PlannedInput {
        ObserverInput input;
        SessionDuration after{}; ///< the window opened, or inputs were awaited
    };
    void press(std::vector<PlannedInput>& to, std::string_view key, SessionDuration after);
    void point_at(double right_px, double down_px, SessionDuration after);
    void move_to(const AnswerOffer& offer, double number, SessionDuration& after);
    void type(const std::string& text, SessionDuration& after);

    std::vector<PlannedInput> early_, planned_;
    std::size_t next_early_ = 0, next_ = 0;
    std::optional<SessionTime> awaited_, opened_;
};

} // namespace overt
