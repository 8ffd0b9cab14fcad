/// What each attempt's trial did, step by step, as a table.
#include "experiment/record/tables/attempt_cells.h"
#include "experiment/record/tables/session_tables.h"

namespace overt {

namespace {

/// Of a time that a step may lack.
auto time_of_step(std::optional<SessionTime> AttemptStep::*at) {
    return [at](const StepRow& row) { return row.step.*at; };
}

std::string slots_of(const SessionHeader& header, const StepRow& row) {
    std::string ids;
    const Trial& trial = row.attempt.trial;
    for (int place = 0; place < static_cast<int>(trial.shown_count()); ++place)
        if (row.step.lights(place))
            ids += (ids.empty() ? "" : " ") +
                   item(header.slots, trial.shown(static_cast<std::size_t>(place)).slot).id;
    return ids;
}

} // namespace

RowLayout<StepRow> steps_layout(const SessionHeader& header) {
    return {
        "steps",
        "What each attempt that ended did, step by step.",
        {
            {{"trial", "Position of the trial in the observer's order, from 1"}, number_of_trial},
            {{"attempt", "Which attempt at this trial, from 1"}, attempt_number},
            {{"counts", "Whether this is the attempt that counts"}, attempt_counts},
            {{"step", "Position of the step, from 1; one that began anew has a row for each time"},
             &StepRow::number},
            {{"kind",
              "What it shows",
              "",
              {{"text", "words"},
               {"fixation", "a target to be looked at"},
               {"show", "the stimulus"},
               {"blank", "the background"},
               {"mask", "noise where the stimulus stands"},
               {"answer", "the screen of the answer"},
               {"feedback", "words by what was answered"},
               {"drift_check", "the target by which the tracker's drift is measured"}}},
             [](auto& row) { return row.step.kind; }},
            {{"id", "As the protocol calls it; empty: it gives no name"},
             [](auto& row) { return row.step.id; }},
            {{"slots", "Of a step show, the slots in which it showed something, a space between them"},
             [&header](auto& row) { return slots_of(header, row); }},
            {session_seconds("begin_s", "When what it shows was lit"), time_of_step(&AttemptStep::begin)},
            {session_seconds("end_s", "When something else was lit"), time_of_step(&AttemptStep::end)},
            {{"drawn_s", "How long it was to last, as drawn or as written; n/a: no time ends it", "s"},
             [](auto& row) {
                 return Fixed{row.step.drawn_s, 6};
             }},
            {{"planned_refreshes", "The same in refreshes of the display"},
             [](auto& row) { return row.step.planned_refreshes; }},
            {{"ended_by",
              "Why it ended",
              "",
              {{"time", "its time was over"},
               {"key", "the observer pressed a key"},
               {"answer", "the answer was given"},
               {"gaze", "gaze came to where it was waited for"},
               {"patience", "gaze did not come in time"},
               {"done", "the drift check was made"},
               {"stopped", "by the operator, the eye tracker or the display"}}},
             [](auto& row) { return of_maybe(row.step.ended_by, [](StepEnd end) { return name_of(end); }); }},
            {{"gaze_onset_us", "First sample of the gaze that ended it, by the tracker's clock", "us"},
             [](auto& row) { return of_maybe(row.step.gaze_onset, microseconds_of); }},
            {{"gaze_detected_us", "The sample by which gaze had been there long enough", "us"},
             [](auto& row) { return of_maybe(row.step.gaze_detected, microseconds_of); }},
        }};
}

} // namespace overt
