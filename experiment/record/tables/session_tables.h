/// What belongs to no trial as tables: events, stimuli, and the display box of each sitting.
#pragma once

#include <optional>

#include "experiment/record/read/pointed_answer.h"
#include "experiment/record/read/session_record.h"
#include "experiment/record/tables/shared_columns.h"

namespace overt {

RowLayout<RecordedEvent> events_layout();

/// `header` must outlive it.
RowLayout<RecordedStimulus> stimuli_layout(const SharedColumns& shared, const SessionHeader& header);

RowLayout<RecordedButton> buttons_layout();
RowLayout<RecordedKeyPress> key_presses_layout();
RowLayout<RecordedMarker> markers_layout();

/// A step of an attempt that ended.
struct StepRow {
    const TrialRecord& attempt;
    int number; ///< from 1
    const AttemptStep& step;
    operator const TrialRecord&() const { return attempt; }
};
RowLayout<StepRow> steps_layout(const SessionHeader& header);

/// An answer of an attempt that ended, given or missed.
struct GivenAnswerRow {
    const TrialRecord& attempt;
    const GivenAnswer& given;
    const PointedAnswer* pointed =
        nullptr; ///< of one that is a place, where one of the trial's images has it
    operator const TrialRecord&() const { return attempt; }
};
/// `header` must outlive it.
RowLayout<GivenAnswerRow> given_answers_layout(const SharedColumns& shared, const SessionHeader& header);

/// What the observer did while answers were asked, or before.
struct AnswerInputRow {
    const TrialRecord& attempt;
    int number; ///< from 1
    const AnswerInput& taken;
    operator const TrialRecord&() const { return attempt; }
};
RowLayout<AnswerInputRow> answer_inputs_layout();

struct DisplayBoxRow {
    int sitting;
    const RecordedBox& box;
    std::optional<BoxClockFit> clock; ///< nothing if its clock was never read
};
RowLayout<DisplayBoxRow> display_box_layout();

} // namespace overt
