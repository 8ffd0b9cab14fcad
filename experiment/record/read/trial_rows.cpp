#include "experiment/record/read/trial_rows.h"

#include <algorithm>
#include <sstream>

#include <fmt/format.h>

#include "experiment/record/read/match_rows.h"
#include "experiment/record/read/probe_records.h"
#include "experiment/record/sql.h"
#include "experiment/record/stimulus_columns.h"

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
    Trial& trial = record.trial;
    TrialOutcome& outcome = record.outcome;
    std::string status, afterwards;
    row.read(record.id, record.sitting, trial.index, record.attempt, trial.task, trial.stimulus, status,
             record.started, outcome.task_screen_onset, outcome.presentation_onset, outcome.presentation_end,
             outcome.response_screen_onset, outcome.responded_at, outcome.shown_refreshes,
             outcome.missed_refreshes, outcome.drift, outcome.answer, record.lost_flips, record.lost_samples,
             outcome.failure, afterwards, record.is_superseded);
    record.status = status_from(status);
    outcome.afterwards = afterwards_from(afterwards);
    outcome.status = record.status == TrialRecord::Status::completed ? TrialOutcome::Status::completed
                                                                     : TrialOutcome::Status::aborted;
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
        const auto trial = std::ranges::find(trials, row.integer(), &TrialRecord::id);
        if (trial != trials.end())
            row.read(trial->response_box, trial->response_uncertainty);
    }
}

/// A press at a keyboard.
void add_presses(const SQLite::Database& database, std::vector<TrialRecord>& trials) {
    if (!has_table(database, "response_press"))
        return;
    for (Query row(database, "SELECT trial_id, uncertainty_ns FROM response_press"); row.step();) {
        const auto trial = std::ranges::find(trials, row.integer(), &TrialRecord::id);
        if (trial == trials.end())
            continue;
        row.read(trial->outcome.responded_uncertainty);
        if (!trial->response_uncertainty)
            trial->response_uncertainty = trial->outcome.responded_uncertainty;
    }
}

/// The first that meant something at the time of the answer.
void add_response_keys(const SQLite::Database& database, std::vector<TrialRecord>& trials) {
    if (!has_table(database, "key_press"))
        return;
    for (Query row(database, "SELECT trial.trial_id, name FROM trial JOIN key_press "
                             "ON attempt_id = trial.trial_id AND at_ns = responded_ns "
                             "WHERE screen = 'response screen' AND meaning <> '' ORDER BY id DESC");
         row.step();) {
        const auto trial = std::ranges::find(trials, row.integer(), &TrialRecord::id);
        if (trial != trials.end())
            trial->response_key = row.text();
    }
}

/// Which slots it shows stimuli in. Sessions of earlier programs have one.
void add_slots(const SQLite::Database& database, std::vector<TrialRecord>& trials) {
    if (!has_table(database, "presentation"))
        return;
    auto trial = trials.begin(); // both by trial_id
    for (Query row(
             database,
             fmt::format("SELECT trial_id, place, slot, {} FROM presentation WHERE place > 0 OR slot <> 0 "
                         "ORDER BY trial_id, place",
                         stimulus_columns_of(database, "presentation"))
                 .c_str());
         row.step();) {
        const std::int64_t id = row.integer();
        const int place = row.small();
        PlacedStimulus shown;
        row.read(shown.slot, shown.stimulus);
        trial = std::ranges::find(trial, trials.end(), id, &TrialRecord::id);
        if (trial == trials.end())
            return;
        if (place == 0)
            trial->trial.slot = shown.slot;
        else
            trial->trial.beside.push_back(shown);
    }
}

