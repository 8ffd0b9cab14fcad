#include "experiment/record/tables/imported_trials.h"

#include <algorithm>
#include <cctype>
#include <sstream>
#include <string_view>

#include <fmt/format.h>

namespace overt {

namespace {

constexpr std::string_view trial_id_word = "TRIALID", variable_words = "!V TRIAL_VAR ";

std::vector<std::string> words_in(std::string_view text) {
    std::istringstream stream{std::string(text)};
    std::vector<std::string> words;
    for (std::string word; stream >> word;)
        words.push_back(word);
    return words;
}

std::string column_of_variable(const std::string& name) {
    std::string column = "var_";
    for (const char c : name)
        column += std::isalnum(static_cast<unsigned char>(c)) != 0 && static_cast<unsigned char>(c) < 0x80
                      ? c
                      : '_';
    return column;
}

void add_variable(TrialMessages& messages, std::int64_t attempt, std::string_view text) {
    const std::size_t begin = text.find_first_not_of(" \t");
    if (begin == std::string_view::npos)
        return;
    text.remove_prefix(begin);
    const std::size_t end = std::min(text.find_first_of(" \t"), text.size());
    const std::string name(text.substr(0, end));
    text.remove_prefix(end);
    const std::size_t value = text.find_first_not_of(" \t");
    messages.variables[attempt][name] =
        value == std::string_view::npos ? std::string() : std::string(text.substr(value));
    if (std::ranges::find(messages.names, name) == messages.names.end())
        messages.names.push_back(name);
}

} // namespace

TrialMessages trial_messages(const SessionRecord& record) {
    TrialMessages messages;
    for (const TrialRecord& trial : record.trials()) {
        if (!record.gaze_source(trial.sitting))
            continue;
        record.read_gaze_events(trial, [&](const GazeEvent& event) {
            if (event.kind != GazeEvent::Kind::message)
                return;
            const std::string_view text = event.text;
            if (text.starts_with(trial_id_word))
                messages.words[trial.id] = words_in(text.substr(trial_id_word.size()));
            else if (const std::size_t at = text.find(variable_words); at != std::string_view::npos)
                // A whole number may stand before it: by how many milliseconds the message came too late.
                add_variable(messages, trial.id, text.substr(at + variable_words.size()));
        });
    }
    return messages;
}

std::vector<RowLayout<TrialRow>::Column> imported_trial_columns(const TrialMessages& messages) {
    std::size_t most = 0;
    for (const auto& [id, of_trial] : messages.words)
        most = std::max(most, of_trial.size());
    std::vector<RowLayout<TrialRow>::Column> columns;
    for (std::size_t n = 0; n < most; ++n)
        columns.push_back(
            {{fmt::format("trialid_{}", n + 1),
              fmt::format("Word {} after TRIALID in the trial's message of the imported recording", n + 1)},
             [&messages, n](const TrialRecord& attempt) -> std::string_view {
                 const auto found = messages.words.find(attempt.id);
                 return found != messages.words.end() && n < found->second.size()
                            ? std::string_view(found->second[n])
                            : std::string_view();
             }});
    for (const std::string& name : messages.names) {
        const std::string column = column_of_variable(name);
        if (std::ranges::any_of(columns, [&](const auto& other) { return other.what.name == column; }))
            continue;
        columns.push_back(
            {{column,
              fmt::format(
                  "Variable {} of the trial, by its last message !V TRIAL_VAR in the imported recording",
                  name)},
             [&messages, name](const TrialRecord& attempt) -> std::string_view {
                 const auto of_trial = messages.variables.find(attempt.id);
                 if (of_trial == messages.variables.end())
                     return {};
                 const auto found = of_trial->second.find(name);
                 return found == of_trial->second.end() ? std::string_view()
                                                        : std::string_view(found->second);
             }});
    }
    return columns;
}

} // namespace overt
