#include "experiment/record/tables/trial_tables.h"

#include <algorithm>
#include <functional>
#include <string_view>

#include <fmt/format.h>

#include "experiment/record/read/trial_rows.h"
#include "experiment/record/tables/attempt_cells.h"

namespace overt {
namespace {

/// A time of an attempt: one that something ended has none of what it did not get to.
auto time_of(SessionTime TrialOutcome::*at) {
    return [at](const TrialRecord& attempt) {
        return when(attempt.reached(attempt.outcome.*at), attempt.outcome.*at);
    };
}

/// What an attempt has once it ended, in order or not.
auto once_ended(auto of) {
    return [of](const TrialRecord& attempt) { return when(attempt.has_outcome(), std::invoke(of, attempt)); };
}

/// How so many of a presentation's pictures came to the screen.
auto swaps_of(int SwapModes::*count) {
    return [count](const TrialRecord& attempt) { return of_maybe(attempt.outcome.swaps, count); };
}

/// `header` must outlive it.
auto gaze_share_of(const SessionHeader& header) {
    return [&header](const TrialRow& row) -> std::optional<Fixed> {
        constexpr int decimals = 4;
        if (const std::optional<GazeYield>& gaze = row.trial.outcome.gaze)
            return Fixed{gaze->share(), decimals};
        if (!row.samples || header.tracker.sample_rate_hz <= 0.0)
            return std::nullopt;
        return Fixed{GazeYield{row.samples->samples, row.samples->without_gaze, 0}.share(), decimals};
    };
}

auto samples_of(std::int64_t SampleCounts::*count) {
    return [count](const TrialRow& row) { return of_maybe(row.samples, count); };
}

} // namespace

namespace {

std::vector<RowLayout<TrialRow>::Column> attempt_columns(const SharedColumns& shared,
                                                         const SessionHeader& header) {
    std::vector<RowLayout<TrialRow>::Column> columns{
        {shared.trial, number_of_trial},
        {{"attempt", "Which attempt at this trial, from 1: a trial that was cut off is repeated"},
         attempt_number},
        {{"sitting", "Counts how often the session was begun or resumed, from 1"},
         [](const TrialRecord& attempt) { return attempt.sitting; }},
        {{"block", "The block that the trial is of, where the protocol has blocks"}, block_of(header)},
        {shared.task, task_of(header)},
    };
    for (auto& column : shared.of_stimulus<TrialRow>(shown_in))
        columns.push_back(std::move(column));
    for (auto& column : own_columns<RowLayout<TrialRow>::Column>(header))
        columns.push_back(std::move(column));
    std::vector<RowLayout<TrialRow>::Column> further{
        {{"status",
          "How the attempt ended",
          "",
          {{"completed", "all of it was done"},
           {"aborted",
            "broken off by the operator, or because a device went away; or failed, and to come again"},
           {"interrupted", "cut off when the program was killed, as was found when the session went on"},
           {"open", "running when the session was exported, or cut off when the program was killed"}}},
         attempt_status},
        {{"counts",
          "Whether this is the attempt that counts; only such ones appear in the other tables",
          "",
          {{"yes", "completed"},
           {"no", "not completed, or its block was begun again later: the attempt there counts"}}},
         attempt_counts},
        {{"failure",
          "What spoke against the attempt: missed refreshes; gaze lost (of one that counts: hardly any "
          "gaze "
          "came, or more was lost than the protocol repeats for); eye tracker lost; eye tracker's clock "
          "jumped; by the operator rejected, repeated, skipped, or broken off; n/a: nothing"},
         once_ended([](const TrialRecord& attempt) { return attempt.outcome.failure; })},
        {{"comes_again",
          "Whether the trial was to be attempted again because of that; n/a: the session ended in it",
          "",
          {{"never", "it was not"},
           {"now", "right afterwards"},
           {"end-of-block", "after the other trials of its block"}}},
         once_ended([](const TrialRecord& attempt) { return name_of(attempt.outcome.afterwards); })},
        {session_seconds("started_s", "Begin of the trial"),
         [](const TrialRecord& attempt) { return attempt.started; }},
        {session_seconds("task_screen_onset_s", "Onset of the question"),
         time_of(&TrialOutcome::task_screen_onset)},
        {session_seconds("presentation_onset_s", "Vertical blank of the presentation's first refresh"),
         time_of(&TrialOutcome::presentation_onset)},
        {session_seconds("presentation_end_s", "Vertical blank at which the presentation gave way"),
         time_of(&TrialOutcome::presentation_end)},
        {session_seconds("response_screen_onset_s", "Onset of the response screen"),
         time_of(&TrialOutcome::response_screen_onset)},
        {session_seconds("responded_s", "End of the answer"), time_of(&TrialOutcome::responded_at)},
        {{"shown_refreshes", "Refreshes in the flip ledger"},
         once_ended([](const TrialRecord& attempt) { return attempt.outcome.shown_refreshes; })},
        {timing_column(), timing_of(header)},
        {{"missed_refreshes",
          "Refreshes that went by with an old picture; n/a also where timing is unproven"},
         missed_refreshes_of(header)},
        {{"swaps_flipped",
          "Pictures of the presentation, and the dark screen after it, whose memory was scanned "
          "out itself, by the X server's word; n/a: no such server. 0 in all four columns: the "
          "driver does not show pictures through the server, which cannot tell then"},
         swaps_of(&SwapModes::flipped)},
        {{"swaps_copied",
          "Likewise, those copied into what is scanned out: when they were lit, and whether in "
          "one piece, is not proved by a vertical blank"},
         swaps_of(&SwapModes::copied)},
        {{"swaps_suboptimal_copied", "Likewise, copied although other buffers could have been flipped to"},
         swaps_of(&SwapModes::suboptimal_copied)},
        {{"swaps_skipped", "Likewise, replaced by the next before they were shown"},
         swaps_of(&SwapModes::skipped)},
        {{"drift_deg", "Gaze error at the drift check", "deg"}, attempt_drift},
        {{"lost_flips", "Flips that could not be recorded"}, once_ended(&TrialRecord::lost_flips)},
        {{"lost_samples", "Gaze samples that could not be recorded"}, once_ended(&TrialRecord::lost_samples)},
        {{"samples", "Gaze samples recorded"}, samples_of(&SampleCounts::samples)},
        {{"samples_without_gaze", "Samples in which the tracker found no eye"},
         samples_of(&SampleCounts::without_gaze)},
        {{"samples_on_object", "Samples that met the object's surface"},
         samples_of(&SampleCounts::on_object)},
        {{"samples_off_plan",
          "Samples that the planned frame times would have put on a frame that was not lit"},
         samples_of(&SampleCounts::off_plan)},
        {{"gaze_share", "Share with gaze of the samples that the tracker should have given in the "
                        "recording, those that never "
                        "came included; of imported recordings, and of sessions of earlier programs, of "
                        "those that came; "
                        "0: none, n/a: not known, or the tracker measures no gaze"},
         gaze_share_of(header)},
    };
    for (auto& column : further)
        columns.push_back(std::move(column));
    return columns;
}

} // namespace

RowLayout<TrialRow> trials_layout(const SharedColumns& shared, const SessionHeader& header) {
    return {"trials",
            shared.has_slots
                ? "One row for each attempt at a trial, in the order in which they were made, with what "
                  "its first slot showed; the others are in presentations."
                : "One row for each attempt at a trial, in the order in which they were made.",
            attempt_columns(shared, header)};
}

RowLayout<TrialRow> presentations_layout(const SharedColumns& shared, const SessionHeader& header) {
    RowLayout<TrialRow> layout{"presentations",
                               "One row for each stimulus that a completed trial showed in a slot, with what "
                               "trials has of the trial; samples_on_object are those on this stimulus.",
                               attempt_columns(shared, header)};
    layout.add<TrialRow>({{shared.slot, [&header](const TrialRow& row) {
                               return item(header.slots, row.trial.trial.slot).id;
                           }}});
    return layout;
}

RowLayout<TrialRecord> responses_layout(const SharedColumns& shared, const SessionHeader& header) {
    RowLayout<TrialRecord> layout{"responses",
                                  "One row for the answer in each completed trial.",
                                  {{shared.trial, number_of_trial}, {shared.task, task_of(header)}}};
    layout.add<TrialRecord>(shared.of_stimulus<TrialRecord>(shown_in));
    layout.add<TrialRecord>({
        {{"question", "The question as it was shown"}, question_of(header)},
        {session_seconds("response_screen_onset_s", "Onset of the response screen"),
         time_of(&TrialOutcome::response_screen_onset)},
        {session_seconds("responded_s", "End of the answer"), time_of(&TrialOutcome::responded_at)},
        {{"response_time_s", "From the onset of the response screen to the end of the answer", "s"},
         [](const TrialRecord& attempt) {
             const TrialOutcome& outcome = attempt.outcome;
             return when(attempt.reached(outcome.responded_at) &&
                             attempt.reached(outcome.response_screen_onset),
                         outcome.responded_at - outcome.response_screen_onset);
         }},
        {{"answer", "The answer, where the response panel took it down"},
         [](const TrialRecord& attempt) { return attempt.outcome.answer; }},
        {{"response_key", "Name of the key or button that ended the response screen, as in "
                          "key_presses; n/a: time ended it, "
                          "or nobody wrote it down"},
         &TrialRecord::response_key},
        {{"response_box", "The response box at which it was answered; n/a of a keyboard"},
         &TrialRecord::response_box},
        {{"response_uncertainty_s",
          "So far at most responded_s is off: by the clock of a response box, or the time since a "
          "keyboard was "
          "looked at before; n/a of simulated observers",
          "s"},
         &TrialRecord::response_uncertainty},
    });
    return layout;
}

} // namespace overt
