/// What a simulated observer answers by keys, by the protocol's planted truth.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "devices/simulated/gaze_plan.h"
#include "experiment/base/random.h"
#include "experiment/factors.h"
#include "experiment/ports/answer_offer.h"
#include "experiment/protocol/protocol.h"
#include "experiment/stimulus_lists.h"

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
        /// Of a point, by how much the pointer misses the place that is looked at: a normal number each, with
        /// a standard deviation of 4 pixels.
        double right_px = 0.0, down_px = 0.0;
        /// Of a gauge: gain x the surface's own rise in depth + shear + noise x normal, as AnswerTruth has
        /// them.
        std::optional<Attitude> attitude = {};
        std::vector<int> at = {}; ///< of a match: index of the value that is set, for each column
    };
    Intended answer(const AnswerOffer& offer, const Trial& trial) const;

    /// What answer() means on average over the noise of this observer's judgements.
    struct Expected {
        std::vector<double> shares;      ///< of choices: of each of the offer's values
        std::optional<double> mean = {}; ///< of scales and numbers
        double after_s = 0.0;            ///< the window opened, of those that are neither late nor missing
    };
    Expected expected(const AnswerOffer& offer, const Trial& trial) const;
    std::uint64_t seed() const { return seed_; }

    /// How the first of the task's choices that says so (AnswerTruth::look_share, look_area) has the observer
    /// look before it, where what is lit has a stimulus in each slot that can be chosen. `areas`: those that
    /// gaze is meant for.
    GazeFavour favour_of(const Trial& lit, const std::vector<std::string>& areas) const;

  private:
    /// What effects of the protocol, and the observer, add to a judgement of a stimulus.
    struct Leaning {
        double shift = 0.0, slope = 1.0, odds = 1.0;
    };
    Leaning leaning_to(const std::string& answer, const Trial& trial, const Stimulus& stimulus) const;
    std::optional<double> level(const Trial& trial, const Stimulus& stimulus, std::string_view factor) const;
    /// Of a stimulus, slope x level; nothing: its level is no number.
    std::optional<double> percept(const AnswerOffer& offer, const Trial& trial, const Stimulus& stimulus,
                                  const AnswerTruth& truth) const;
    /// How far the percepts of the two lie apart that a choice of this place means, where a trial is about
    /// differences; nothing where it means none.
    std::optional<double> difference_at(const AnswerOffer& offer, const Trial& trial, std::size_t place,
                                        const AnswerTruth& truth) const;
    /// What an observer adds to all judgements of an answer.
    double inclination(const AnswerOffer& offer, const AnswerTruth& truth) const;
    /// What can be chosen, as the protocol has it; the offer has it by keys.
    static std::vector<std::string> values_of(const AnswerOffer& offer, const TaskAnswer* settings);
    /// What a choice goes by, before noise.
    struct Judged {
        std::vector<double>
            slots; ///< of choices among slots: by value, in standard deviations of a difference
        bool is_odd_one_out = false; ///< of slots: which is farthest from the others, not the largest
        std::optional<double> words; ///< of words that go by a factor: from the middle one
        int right = -1;              ///< else: index of the value that is correct; -1: nobody knows
        double share_right = 1.0;
    };
    Judged judged(const AnswerOffer& offer, const std::vector<std::string>& values, const Trial& trial,
                  const AnswerTruth& truth) const;
    /// Index of the slot that is chosen, with noise drawn on each.
    static int chosen_slot(const Judged& judged, RandomStream& random);
    /// What is added to the response time, as AnswerTruth::time_gain_s has it.
    double more_time_s(const Trial& trial, const AnswerTruth& truth) const;
    double number_judged(const AnswerOffer& offer, const Trial& trial, const AnswerTruth& truth,
                         double noise) const;
    /// Index into `values`.
    int choose(const AnswerOffer& offer, const std::vector<std::string>& values, const Trial& trial,
               const AnswerTruth& truth, RandomStream& random) const;
    /// The values that are set to match: see AnswerTruth.
    std::vector<int> match(const AnswerOffer& offer, const Trial& trial, const AnswerTruth& truth,
                           RandomStream& random) const;
    std::optional<double> judge(const AnswerOffer& offer, const Trial& trial, const AnswerTruth& truth,
                                RandomStream& random) const;

    const Protocol& protocol_;
    Factors factors_;
    std::uint64_t seed_;
    /// By simulated effect of the protocol: for each list, whether it holds for each entry.
    std::vector<std::array<std::vector<bool>, stimulus_lists.size()>> effect_entries_;
};

/// What an observer is offered of an answer or an item, without keys: as SimulatedAnswers reads it. What can
/// be chosen stands as the protocol has it.
AnswerOffer offer_of(const Protocol& protocol, const TaskAnswer& answer, const std::string& item,
                     const Trial& trial);

} // namespace overt
