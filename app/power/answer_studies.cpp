#include "app/power/answer_studies.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "devices/simulated/simulated_keys.h"
#include "experiment/base/random.h"
#include "experiment/design/answer_forms.h"
#include "experiment/design/procedure_trials.h"
#include "experiment/design/schedule.h"
#include "experiment/study/read/answer_reader.h"

namespace overt {

namespace {

std::vector<std::string> slot_ids(const Protocol& protocol) {
    std::vector<std::string> ids;
    for (const Slot& slot : protocol.slots)
        ids.push_back(slot.id);
    return ids;
}

int task_called(const Protocol& protocol, const std::string& id) {
    return static_cast<int>(std::ranges::find(protocol.tasks, id, &Task::id) - protocol.tasks.begin());
}

/// Where an effect holds, and how much it changes.
SimulatedEffect planted_effect(const PowerEffect& effect, const AnswerTruth& truth, double size) {
    SimulatedEffect planted;
    const auto hold_in = [&](const std::string& column, const std::string& level) {
        const auto list = std::ranges::find(stimulus_lists, column, &StimulusList::name);
        if (column == "task")
            planted.task = level;
        else if (list != stimulus_lists.end())
            planted.entries[static_cast<std::size_t>(list - stimulus_lists.begin())] = level;
        else
            planted.where.push_back({column, level, {}});
    };
    hold_in(effect.column, effect.level);
    for (const StudyKey& key : effect.within)
        hold_in(key.column, key.value);
    planted.answer = effect.answer;
    switch (effect.measure) {
    case PowerMeasure::threshold:
        if (effect.is_ratio)
            planted.answer_slope = 1.0 / size;
        else
            planted.answer_shift = -truth.slope * size;
        break;
    case PowerMeasure::slope:
        planted.answer_slope = size;
        break;
    case PowerMeasure::correct:
    case PowerMeasure::d_prime:
        planted.answer_odds = size;
        break;
    case PowerMeasure::choice:
        planted.answer_shift = size;
        break;
    case PowerMeasure::rating:
        planted.answer_shift = size;
        break;
    default:
        break;
    }
    return planted;
}

MeasuredAnswer measure_of(const PowerEffect& effect, const TaskAnswer& answer) {
    switch (effect.measure) {
    case PowerMeasure::threshold:
        return {AnswerMeasure::threshold, answer.truth.by};
    case PowerMeasure::slope:
        return {AnswerMeasure::log_slope, answer.truth.by};
    case PowerMeasure::correct:
        return {AnswerMeasure::correct, ""};
    case PowerMeasure::d_prime:
        return {AnswerMeasure::d_prime, ""};
    case PowerMeasure::choice:
        return {AnswerMeasure::choice, std::ranges::min(answer.choices)};
    default:
        return {AnswerMeasure::mean, ""};
    }
}

} // namespace

const TaskAnswer& asked_answer(const Protocol& protocol, const PowerEffect& effect) {
    const Task& task = protocol.tasks[static_cast<std::size_t>(task_called(protocol, effect.task))];
    return *std::ranges::find(task.answers, effect.answer, &TaskAnswer::id);
}

AnswerStudies::AnswerStudies(const Protocol& protocol, const PowerEffect& effect)
    : protocol_(protocol), effect_(effect), measured_(measure_of(effect, asked_answer(protocol, effect))),
      task_(task_called(protocol, effect.task)) {}

/// The protocol with this observer's own effect.
Protocol AnswerStudies::planted_for(std::uint64_t observer_seed) const {
    Protocol planted = protocol_;
    const double own =
        effect_.sd > 0.0 ? effect_.sd * RandomStream(observer_seed, "effect on an observer").normal() : 0.0;
    const double size = effect_.is_shift() ? effect_.size + own : effect_.size * std::exp(own);
    planted.simulated_effects = {planted_effect(effect_, asked_answer(protocol_, effect_).truth, size)};
    return planted;
}

std::vector<std::vector<StudyAnswer>> AnswerStudies::study(std::uint64_t seed, int observers) const {
    ScheduleMaker schedules(protocol_);
    const int digits = observers > 99 ? 3 : 2;
    std::vector<std::vector<StudyAnswer>> all;
    std::optional<Protocol> shared;
    for (int number = 1; number <= observers; ++number) {
        RandomStream seeds(seed, "seeds of observers", static_cast<std::uint64_t>(number));
        const std::uint64_t high = seeds.next_bits(), own = high << 32 | seeds.next_bits();
        if (!shared || effect_.sd > 0.0)
            shared.emplace(planted_for(own));
        all.push_back(
            answers_of(*shared, schedules.make({fmt::format("{:0{}}", number, digits), number}, own), own));
    }
    return all;
}

std::vector<StudyAnswer> AnswerStudies::answers_of(const Protocol& planted, const Schedule& schedule,
                                                   std::uint64_t seed) const {
    const Factors factors = factors_of(planted);
    const std::vector<std::string> slots = slot_ids(planted);
    const SimulatedAnswers simulated(planted, seed);
    ProcedureTrials procedures(planted, schedule);
    std::vector<StudyAnswer> answers;
    for (const Trial& scheduled : schedule.trials) {
        if (scheduled.role != TrialRole::trial)
            continue;
        Trial trial = scheduled;
        (void)procedures.decide(trial);
        // Where all tracks have ended, no further trials come.
        if (procedures.has_ended(trial))
            continue;
        const Task& task = planted.tasks[static_cast<std::size_t>(trial.task)];
        std::vector<GivenAnswer> given;
        const std::vector<AnsweredStimulus> shown = answered_stimuli(factors, slots, trial);
        for (const TaskAnswer& asked : task.answers) {
            // Others are needed only by procedures, which read choices.
            const bool is_tested = trial.task == task_ && asked.id == effect_.answer;
            if (!is_tested && !asked.is_choice())
                continue;
            const AnswerOffer offer = offer_of(planted, asked, "", trial);
            const SimulatedAnswers::Intended intended = simulated.answer(offer, trial);
            GivenAnswer& one = given.emplace_back();
            one.id = asked.id;
            one.kind = offer.kind;
            one.correct = offer.correct;
            one.is_missed = intended.is_missing || intended.is_late;
            one.number = intended.number;
            if (!offer.values.empty() && !intended.number)
                one.value = offer.values[static_cast<std::size_t>(intended.choice)];
            else if (intended.number)
                one.value = fmt::format("{:g}", *intended.number);
            if (!one.correct.empty() && !one.is_missed)
                one.is_correct = one.value == one.correct;
            else if (!one.correct.empty() && asked.missed == MissedAnswer::wrong)
                one.is_correct = false;
            if (!is_tested)
                continue;
            StudyAnswer answer;
            answer.observer = schedule.observer.label;
            answer.task = task.id;
            answer.answer = asked.id;
            answer.kind = one.kind;
            answer.value = one.value;
            answer.correct = one.correct;
            answer.is_missed = one.is_missed;
            answer.is_correct = one.is_correct;
            answer.number = one.is_missed ? std::nullopt : one.number;
            answer.shown = shown;
            answer.levels = levels_of(trial, shown);
            const auto is_of = [&](const StudyKey& key) {
                return key.column == "task" ? key.value == task.id : answer.level(key.column) == key.value;
            };
            if (std::ranges::all_of(effect_.within, is_of))
                answers.push_back(std::move(answer));
        }
        procedures.tell(trial, given);
    }
    return answers;
}

std::vector<StudyOutcome> AnswerStudies::tested(const std::vector<std::vector<StudyAnswer>>& study,
                                                std::span<const int> observers,
                                                const PermutationSettings& settings,
                                                const std::optional<double>& equivalence) const {
    std::vector<std::optional<double>> differences;
    for (const std::vector<StudyAnswer>& own : study) {
        AnswerList list;
        for (const StudyAnswer& one : own)
            list.push_back(&one);
        differences.push_back(difference_of(measured_, list, effect_.column, effect_.level, effect_.against));
    }
    std::vector<StudyOutcome> outcomes;
    for (const int count : observers) {
        std::vector<double> first;
        for (int i = 0; i < count; ++i)
            if (const std::optional<double>& one = differences[static_cast<std::size_t>(i)])
                first.push_back(*one);
        StudyOutcome outcome = outcome_of(first, settings, equivalence);
        outcome.without_measure = count - static_cast<int>(first.size());
        outcomes.push_back(outcome);
    }
    return outcomes;
}

} // namespace overt
