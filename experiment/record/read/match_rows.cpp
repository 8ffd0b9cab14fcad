#include "experiment/record/read/match_rows.h"

#include <algorithm>

#include "experiment/record/sql.h"
#include "experiment/record/stimulus_columns.h"

namespace overt {

namespace {

/// The n-th answer of an attempt, from 1; null if there is none.
GivenAnswer* answer_of(std::vector<TrialRecord>& trials, std::int64_t attempt, int n) {
    const auto trial = std::ranges::find(trials, attempt, &TrialRecord::id);
    if (trial == trials.end() || n < 1 || static_cast<std::size_t>(n) > trial->outcome.given.size())
        return nullptr;
    return &trial->outcome.given[static_cast<std::size_t>(n) - 1];
}

} // namespace

void add_matches(const SQLite::Database& database, std::vector<TrialRecord>& trials) {
    if (!has_table(database, "match_setting"))
        return;
    for (Query row(database, "SELECT trial_id, n, slot, along, start, final, low, high, reference, changes, "
                             "reversals, stopped_low, stopped_high FROM match_setting "
                             "ORDER BY trial_id, n, axis");
         row.step();) {
        const std::int64_t attempt = row.integer();
        GivenAnswer* const given = answer_of(trials, attempt, row.small());
        MatchSetting set;
        int slot = -1;
        row.read(slot, set.along, set.start, set.final, set.low, set.high, set.reference, set.changes,
                 set.reversals, set.stopped_low, set.stopped_high);
        if (!given)
            continue;
        given->slot = slot;
        given->settings.push_back(std::move(set));
    }
    const std::string sql = "SELECT trial_id, n, level, " + stimulus_columns_of(database, "match_level") +
                            ", first, second FROM match_level ORDER BY trial_id, n, level";
    for (Query row(database, sql.c_str()); row.step();) {
        const std::int64_t attempt = row.integer();
        GivenAnswer* const given = answer_of(trials, attempt, row.small());
        MatchLevel level;
        std::optional<double> second;
        level.values.emplace_back();
        row.read(level.level, level.stimulus, level.values.front(), second);
        if (second)
            level.values.push_back(*second);
        if (given)
            given->levels.push_back(std::move(level));
    }
}

std::vector<SteeredFlip> read_steered_flips(const SQLite::Database& database, const TrialRecord& trial) {
    return read_later_rows(
        database, "steered_flip",
        "SELECT refresh_in_trial, level, input_ns FROM steered_flip WHERE trial_id = ? AND place = ? "
        "ORDER BY refresh_in_trial",
        [&](Query& row) {
            SteeredFlip flip{.trial = trial.trial.index, .place = trial.place};
            flip.refresh_in_trial = row.small();
            flip.level = row.optional_small().value_or(-1);
            row.read(flip.input_at);
            return flip;
        },
        trial.id, trial.place);
}

} // namespace overt