/// What each slot's share of the flips is, in trials that show several stimuli. What a flip tells of missed
/// refreshes is each slot's that it lights.
void add_refreshes(const SQLite::Database& database, std::vector<TrialRecord>& trials) {
    const bool has_several =
        std::ranges::any_of(trials, [](const TrialRecord& trial) { return !trial.trial.beside.empty(); });
    if (!has_several || !has_table(database, "slot_flip"))
        return;
    const auto add = [&](const char* statement, int PresentedRefreshes::*count) {
        auto trial = trials.begin(); // both by trial_id
        for (Query row(database, statement); row.step();) {
            const std::int64_t id = row.integer();
            const auto place = static_cast<std::size_t>(row.small());
            trial = std::ranges::find(trial, trials.end(), id, &TrialRecord::id);
            if (trial == trials.end())
                return;
            if (trial->trial.beside.empty() || place >= trial->trial.shown_count())
                continue;
            trial->refreshes.resize(trial->trial.shown_count());
            row.read(trial->refreshes[place].*count);
        }
    };
    add("SELECT trial_id, 0, COUNT(*) FROM flip WHERE shown >= 0 GROUP BY trial_id ORDER BY trial_id",
        &PresentedRefreshes::shown);
    add("SELECT trial_id, 0, SUM(missed) FROM flip WHERE shown >= 0 GROUP BY trial_id ORDER BY trial_id",
        &PresentedRefreshes::missed);
    add("SELECT trial_id, place, COUNT(*) FROM slot_flip WHERE shown >= 0 GROUP BY trial_id, place "
        "ORDER BY trial_id, place",
        &PresentedRefreshes::shown);
    // From the few flips that missed some to the slots that they light, which the key of slot_flip finds.
    add("SELECT late.trial_id, lit.place, SUM(late.missed) FROM flip AS late CROSS JOIN slot_flip AS lit "
        "WHERE late.missed > 0 AND lit.trial_id = late.trial_id AND lit.refresh_in_trial = "
        "late.refresh_in_trial "
        "AND lit.shown >= 0 GROUP BY late.trial_id, lit.place ORDER BY late.trial_id, lit.place",
        &PresentedRefreshes::missed);
}

void add_gaze(const SQLite::Database& database, std::vector<TrialRecord>& trials) {
    if (!has_table(database, "trial_gaze"))
        return;
    for (Query row(database, "SELECT trial_id, samples, without_gaze, missing FROM trial_gaze");
         row.step();) {
        const auto trial = std::ranges::find(trials, row.integer(), &TrialRecord::id);
        GazeYield gaze;
        row.read(gaze.samples, gaze.without_gaze, gaze.missing);
        if (trial != trials.end())
            trial->outcome.gaze = gaze;
    }
}

void add_swap_modes(const SQLite::Database& database, std::vector<TrialRecord>& trials) {
    if (!has_table(database, "swap_modes"))
        return;
    for (Query row(database, "SELECT trial_id, flipped, copied, suboptimal_copied, skipped FROM swap_modes");
         row.step();) {
        const auto trial = std::ranges::find(trials, row.integer(), &TrialRecord::id);
        SwapModes swaps;
        row.read(swaps.flipped, swaps.copied, swaps.suboptimal_copied, swaps.skipped);
        if (trial != trials.end())
            trial->outcome.swaps = swaps;
    }
}

/// Of "0 2".
std::optional<std::vector<int>> places_in(const std::optional<std::string>& text) {
    if (!text)
        return std::nullopt;
    std::vector<int> places;
    std::istringstream words(*text);
    for (int place = 0; words >> place;)
        places.push_back(place);
    return places;
}

void add_steps(const SQLite::Database& database, std::vector<TrialRecord>& trials) {
    if (!has_table(database, "step"))
        return;
    const char* const places = has_column(database, "step", "places") ? "places" : "NULL";
    for (Query row(
             database,
             fmt::format("SELECT trial_id, kind, id, planned_refreshes, drawn_s, still_frame, begin_ns, "
                         "end_ns, ended_by, gaze_onset_us, gaze_detected_us, {} FROM step "
                         "ORDER BY trial_id, n",
                         places)
                 .c_str());
         row.step();) {
        const auto trial = std::ranges::find(trials, row.integer(), &TrialRecord::id);
        AttemptStep step;
        std::optional<std::string> ended_by, lit;
        row.read(step.kind, step.id, step.planned_refreshes, step.drawn_s, step.still_frame, step.begin,
                 step.end, ended_by, step.gaze_onset, step.gaze_detected, lit);
        step.places = places_in(lit);
        const auto word = std::ranges::find(names_of<StepEnd>, ended_by.value_or(""));
        if (word != names_of<StepEnd>.end())
            step.ended_by = static_cast<StepEnd>(word - names_of<StepEnd>.begin());
        if (trial != trials.end())
            trial->outcome.steps.push_back(std::move(step));
    }
}

template <class Enum> Enum read_name(const std::string& word, Enum otherwise) {
    const auto found = std::ranges::find(names_of<Enum>, word);
    return found == names_of<Enum>.end() ? otherwise : static_cast<Enum>(found - names_of<Enum>.begin());
}

