/// Studies simulated by what is answered: without pictures, gaze and sessions.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "experiment/power/power_effect.h"
#include "experiment/power/power_results.h"
#include "experiment/protocol/protocol.h"
#include "experiment/statistics/permutation.h"
#include "experiment/study/answers/answer_differences.h"

namespace overt {

/// Observers, schedules, levels that procedures choose, and answers are those of simulated sessions
/// (ScheduleMaker, ProcedureTrials, SimulatedAnswers); measures and tests are those of the table
/// answer_differences. The protocol's own simulated effects are left out: only the effect holds.
///
/// Constant after it was made, and may be used by several threads.
class AnswerStudies {
  public:
    /// Of an effect on answers (is_of_answers). `protocol` must outlive this.
    AnswerStudies(const Protocol& protocol, const PowerEffect& effect);

    /// By observer 1 … `observers`: what each answered to the effect's answer, in its task and in trials that
    /// the effect is confined to.
    std::vector<std::vector<StudyAnswer>> study(std::uint64_t seed, int observers) const;

    /// What is compared between the effect's levels.
    const MeasuredAnswer& measured() const { return measured_; }

    /// The test with the first observers of a study, by the numbers of them.
    std::vector<StudyOutcome> tested(const std::vector<std::vector<StudyAnswer>>& study,
                                     std::span<const int> observers, const PermutationSettings& settings,
                                     const std::optional<double>& equivalence = {}) const;

  private:
    Protocol planted_for(std::uint64_t observer_seed) const;
    std::vector<StudyAnswer> answers_of(const Protocol& planted, const Schedule& schedule,
                                        std::uint64_t seed) const;

    const Protocol& protocol_;
    PowerEffect effect_;
    MeasuredAnswer measured_;
    int task_ = 0;
};

/// The answer that an effect on answers is of.
const TaskAnswer& asked_answer(const Protocol& protocol, const PowerEffect& effect);

} // namespace overt
