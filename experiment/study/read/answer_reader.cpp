#include "experiment/study/read/answer_reader.h"

#include <algorithm>
#include <map>
#include <set>
#include <string_view>

#include <fmt/format.h>

#include "experiment/base/text_number.h"
#include "experiment/ports/event_kinds.h"
#include "experiment/record/read/session_record.h"
#include "experiment/session_time.h"

namespace overt {

namespace {

/// What a procedure chose for a trial, as the record has it in words: "ID: FACTOR LEVEL, condition N, …".
struct ChosenByProcedure {
    std::string procedure, factor;
    int condition = 1;
};

std::optional<ChosenByProcedure> chosen_by_procedure(std::string_view words) {
    constexpr std::string_view before_condition = ", condition ";
    const std::size_t id = words.find(": "), condition = words.find(before_condition);
    if (id == std::string_view::npos || condition == std::string_view::npos || condition < id)
        return std::nullopt;
    const std::string_view chosen = words.substr(id + 2, condition - id - 2),
                           rest = words.substr(condition + before_condition.size());
    const std::size_t blank = chosen.rfind(' ');
    const std::optional<int> number = number_in<int>(rest.substr(0, rest.find(',')));
    if (blank == std::string_view::npos || !number)
        return std::nullopt;
    return ChosenByProcedure{std::string(words.substr(0, id)), std::string(chosen.substr(0, blank)), *number};
}

/// Of a match, those of the stimulus that is matched: the first in another slot.
std::vector<std::pair<std::string, std::string>> levels_beside(const GivenAnswer& match, const Trial& trial,
                                                               std::span<const AnsweredStimulus> shown) {
    std::vector<AnsweredStimulus> reference;
    for (std::size_t i = 0; i < shown.size() && reference.empty(); ++i)
        if (trial.shown(i).slot != match.slot)
            reference.push_back(shown[i]);
    return levels_of(trial, reference.empty() ? shown : std::span<const AnsweredStimulus>(reference));
}

/// By trial, that of its last attempt.
std::map<int, ChosenByProcedure> procedure_choices(const SessionRecord& record) {
    std::map<int, ChosenByProcedure> choices;
    record.read_events([&](const RecordedEvent& event) {
        if (event.kind == level_chosen_event)
            if (auto chosen = chosen_by_procedure(event.detail))
                choices[event.trial] = *std::move(chosen);
    });
    return choices;
}

/// A step of a task whose time is drawn from a list, by its place in the task's trials.
struct DrawnStep {
    std::string task;
    std::size_t place = 0;
    friend auto operator<=>(const DrawnStep&, const DrawnStep&) = default;
};

} // namespace

void add_drawn_times(std::vector<StudyAnswer>& answers, const StepsOfTrials& steps) {
    constexpr std::size_t most_levels = 6, least_trials = 2;
    std::map<DrawnStep, std::map<std::string, std::set<std::pair<int, int>>>> drawn; ///< trials by level
    std::map<DrawnStep, std::string> kinds;
    for (const StudyAnswer& one : answers) {
        const std::pair trial(one.session, one.trial);
        const auto known = steps.find(trial);
        for (std::size_t i = 0; known != steps.end() && i < known->second.size(); ++i) {
            const AttemptStep& step = known->second[i];
            if (!step.drawn_s)
                continue;
            drawn[{one.task, i}][fmt::format("{}", *step.drawn_s)].insert(trial);
            kinds[{one.task, i}] = step.kind;
        }
    }
    std::map<std::pair<std::string, std::string>, int> of_kind;
    std::map<DrawnStep, std::string> names;
    for (const auto& [step, levels] : drawn) {
        if (levels.size() < 2 || levels.size() > most_levels ||
            std::ranges::any_of(levels, [](const auto& level) { return level.second.size() < least_trials; }))
            continue;
        const int number = ++of_kind[{step.task, kinds[step]}];
        names[step] = kinds[step] + (number > 1 ? fmt::format("_s_{}", number) : "_s");
    }
    for (StudyAnswer& one : answers) {
        const auto known = steps.find({one.session, one.trial});
        for (std::size_t i = 0; known != steps.end() && i < known->second.size(); ++i)
            if (const auto name = names.find({one.task, i}); name != names.end() && known->second[i].drawn_s)
                one.levels.emplace_back(name->second, fmt::format("{}", *known->second[i].drawn_s));
    }
}

std::vector<AnsweredStimulus> answered_stimuli(const Factors& factors, std::span<const std::string> slots,
                                               const Trial& trial) {
    std::vector<AnsweredStimulus> stimuli;
    for (const PlacedStimulus& shown : trial.all_shown()) {
        AnsweredStimulus& stimulus = stimuli.emplace_back();
        const auto slot = static_cast<std::size_t>(shown.slot);
        stimulus.slot = slot < slots.size() ? slots[slot] : "";
        for (const Factor& factor : factors.all()) {
            const bool is_of_stimuli =
                factor.source == Factor::Source::list || factor.source == Factor::Source::column;
            if (!is_of_stimuli || factor.levels.size() < 2)
                continue;
            const FactorLevel& level =
                factor.levels[static_cast<std::size_t>(factors.level_of(factor, trial, shown.stimulus))];
            stimulus.levels.emplace_back(factor.name, level.name);
            if (level.number)
                stimulus.numbers.emplace_back(factor.name, *level.number);
        }
    }
    return stimuli;
}

std::vector<std::pair<std::string, std::string>> levels_of(const Trial& trial,
                                                           std::span<const AnsweredStimulus> shown) {
    std::vector<std::pair<std::string, std::string>> levels;
    for (const TrialLevel& own : trial.levels)
        levels.emplace_back(own.factor, own.level);
    for (const auto& level : shown.front().levels)
        if (std::ranges::all_of(shown, [&](const AnsweredStimulus& one) {
                return std::ranges::find(one.levels, level) != one.levels.end();
            }))
            levels.push_back(level);
    return levels;
}

std::vector<StudyAnswer> read_answers(std::span<const std::filesystem::path> sessions,
                                      std::span<const std::pair<std::string, std::string>> same_observer) {
    std::vector<StudyAnswer> answers;
    StepsOfTrials steps;
    for (std::size_t session = 0; session < sessions.size(); ++session) {
        const SessionRecord record(sessions[session]);
        const SessionHeader& header = record.header();
        const Factors factors = factors_of(header);
        std::string observer = header.schedule.observer.label;
        const auto same =
            std::ranges::find(same_observer, observer, &std::pair<std::string, std::string>::first);
        if (same != same_observer.end())
            observer = same->second;
        std::vector<std::string> slots;
        for (const RecordedSlot& slot : header.slots)
            slots.push_back(slot.id);
        const std::map<int, ChosenByProcedure> procedures = procedure_choices(record);
        for (const TrialRecord& trial : record.trials()) {
            if (!trial.gives_results() || trial.outcome.given.empty())
                continue;
            const std::vector<AnsweredStimulus> shown = answered_stimuli(factors, slots, trial.trial);
            std::vector<std::optional<SessionTime>> onsets;
            for (std::size_t i = 0; i < trial.trial.shown_count(); ++i) {
                const SessionTime onset = trial.seen_in(i).outcome.presentation_onset;
                onsets.push_back(trial.reached(onset) ? std::optional(onset) : std::nullopt);
            }
            const auto levels = levels_of(trial.trial, shown);
            const auto procedure = procedures.find(trial.trial.index);
            steps[{static_cast<int>(session), trial.trial.index + 1}] = trial.outcome.steps;
            for (const GivenAnswer& given : trial.outcome.given) {
                StudyAnswer& answer = answers.emplace_back();
                answer.observer = observer;
                answer.task = header.tasks[static_cast<std::size_t>(trial.trial.task)].id;
                answer.answer = given.id;
                answer.item = given.item;
                answer.kind = given.kind;
                answer.value = given.value;
                answer.correct = given.correct;
                answer.is_missed = given.is_missed;
                answer.is_correct = given.is_correct;
                answer.number = given.number;
                if (const auto time = given.response_time())
                    answer.response_s = to_seconds(*time);
                answer.shown = shown;
                for (std::size_t i = 0; i < onsets.size() && given.answered_at; ++i)
                    if (onsets[i] && *given.answered_at > *onsets[i])
                        answer.shown[i].until_answer_s = to_seconds(*given.answered_at - *onsets[i]);
                answer.session = static_cast<int>(session);
                answer.trial = trial.trial.index + 1;
                answer.levels = given.settings.empty() ? levels : levels_beside(given, trial.trial, shown);
                answer.settings = given.settings;
                if (procedure != procedures.end()) {
                    answer.procedure = procedure->second.procedure;
                    answer.procedure_factor = procedure->second.factor;
                    answer.track = procedure->second.condition;
                }
            }
        }
    }
    add_drawn_times(answers, steps);
    return answers;
}

} // namespace overt
