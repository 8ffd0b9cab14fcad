#include "experiment/record/read/trial_rows.h"

#include <algorithm>

#include <fmt/format.h>

#include "experiment/record/sql.h"

namespace overt {
namespace {

TrialRecord::Status status_from(const std::string& word) {
    for (const auto status :
         {TrialRecord::Status::completed, TrialRecord::Status::aborted, TrialRecord::Status::interrupted})
        if (word == name_of(status))
            return status;
    return TrialRecord::Status::open;
}

TrialOutcome::Afterwards afterwards_from(const std::string& word) {
    using enum TrialOutcome::Afterwards;
    for (const auto afterwards : {never, now, end_of_block})
        if (word == name_of(afterwards))
            return afterwards;
    return undecided;
}

TrialRecord read_trial(Query& row) {
    TrialRecord record;
    record.id = row.integer();
    record.sitting = row.small();
    record.trial.index = row.small();
    record.attempt = row.small();
    record.trial.task = row.small();
    record.trial.condition.sculpture = row.small();
    record.trial.condition.material = row.small();
    record.status = status_from(row.text());
    record.started = row.session_time();
    TrialOutcome& outcome = record.outcome;
    outcome.status = record.status == TrialRecord::Status::completed ? TrialOutcome::Status::completed
                                                                     : TrialOutcome::Status::aborted;
    outcome.task_screen_onset = row.session_time();
    outcome.presentation_onset = row.session_time();
    outcome.presentation_end = row.session_time();
    outcome.response_screen_onset = row.session_time();
    outcome.responded_at = row.session_time();
    outcome.shown_refreshes = row.small();
    outcome.missed_refreshes = row.small();
    if (const auto drift_deg = row.optional_real())
        outcome.drift = Degrees{*drift_deg};
    outcome.answer = row.text();
    record.lost_flips = row.integer();
    record.lost_samples = row.integer();
    outcome.failure = row.text();
    outcome.afterwards = afterwards_from(row.text());
    record.is_superseded = row.integer() != 0;
    record.counts = record.status == TrialRecord::Status::completed && !record.is_superseded;
    return record;
}

/// An answer has the time of the press that gave it.
void add_response_boxes(const SQLite::Database& database, std::vector<TrialRecord>& trials) {
    if (!has_table(database, "button_change"))
        return;
    for (Query row(database, "SELECT trial.trial_id, box, uncertainty_ns FROM trial JOIN button_change "
                             "ON attempt_id = trial.trial_id AND at_ns = responded_ns "
                             "WHERE is_down = 1 AND used_by = 'observer' AND meaning <> ''");
         row.step();) {
        const std::int64_t id = row.integer();
        const auto trial = std::ranges::find(trials, id, &TrialRecord::id);
        std::string box = row.text();
        const SessionDuration uncertainty(row.integer());
        if (trial == trials.end())
            continue;
        trial->response_box = std::move(box);
        trial->response_uncertainty = uncertainty;
    }
}

/// A press at a keyboard.
void add_presses(const SQLite::Database& database, std::vector<TrialRecord>& trials) {
    if (!has_table(database, "response_press"))
        return;
    for (Query row(database, "SELECT trial_id, uncertainty_ns FROM response_press"); row.step();) {
        const auto trial = std::ranges::find(trials, row.integer(), &TrialRecord::id);
        const SessionDuration uncertainty(row.integer());
        if (trial == trials.end())
            continue;
        trial->outcome.responded_uncertainty = uncertainty;
        if (!trial->response_uncertainty)
            trial->response_uncertainty = uncertainty;
    }
}

void add_swap_modes(const SQLite::Database& database, std::vector<TrialRecord>& trials) {
    if (!has_table(database, "swap_modes"))
        return;
    for (Query row(database, "SELECT trial_id, flipped, copied, suboptimal_copied, skipped FROM swap_modes");
         row.step();) {
        const auto trial = std::ranges::find(trials, row.integer(), &TrialRecord::id);
        SwapModes swaps;
        for (int* const count : {&swaps.flipped, &swaps.copied, &swaps.suboptimal_copied, &swaps.skipped})
            *count = row.small();
        if (trial != trials.end())
            trial->outcome.swaps = swaps;
    }
}

} // namespace

std::string_view name_of(TrialOutcome::Afterwards afterwards) {
    constexpr std::string_view names[] = {"", "never", "now", "end-of-block"};
    return names[static_cast<int>(afterwards)];
}

std::vector<TrialRecord> read_trials(const SQLite::Database& database) {
    // Screens without a time are before every session: see TrialRecord::reached. Sessions of earlier programs
    // know of nothing that was completed and does not count.
    const bool tells_fates = has_column(database, "trial", "comes_again");
    std::vector<TrialRecord> trials = read_rows(
        database,
        fmt::format(
            "SELECT trial_id, sitting, trial, attempt, task, sculpture, material, status, started_ns, "
            "COALESCE(task_screen_onset_ns, -1), COALESCE(presentation_onset_ns, -1), "
            "COALESCE(presentation_end_ns, -1), COALESCE(response_screen_onset_ns, -1), "
            "COALESCE(responded_ns, -1), shown_refreshes, missed_refreshes, drift_deg, "
            "answer, lost_flips, lost_samples, {} FROM trial ORDER BY trial_id",
            tells_fates ? "failure, comes_again, trial_id IN (SELECT attempt_id FROM superseded)"
                        : "NULL, NULL, 0"),
        read_trial);
    add_response_boxes(database, trials);
    add_presses(database, trials);
    add_swap_modes(database, trials);
    return trials;
}

std::string_view name_of(TrialRecord::Status status) {
    switch (status) {
    case TrialRecord::Status::open:
        return "open";
    case TrialRecord::Status::completed:
        return "completed";
    case TrialRecord::Status::aborted:
        return "aborted";
    case TrialRecord::Status::interrupted:
        return "interrupted";
    }
    return "unknown";
}

} // namespace overt