void add_given_answers(const SQLite::Database& database, std::vector<TrialRecord>& trials) {
    if (!has_table(database, "given_answer"))
        return;
    for (Query row(database,
                   "SELECT trial_id, id, item, kind, is_missed, value, number, key, device, correct, "
                   "is_correct, zero, stimulus_onset_ns, window_onset_ns, window_end_ns, screen_onset_ns, "
                   "first_input_ns, answered_ns, uncertainty_ns, is_tied, place, mapping, changes "
                   "FROM given_answer ORDER BY trial_id, n");
         row.step();) {
        const auto trial = std::ranges::find(trials, row.integer(), &TrialRecord::id);
        GivenAnswer given;
        std::string zero;
        row.read(given.id, given.item, given.kind, given.is_missed, given.value, given.number, given.key,
                 given.device, given.correct, given.is_correct, zero, given.stimulus_onset,
                 given.window_onset, given.window_end, given.screen_onset, given.first_input_at,
                 given.answered_at, given.uncertainty, given.is_tied, given.place, given.mapping,
                 given.changes);
        given.zero = read_name(zero, AnswerZero::window);
        if (trial != trials.end())
            trial->outcome.given.push_back(std::move(given));
    }
}

void add_answer_inputs(const SQLite::Database& database, std::vector<TrialRecord>& trials) {
    if (!has_table(database, "answer_input"))
        return;
    for (Query row(database,
                   "SELECT trial_id, id, item, kind, at_ns, uncertainty_ns, device, key, character, "
                   "right_px, down_px, button, steps, state, has_counted, number "
                   "FROM answer_input ORDER BY trial_id, n");
         row.step();) {
        const auto trial = std::ranges::find(trials, row.integer(), &TrialRecord::id);
        AnswerInput taken;
        std::string kind, device, key, state;
        std::optional<int> character, button;
        std::optional<double> right_px, down_px, steps;
        row.read(taken.id, taken.item, kind, taken.input.at, taken.input.uncertainty, device, key, character,
                 right_px, down_px, button, steps, state, taken.has_counted, taken.number);
        taken.input.kind = read_name(kind, ObserverInput::Kind::key_down);
        taken.input.device = ShortName(device);
        taken.input.key = ShortName(key);
        taken.input.character = static_cast<char32_t>(character.value_or(0));
        taken.input.right_px = right_px.value_or(0.0);
        taken.input.down_px = down_px.value_or(0.0);
        taken.input.button = button.value_or(0);
        taken.input.steps = steps.value_or(0.0);
        taken.state = read_name(state, InputState::open);
        if (trial != trials.end())
            trial->outcome.inputs.push_back(std::move(taken));
    }
}

} // namespace

std::vector<const AttemptStep*> further_steps(const TrialRecord& trial) {
    constexpr std::string_view question[] = {"text", "drift_check", "show", "answer"};
    const std::vector<AttemptStep>& steps = trial.outcome.steps;
    const bool is_one_question =
        steps.size() <= std::size(question) &&
        std::ranges::equal(steps, std::span(question).first(steps.size()), {}, &AttemptStep::kind);
    std::vector<const AttemptStep*> further;
    for (const AttemptStep& step : steps) {
        const bool is_told = (step.kind == "show" && step.begin == trial.outcome.presentation_onset) ||
                             step.kind == "answer" ||
                             (step.kind == "text" && step.begin == trial.outcome.task_screen_onset) ||
                             (step.kind == "drift_check" && is_one_question);
        if (!is_told && step.begin)
            further.push_back(&step);
    }
    return further;
}

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
        fmt::format("SELECT trial_id, sitting, trial, attempt, task, {}, status, started_ns, "
                    "COALESCE(task_screen_onset_ns, -1), COALESCE(presentation_onset_ns, -1), "
                    "COALESCE(presentation_end_ns, -1), COALESCE(response_screen_onset_ns, -1), "
                    "COALESCE(responded_ns, -1), shown_refreshes, missed_refreshes, drift_deg, "
                    "answer, lost_flips, lost_samples, {} FROM trial ORDER BY trial_id",
                    stimulus_columns_of(database, "trial"),
                    tells_fates ? "failure, comes_again, trial_id IN (SELECT attempt_id FROM superseded)"
                                : "NULL, NULL, 0"),
        read_trial);
    add_response_boxes(database, trials);
    add_presses(database, trials);
    add_swap_modes(database, trials);
    add_response_keys(database, trials);
    add_gaze(database, trials);
    add_steps(database, trials);
    add_given_answers(database, trials);
    add_matches(database, trials);
    add_answer_inputs(database, trials);
    add_probes(database, trials);
    add_slots(database, trials);
    add_refreshes(database, trials);
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
