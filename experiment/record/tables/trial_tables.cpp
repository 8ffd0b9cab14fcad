#include "experiment/record/tables/trial_tables.h"

#include <algorithm>
#include <sstream>
#include <string_view>

#include <fmt/format.h>

#include "experiment/record/read/trial_rows.h"
#include "experiment/record/tables/joined_cells.h"

namespace overt {
namespace {

/// An attempt that something ended has no times of what it did not get to.
void write_reached(TableCells& to, const TrialRecord& trial, SessionTime at) {
    trial.reached(at) ? to.seconds(at) : to.missing();
}

/// A column of the trials' table: how so many of a presentation's pictures came to the screen.
RowLayout<TrialRow>::Column swaps_column(const char* name, const char* meaning, int SwapModes::*count) {
    return {{name, meaning, "", {}}, [count](auto& to, auto& row) {
                const std::optional<SwapModes>& swaps = row.trial.outcome.swaps;
                swaps ? to.integer(*swaps.*count) : to.missing();
            }};
}

} // namespace

RowLayout<TrialRow> trials_layout(const SharedColumns& shared, const SessionHeader& header) {
    return {
        "trials",
        "One row for each attempt at a trial, in the order in which they were made.",
        {
            {shared.trial, [](auto& to, auto& row) { to.integer(row.trial.trial.index + 1); }},
            {{"attempt", "Which attempt at this trial, from 1: a trial that was cut off is repeated", "", {}},
             [](auto& to, auto& row) { to.integer(row.trial.attempt); }},
            {{"sitting", "Counts how often the session was begun or resumed, from 1", "", {}},
             [](auto& to, auto& row) { to.integer(row.trial.sitting); }},
            {{"block", "The block that the trial is of, where the protocol has blocks", "", {}},
             [&header](auto& to, auto& row) {
                 const std::string* const block = item_of(header.blocks, row.trial.trial.block);
                 block ? to.text(*block) : to.missing();
             }},
            {shared.task,
             [&header](auto& to, auto& row) { to.text(item(header.tasks, row.trial.trial.task).id); }},
            {shared.sculpture,
             [&header](auto& to, auto& row) {
                 to.text(item(header.sculptures, row.trial.trial.condition.sculpture).id);
             }},
            {shared.material,
             [&header](auto& to, auto& row) {
                 to.text(item(header.materials, row.trial.trial.condition.material).id);
             }},
            {{"status",
              "How the attempt ended",
              "",
              {{"completed", "all of it was done"},
               {"aborted",
                "broken off by the operator, or because a device went away; or failed, and to come again"},
               {"interrupted", "cut off when the program was killed, as was found when the session went on"},
               {"open", "running when the session was exported, or cut off when the program was killed"}}},
             [](auto& to, auto& row) { to.word(name_of(row.trial.status)); }},
            {{"counts",
              "Whether this is the attempt that counts; only such ones appear in the other tables",
              "",
              {{"yes", "completed"},
               {"no", "not completed, or its block was begun again later: the attempt there counts"}}},
             [](auto& to, auto& row) { to.word(row.trial.counts ? "yes" : "no"); }},
            {{"failure",
              "What spoke against the attempt: missed refreshes, gaze lost, rejected, repeated or skipped; "
              "n/a: nothing",
              "",
              {}},
             [](auto& to, auto& row) {
                 row.trial.has_outcome() ? to.text(row.trial.outcome.failure) : to.missing();
             }},
            {{"comes_again",
              "Whether the trial was to be attempted again because of that; n/a: the session ended in it",
              "",
              {{"never", "it was not"},
               {"now", "right afterwards"},
               {"end-of-block", "after the other trials of its block"}}},
             [](auto& to, auto& row) {
                 const std::string_view afterwards =
                     row.trial.has_outcome() ? name_of(row.trial.outcome.afterwards) : "";
                 afterwards.empty() ? to.missing() : to.word(afterwards);
             }},
            {session_seconds("started_s", "Begin of the trial"),
             [](auto& to, auto& row) { to.seconds(row.trial.started); }},
            {session_seconds("task_screen_onset_s", "Onset of the question"),
             [](auto& to, auto& row) { write_reached(to, row.trial, row.trial.outcome.task_screen_onset); }},
            {session_seconds("presentation_onset_s", "Vertical blank of the presentation's first refresh"),
             [](auto& to, auto& row) { write_reached(to, row.trial, row.trial.outcome.presentation_onset); }},
            {session_seconds("presentation_end_s", "Vertical blank at which the presentation gave way"),
             [](auto& to, auto& row) { write_reached(to, row.trial, row.trial.outcome.presentation_end); }},
            {session_seconds("response_screen_onset_s", "Onset of the response screen"),
             [](auto& to, auto& row) {
                 write_reached(to, row.trial, row.trial.outcome.response_screen_onset);
             }},
            {session_seconds("responded_s", "End of the answer"),
             [](auto& to, auto& row) { write_reached(to, row.trial, row.trial.outcome.responded_at); }},
            {{"shown_refreshes", "Refreshes in the flip ledger", "", {}},
             [](auto& to, auto& row) {
                 row.trial.has_outcome() ? to.integer(row.trial.outcome.shown_refreshes) : to.missing();
             }},
            {{"timing",
              "What proves the times of flips, and with them missed refreshes; n/a: not recorded",
              "",
              {{"proven", "real vertical blanks of the display"},
               {"unproven", "nothing: which refreshes were missed is not known"},
               {"none", "time was virtual, or there was no display"}}},
             [&header](auto& to, auto&) {
                 header.display.timing.empty() ? to.missing() : to.word(header.display.timing);
             }},
            {{"missed_refreshes",
              "Refreshes that went by with an old picture; n/a also where timing is unproven",
              "",
              {}},
             [&header](auto& to, auto& row) {
                 row.trial.has_outcome() && !header.display.is_timing_unproven()
                     ? to.integer(row.trial.outcome.missed_refreshes)
                     : to.missing();
             }},
            swaps_column(
                "swaps_flipped",
                "Pictures of the presentation, and the dark screen after it, whose memory was scanned "
                "out itself, by the X server's word; n/a: no such server. 0 in all four columns: the "
                "driver does not show pictures through the server, which cannot tell then",
                &SwapModes::flipped),
            swaps_column(
                "swaps_copied",
                "Likewise, those copied into what is scanned out: when they were lit, and whether in "
                "one piece, is not proved by a vertical blank",
                &SwapModes::copied),
            swaps_column("swaps_suboptimal_copied",
                         "Likewise, copied although other buffers could have been flipped to",
                         &SwapModes::suboptimal_copied),
            swaps_column("swaps_skipped", "Likewise, replaced by the next before they were shown",
                         &SwapModes::skipped),
            {{"drift_deg", "Gaze error at the drift check", "deg", {}},
             [](auto& to, auto& row) {
                 const auto& drift = row.trial.outcome.drift;
                 row.trial.has_outcome() && drift ? to.fixed(drift->value, angle_decimals) : to.missing();
             }},
            {{"lost_flips", "Flips that could not be recorded", "", {}},
             [](auto& to, auto& row) {
                 row.trial.has_outcome() ? to.integer(row.trial.lost_flips) : to.missing();
             }},
            {{"lost_samples", "Gaze samples that could not be recorded", "", {}},
             [](auto& to, auto& row) {
                 row.trial.has_outcome() ? to.integer(row.trial.lost_samples) : to.missing();
             }},
            {{"samples", "Gaze samples recorded", "", {}},
             [](auto& to, auto& row) { row.samples ? to.integer(row.samples->samples) : to.missing(); }},
            {{"samples_without_gaze", "Samples in which the tracker found no eye", "", {}},
             [](auto& to, auto& row) { row.samples ? to.integer(row.samples->without_gaze) : to.missing(); }},
            {{"samples_on_object", "Samples that met the sculpture's surface", "", {}},
             [](auto& to, auto& row) { row.samples ? to.integer(row.samples->on_object) : to.missing(); }},
            {{"samples_off_plan",
              "Samples that the planned frame times would have put on a frame that was not lit",
              "",
              {}},
             [](auto& to, auto& row) { row.samples ? to.integer(row.samples->off_plan) : to.missing(); }},
        }};
}

TrialWords trial_words(const SessionRecord& record) {
    constexpr std::string_view beginning = "TRIALID";
    TrialWords words;
    for (const TrialRecord& trial : record.trials()) {
        if (!record.gaze_source(trial.sitting))
            continue;
        record.read_gaze_events(trial, [&](const GazeEvent& event) {
            if (event.kind != GazeEvent::Kind::message || !event.text.starts_with(beginning))
                return;
            std::vector<std::string>& of_trial = words[trial.id];
            of_trial.clear();
            std::istringstream text(event.text.substr(beginning.size()));
            for (std::string word; text >> word;)
                of_trial.push_back(word);
        });
    }
    return words;
}

std::vector<RowLayout<TrialRow>::Column> trial_word_columns(const TrialWords& words) {
    std::size_t most = 0;
    for (const auto& [id, of_trial] : words)
        most = std::max(most, of_trial.size());
    std::vector<RowLayout<TrialRow>::Column> columns;
    for (std::size_t n = 0; n < most; ++n)
        columns.push_back(
            {{fmt::format("trialid_{}", n + 1),
              fmt::format("Word {} after TRIALID in the trial's message of the imported recording", n + 1),
              "",
              {}},
             [&words, n](auto& to, auto& row) {
                 const auto found = words.find(row.trial.id);
                 found != words.end() && n < found->second.size() ? to.text(found->second[n]) : to.missing();
             }});
    return columns;
}

RowLayout<TrialRecord> responses_layout(const SharedColumns& shared, const SessionHeader& header) {
    return {
        "responses",
        "One row for the answer in each completed trial.",
        {
            {shared.trial, [](auto& to, auto& row) { to.integer(row.trial.index + 1); }},
            {shared.task, [&header](auto& to, auto& row) { to.text(item(header.tasks, row.trial.task).id); }},
            {shared.sculpture,
             [&header](auto& to, auto& row) {
                 to.text(item(header.sculptures, row.trial.condition.sculpture).id);
             }},
            {shared.material,
             [&header](auto& to, auto& row) {
                 to.text(item(header.materials, row.trial.condition.material).id);
             }},
            {{"question", "The question as it was shown", "", {}},
             [&header](auto& to, auto& row) { to.text(item(header.tasks, row.trial.task).question); }},
            {session_seconds("response_screen_onset_s", "Onset of the response screen"),
             [](auto& to, auto& row) { write_reached(to, row, row.outcome.response_screen_onset); }},
            {session_seconds("responded_s", "End of the answer"),
             [](auto& to, auto& row) { write_reached(to, row, row.outcome.responded_at); }},
            {{"response_time_s", "From the onset of the response screen to the end of the answer", "s", {}},
             [](auto& to, auto& row) {
                 const TrialOutcome& outcome = row.outcome;
                 row.reached(outcome.responded_at) && row.reached(outcome.response_screen_onset)
                     ? to.seconds(outcome.responded_at - outcome.response_screen_onset)
                     : to.missing();
             }},
            {{"answer", "The answer, where the response panel took it down", "", {}},
             [](auto& to, auto& row) { to.text(row.outcome.answer); }},
            {{"response_box", "The response box at which it was answered; n/a of a keyboard", "", {}},
             [](auto& to, auto& row) {
                 row.response_box.empty() ? to.missing() : to.text(row.response_box);
             }},
            {{"response_uncertainty_s",
              "So far at most responded_s is off: by the clock of a response box, or the time since a "
              "keyboard was "
              "looked at before; n/a of simulated observers",
              "s",
              {}},
             [](auto& to, auto& row) {
                 row.response_uncertainty ? to.seconds(*row.response_uncertainty) : to.missing();
             }},
        }};
}

} // namespace overt
