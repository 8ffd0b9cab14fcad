#include "devices/simulated/simulated_answers.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "experiment/base/text_number.h"
#include "experiment/design/answer_forms.h"
#include "experiment/fits/attitude_regression.h"
#include "experiment/ports/given_answer.h"

namespace overt {

namespace {

/// A press that comes too late comes so long after the window closed.
constexpr double late_by_s = 0.15;

} // namespace

SimulatedAnswers::SimulatedAnswers(const Protocol& protocol, std::uint64_t seed)
    : protocol_(protocol), factors_(factors_of(protocol)), seed_(seed) {
    for (const SimulatedEffect& effect : protocol.simulated_effects)
        effect_entries_.push_back(chosen_by(protocol, effect));
}

SimulatedAnswers::Leaning SimulatedAnswers::leaning_to(const std::string& answer, const Trial& trial,
                                                       const Stimulus& stimulus) const {
    Leaning leaning;
    for (std::size_t i = 0; i < effect_entries_.size(); ++i) {
        const SimulatedEffect& effect = protocol_.simulated_effects[i];
        const std::string& task = protocol_.tasks[static_cast<std::size_t>(trial.task)].id;
        if (effect.answer != answer || (!effect.task.empty() && effect.task != task))
            continue;
        const auto holds = [&](const Stimulus& shown) {
            for (std::size_t list = 0; list < stimulus_lists.size(); ++list)
                if (!effect_entries_[i][list][static_cast<std::size_t>(shown.*stimulus_lists[list].index)])
                    return false;
            return true;
        };
        if (!holds(stimulus))
            continue;
        leaning.shift += effect.answer_shift;
        bool is_of_all = true;
        for (std::size_t place = 0; place < trial.shown_count(); ++place)
            is_of_all = is_of_all && holds(trial.shown(place).stimulus);
        if (is_of_all) {
            leaning.slope *= effect.answer_slope;
            leaning.odds *= effect.answer_odds;
        }
    }
    return leaning;
}

double SimulatedAnswers::inclination(const AnswerOffer& offer, const AnswerTruth& truth) const {
    return truth.observer_sd > 0.0
               ? truth.observer_sd *
                     RandomStream(seed_, fmt::format("inclination {} {}", offer.id, offer.item)).normal()
               : 0.0;
}

std::optional<double> SimulatedAnswers::level(const Trial& trial, const Stimulus& stimulus,
                                              std::string_view factor) const {
    if (const std::string_view own = own_level(trial, factor); !own.empty())
        return number_in<double>(own);
    const Factor* const found = factors_.find(factor);
    if (!found || found->source == Factor::Source::own || found->source == Factor::Source::stimulus)
        return std::nullopt;
    return found->levels[static_cast<std::size_t>(factors_.level_of(*found, trial, stimulus))].number;
}

std::optional<double> SimulatedAnswers::percept(const AnswerOffer& offer, const Trial& trial,
                                                const Stimulus& stimulus, const AnswerTruth& truth) const {
    const std::optional<double> here = level(trial, stimulus, truth.by);
    if (!here)
        return std::nullopt;
    const Leaning leaning = leaning_to(offer.id, trial, stimulus);
    return truth.slope * leaning.slope * *here + leaning.shift;
}

std::optional<double> SimulatedAnswers::difference_at(const AnswerOffer& offer, const Trial& trial,
                                                      std::size_t place, const AnswerTruth& truth) const {
    const std::size_t count = trial.shown_count();
    // Of three, the outer ones and the middle one; of four, the first two and the last two.
    if (count != 4 && (count != 3 || place == 1))
        return std::nullopt;
    const std::size_t other = count == 3 ? 1 : place ^ 1U;
    const auto one = percept(offer, trial, trial.shown(place).stimulus, truth);
    const auto two = percept(offer, trial, trial.shown(other).stimulus, truth);
    return one && two ? std::optional(std::abs(*one - *two)) : std::nullopt;
}

SimulatedAnswers::Judged SimulatedAnswers::judged(const AnswerOffer& offer,
                                                  const std::vector<std::string>& values, const Trial& trial,
                                                  const AnswerTruth& truth) const {
    // Among slots: the first as written in the protocol has the bias, wherever its key is.
    Judged judged;
    std::vector<double> slots(values.size(), 0.0);
    const std::optional<TrialRuleKind> rule =
        protocol_.tasks[static_cast<std::size_t>(trial.task)].trials.rule;
    const bool by_differences = rule && row_of(*rule).asks_for_differences;
    bool any_slot = false;
    for (std::size_t i = 0; i < trial.shown_count() && !truth.by.empty(); ++i) {
        const auto [stimulus, slot] = trial.shown(i);
        const auto at = std::ranges::find(values, protocol_.slots[static_cast<std::size_t>(slot)].id);
        const std::optional<double> here =
            by_differences ? difference_at(offer, trial, i, truth) : percept(offer, trial, stimulus, truth);
        if (at == values.end() || !here)
            continue;
        slots[static_cast<std::size_t>(at - values.begin())] = *here;
        any_slot = true;
    }
    const double bias = truth.bias + inclination(offer, truth);
    if (any_slot) {
        judged.is_odd_one_out = offer.kind == odd_one_out_kind;
        slots.front() += bias;
        judged.slots = std::move(slots);
        return judged;
    }
    const Leaning leaning = leaning_to(offer.id, trial, trial.stimulus);
    if (const auto here = truth.by.empty() ? std::nullopt : level(trial, trial.stimulus, truth.by)) {
        judged.words =
            truth.slope * leaning.slope * (*here - truth.offset.value_or(0.0)) + leaning.shift + bias;
        return judged;
    }
    const auto correct = std::ranges::find(values, offer.correct);
    if (correct != values.end())
        judged.right = static_cast<int>(correct - values.begin());
    const double odds = leaning.odds * truth.share_correct;
    judged.share_right = odds / (1.0 - truth.share_correct + odds);
    return judged;
}

int SimulatedAnswers::chosen_slot(const Judged& judged, RandomStream& random) {
    std::vector<double> seen = judged.slots;
    for (double& one : seen)
        one += random.normal() / std::numbers::sqrt2;
    if (judged.is_odd_one_out) {
        std::vector<double> apart(seen.size(), 0.0);
        for (std::size_t i = 0; i < seen.size(); ++i)
            for (const double other : seen)
                apart[i] += std::abs(seen[i] - other);
        seen = std::move(apart);
    }
    return static_cast<int>(std::ranges::max_element(seen) - seen.begin());
}

double SimulatedAnswers::more_time_s(const Trial& trial, const AnswerTruth& truth) const {
    const std::optional<double> here =
        truth.time_by.empty() ? std::nullopt : level(trial, trial.stimulus, truth.time_by);
    return here ? truth.time_gain_s * *here : 0.0;
}

int SimulatedAnswers::choose(const AnswerOffer& offer, const std::vector<std::string>& values,
                             const Trial& trial, const AnswerTruth& truth, RandomStream& random) const {
    const int count = static_cast<int>(values.size());
    const int by_chance = static_cast<int>(random.below(static_cast<std::uint32_t>(count)));
    if (random.uniform() < truth.lapses)
        return by_chance;
    const Judged means = judged(offer, values, trial, truth);
    if (!means.slots.empty())
        return chosen_slot(means, random);
    if (means.words)
        return std::clamp(static_cast<int>(std::lround(0.5 * (count - 1) + *means.words + random.normal())),
                          0, count - 1);
    if (means.right < 0)
        return by_chance;
    if (count < 2 || random.uniform() < means.share_right)
        return means.right;
    return (means.right + 1 + static_cast<int>(random.below(static_cast<std::uint32_t>(count - 1)))) % count;
}

std::optional<double> SimulatedAnswers::judge(const AnswerOffer& offer, const Trial& trial,
                                              const AnswerTruth& truth, RandomStream& random) const {
    if (!offer.low && !offer.high && truth.by.empty() && !truth.offset)
        return std::nullopt;
    return number_judged(offer, trial, truth, random.normal());
}

double SimulatedAnswers::number_judged(const AnswerOffer& offer, const Trial& trial, const AnswerTruth& truth,
                                       double noise) const {
    const std::optional<double> here =
        truth.by.empty() ? std::nullopt : level(trial, trial.stimulus, truth.by);
    const double middle = here ? 0.0 : 0.5 * (offer.low.value_or(0.0) + offer.high.value_or(0.0));
    const Leaning leaning = leaning_to(offer.id, trial, trial.stimulus);
    const double judged = truth.offset.value_or(middle) + truth.gain * leaning.slope * here.value_or(0.0) +
                          leaning.shift + inclination(offer, truth) + truth.noise * noise;
    if (!truth.cuts.empty() && !offer.numbers.empty()) {
        const auto below = static_cast<std::size_t>(
            std::ranges::count_if(truth.cuts, [&](double cut) { return cut < judged; }));
        return offer.numbers[std::min(below, offer.numbers.size() - 1)];
    }
    double number = judged;
    if (offer.step > 0.0) {
        const double from = offer.low.value_or(0.0);
        number = from + std::round((judged - from) / offer.step) * offer.step;
    }
    if (offer.low)
        number = std::max(number, *offer.low);
    if (offer.high)
        number = std::min(number, *offer.high);
    return number;
}

std::vector<std::string> SimulatedAnswers::values_of(const AnswerOffer& offer, const TaskAnswer* settings) {
    const auto& written = settings && settings->is_choice() ? settings->choices
                          : settings                        ? settings->keys
                                                            : offer.values;
    return written.size() == offer.values.size() ? written : offer.values;
}

std::vector<int> SimulatedAnswers::match(const AnswerOffer& offer, const Trial& trial,
                                         const AnswerTruth& truth, RandomStream& random) const {
    const Leaning leaning = leaning_to(offer.id, trial, trial.stimulus);
    std::vector<int> at;
    for (const OfferedAxis& axis : offer.axes) {
        const double middle = 0.5 * (axis.values.front() + axis.values.back());
        double wanted = truth.offset.value_or(axis.reference ? 0.0 : middle) +
                        truth.gain * leaning.slope * axis.reference.value_or(0.0) + leaning.shift +
                        inclination(offer, truth) + truth.noise * random.normal();
        wanted += truth.start_bias * (axis.values[static_cast<std::size_t>(axis.start)] - wanted);
        const auto nearest =
            std::ranges::min_element(axis.values, {}, [&](double value) { return std::abs(value - wanted); });
        at.push_back(static_cast<int>(nearest - axis.values.begin()));
    }
    return at;
}

namespace {

std::optional<Attitude> lean_of(const AnswerOffer& offer, const AnswerTruth& truth, RandomStream& random) {
    if (!offer.true_attitude)
        return std::nullopt;
    const glm::dvec2 shear =
        truth.shear.size() == 2 ? glm::dvec2(truth.shear[0], truth.shear[1]) : glm::dvec2(0.0);
    const double right = random.normal(), up = random.normal();
    const glm::dvec2 rise =
        truth.gain * depth_rise(*offer.true_attitude) + shear + truth.noise * glm::dvec2(right, up);
    return attitude_of(glm::dvec3(rise, 1.0));
}

} // namespace

SimulatedAnswers::Intended SimulatedAnswers::answer(const AnswerOffer& offer, const Trial& trial) const {
    const Task& task = protocol_.tasks[static_cast<std::size_t>(trial.task)];
    const auto found = std::ranges::find(task.answers, offer.id, &TaskAnswer::id);
    const AnswerTruth truth = found == task.answers.end() ? AnswerTruth{} : found->truth;
    const auto index = static_cast<std::uint64_t>(trial.index);
    // Streams of their own, so that what is answered does not move when.
    RandomStream when(seed_, fmt::format("answer time {} {}", offer.id, offer.item), index);
    RandomStream what(seed_, fmt::format("answer {} {}", offer.id, offer.item), index);
    Intended given;
    given.after = from_seconds(std::max(0.0, truth.shift_s + more_time_s(trial, truth)) +
                               truth.median_s * std::exp(truth.log_sd * when.normal()));
    given.is_early = when.uniform() < truth.early;
    given.is_missing = when.uniform() < truth.missing;
    given.is_late = when.uniform() < truth.late && offer.limit_s.has_value();
    if (given.is_late)
        given.after = from_seconds(*offer.limit_s + late_by_s);
    if (!offer.axes.empty()) {
        given.at = match(offer, trial, truth, what);
    } else if (offer.attitude) {
        given.attitude = lean_of(offer, truth, what);
        given.is_missing = given.is_missing || !given.attitude;
    } else if (offer.kind == "point") {
        constexpr double miss_px = 4.0;
        given.right_px = miss_px * what.normal();
        given.down_px = miss_px * what.normal();
    } else if (!offer.values.empty() && offer.numbers.empty()) {
        // Choices go round over the keys: what is meant is one of those that are written in the protocol.
        const std::vector<std::string> values =
            values_of(offer, found == task.answers.end() ? nullptr : &*found);
        const int meant = choose(offer, values, trial, truth, what);
        given.choice = static_cast<int>(
            std::ranges::find(offer.values, values[static_cast<std::size_t>(meant)]) - offer.values.begin());
    } else
        given.number = judge(offer, trial, truth, what);
    return given;
}

GazeFavour SimulatedAnswers::favour_of(const Trial& lit, const std::vector<std::string>& areas) const {
    GazeFavour favour;
    for (const TaskAnswer& answer : protocol_.tasks[static_cast<std::size_t>(lit.task)].answers) {
        const AnswerTruth& truth = answer.truth;
        if (!answer.is_choice() || (!truth.look_share && truth.look_area.empty()))
            continue;
        const auto slot_of = [&](const std::string& choice) {
            const auto slot = std::ranges::find(protocol_.slots, choice, &Slot::id);
            return slot == protocol_.slots.end() ? -1 : static_cast<int>(slot - protocol_.slots.begin());
        };
        const auto is_lit = [&](const std::string& choice) {
            const int slot = slot_of(choice);
            for (std::size_t place = 0; place < lit.shown_count(); ++place)
                if (lit.shown(place).slot == slot)
                    return true;
            return slot < 0;
        };
        if (!std::ranges::all_of(answer.choices, is_lit))
            continue; // the choice is not made yet, or was
        const AnswerOffer offer = offer_of(protocol_, answer, "", lit);
        const int chosen = this->answer(offer, lit).choice;
        if (truth.look_share) {
            favour.slot = slot_of(answer.choices[static_cast<std::size_t>(chosen)]);
            favour.share = *truth.look_share;
        }
        const auto area = std::ranges::find(areas, truth.look_area);
        if (area != areas.end() && chosen == 0) {
            favour.area = static_cast<int>(area - areas.begin());
            favour.odds = truth.look_odds;
        }
        break;
    }
    return favour;
}

} // namespace overt
