/// Cells of an attempt at a trial, for the tables whose rows are of one, or become one.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "experiment/base/plain_text.h"
#include "experiment/factors.h"
#include "experiment/record/read/session_record.h"
#include "experiment/record/tables/joined_cells.h"
#include "experiment/record/tables/shared_columns.h"

namespace overt {

inline int number_of_trial(const TrialRecord& attempt) { return attempt.trial.index + 1; }
inline int attempt_number(const TrialRecord& attempt) { return attempt.attempt; }
inline std::string_view attempt_status(const TrialRecord& attempt) { return name_of(attempt.status); }
inline std::string_view attempt_counts(const TrialRecord& attempt) { return attempt.counts ? "yes" : "no"; }
inline std::optional<Fixed> attempt_drift(const TrialRecord& attempt) {
    const std::optional<Degrees>& drift = attempt.outcome.drift;
    return attempt.has_outcome() && drift ? std::optional(Fixed{drift->value, angle_decimals}) : std::nullopt;
}

// `header` must outlive what these give.
inline auto block_of(const SessionHeader& header) {
    return [&header](const TrialRecord& attempt) -> std::string_view {
        const std::string* const block = item_of(header.blocks, attempt.trial.block);
        return block ? std::string_view(*block) : std::string_view();
    };
}
inline auto task_of(const SessionHeader& header) {
    return [&header](const TrialRecord& attempt) -> std::string_view {
        return item(header.tasks, attempt.trial.task).id;
    };
}
inline auto question_of(const SessionHeader& header) {
    return [&header](const TrialRecord& attempt) {
        return plain_line_of(item(header.tasks, attempt.trial.task).question);
    };
}
/// The stimulus of an attempt.
inline const Stimulus& shown_in(const TrialRecord& attempt) { return attempt.trial.stimulus; }
/// Columns of what the session's trials have of their own: factors of its tables and rules, correct answers,
/// and whether they check the observer. None where they have none.
template <class Column> std::vector<Column> own_columns(const SessionHeader& header) {
    std::vector<Column> columns;
    std::vector<std::string> names;
    for (const NamedWord& level : own_levels_of(header.schedule.trials))
        if (std::ranges::find(names, level.name) == names.end())
            names.push_back(level.name);
    for (const std::string& name : names) {
        const std::string meaning = name == correct_answer
                                        ? "The correct answer; n/a: there is none, or nobody knows it"
                                        : fmt::format("Level of the factor {} of the trial's own", name);
        columns.push_back({{name, meaning}, [name](const TrialRecord& attempt) {
                               const std::string_view level = own_level(attempt.trial, name);
                               return when(!level.empty(), level);
                           }});
        columns.back().is_named = true;
    }
    const auto& trials = header.schedule.trials;
    if (std::ranges::any_of(trials, [](const Trial& trial) { return trial.role != TrialRole::trial; }))
        columns.push_back({{"role",
                            "What the trial is there for; results are of trials proper",
                            "",
                            {{"trial", "a trial of the experiment"},
                             {"catch", "checks the observer, among the others"},
                             {"practice", "of a block of practice"}}},
                           [](const TrialRecord& attempt) { return name_of(attempt.trial.role); }});
    return columns;
}

/// Nothing where no vertical blanks prove which refreshes were missed.
inline auto missed_refreshes_of(const SessionHeader& header) {
    return [&header](const TrialRecord& attempt) {
        return when(attempt.has_outcome() && !header.is_timing_unproven(), attempt.outcome.missed_refreshes);
    };
}

/// What proves the times of flips: the same in all rows.
inline TableColumn timing_column() {
    return {"timing",
            "What proves the times of flips, and with them missed refreshes; n/a: not recorded",
            "",
            {{"proven", "real vertical blanks of the display"},
             {"unproven", "nothing: which refreshes were missed is not known"},
             {"none", "time was virtual, with refreshes missed as simulated; or there was no display: which "
                      "were missed is not known"}}};
}
inline auto timing_of(const SessionHeader& header) {
    return [&header](auto&) -> std::string_view { return header.display.timing; };
}

} // namespace overt
