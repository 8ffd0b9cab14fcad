#include "experiment/study/read/answer_reader.h"

#include <algorithm>

#include "experiment/record/read/session_record.h"
#include "experiment/session_time.h"

namespace overt {

namespace {

/// What a stimulus is in each factor in which stimuli can differ.
AnsweredStimulus answered_stimulus(const SessionHeader& header, const Factors& factors, const Trial& trial,
                                   const PlacedStimulus& shown) {
    AnsweredStimulus stimulus;
    const auto slot = static_cast<std::size_t>(shown.slot);
    stimulus.slot = slot < header.slots.size() ? header.slots[slot].id : "";
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
    return stimulus;
}

} // namespace

std::optional<double> AnsweredStimulus::number(const std::string& factor) const {
    const auto found = std::ranges::find(numbers, factor, &std::pair<std::string, double>::first);
    return found != numbers.end() ? std::optional(found->second) : std::nullopt;
}

std::vector<StudyAnswer> read_answers(std::span<const std::filesystem::path> sessions,
                                      std::span<const std::pair<std::string, std::string>> same_observer) {
    std::vector<StudyAnswer> answers;
    for (const std::filesystem::path& folder : sessions) {
        const SessionRecord record(folder);
        const SessionHeader& header = record.header();
        const Factors factors = factors_of(header);
        std::string observer = header.schedule.observer.label;
        const auto same =
            std::ranges::find(same_observer, observer, &std::pair<std::string, std::string>::first);
        if (same != same_observer.end())
            observer = same->second;
        for (const TrialRecord& trial : record.trials()) {
            if (!trial.gives_results() || trial.outcome.given.empty())
                continue;
            std::vector<AnsweredStimulus> shown;
            for (const PlacedStimulus& one : trial.trial.all_shown())
                shown.push_back(answered_stimulus(header, factors, trial.trial, one));
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
            }
        }
    }
    return answers;
}

} // namespace overt
