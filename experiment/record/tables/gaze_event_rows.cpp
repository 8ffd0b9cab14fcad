#include "experiment/record/tables/gaze_event_rows.h"

#include "experiment/record/tables/joined_cells.h"
#include "experiment/record/tables/shared_columns.h"

namespace overt {
namespace {

/// By the session's clock.
auto session_time_of(TrackerTime GazeEvent::*at) {
    return [at](const GazeEventRow& row) {
        return of_maybe(row.clock_map, [&](auto& map) { return map.to_session(row.event.*at).time; });
    };
}
auto tracker_us_of(TrackerTime GazeEvent::*at) {
    return [at](const GazeEventRow& row) { return microseconds_of(row.event.*at); };
}

std::string_view detector_of(const GazeEventRow& row) {
    using From = SessionRecord::EventOrigin::From;
    return !is_eye_event(row.event.kind)   ? ""
           : row.origin == From::recording ? "overt"
           : row.origin == From::reading   ? "overt at export"
                                           : "tracker";
}

} // namespace

std::vector<RowLayout<TrackerEventRow>::Column>
event_value_columns(const std::string& pixels, const std::string& of_pupil, const std::string& pupil) {
    using Place = std::optional<ScreenPoint> GazeEvent::*;
    using Number = std::optional<double> GazeEvent::*;
    const auto coordinate = [](Place place, double ScreenPoint::*axis) {
        return [=](const TrackerEventRow& row) {
            return of_maybe(row.event.*place, [axis](auto& point) {
                return Fixed{point.*axis, pixel_decimals};
            });
        };
    };
    const auto number = [](Number value, int decimals) {
        return [=](const TrackerEventRow& row) { return Fixed{row.event.*value, decimals}; };
    };
    return {
        {{"x_px", "Mean place of a fixation, start of a saccade, to the right", pixels},
         coordinate(&GazeEvent::place, &ScreenPoint::x_px)},
        {{"y_px", "The same, downwards", pixels}, coordinate(&GazeEvent::place, &ScreenPoint::y_px)},
        {{"end_x_px", "End of a saccade, to the right", pixels},
         coordinate(&GazeEvent::arrival, &ScreenPoint::x_px)},
        {{"end_y_px", "The same, downwards", pixels}, coordinate(&GazeEvent::arrival, &ScreenPoint::y_px)},
        {{"pupil", "Mean pupil size of a fixation" + (pupil.empty() ? pupil : ". " + pupil), of_pupil},
         number(&GazeEvent::pupil, pupil_decimals)},
        {{"amplitude_deg", "Size of a saccade", "deg"}, number(&GazeEvent::amplitude_deg, pixel_decimals)},
        {{"peak_velocity_deg_s", "Peak velocity of a saccade", "deg/s"},
         number(&GazeEvent::peak_velocity_deg_s, pixel_decimals)},
    };
}

RowLayout<GazeEventRow> gaze_events_layout(const std::string& origins, const std::string& pupil) {
    RowLayout<GazeEventRow> layout{
        "gaze_events",
        "Fixations, saccades and blinks in the completed trials, and what the tracker's file said besides "
        "them, "
        "where gaze was imported from one. " +
            origins,
        {
            {{"trial", "Position of the trial in the observer's order, from 1; n/a outside of trials"},
             [](auto& row) { return when(row.trial > 0, row.trial); }},
            {{"kind",
              "What it was",
              "",
              {{"fixation", "the eye rested"},
               {"saccade", "the eye jumped"},
               {"blink", "there was no pupil"},
               {"message", "a message to the tracker, or by it"},
               {"button", "a button of the tracker's own box: number and state"},
               {"input", "the tracker's own input port: value"},
               {"started", "a recording began: its eyes"},
               {"ended", "a recording ended: pixels per degree, to the right and downwards"},
               {"note", "a line without a time, which stands after the line of that time"}}},
             [](auto& row) { return name_of(row.event.kind); }},
            {{"detector",
              "Who found a fixation, saccade or blink; n/a of all else",
              "",
              {{"tracker", "the eye tracker itself"},
               {"overt", "the program, while it recorded the session"},
               {"overt at export", "the program, from the recorded samples"}}},
             detector_of},
            {eye_column(), [](auto& row) { return of_maybe(row.event.eye, word_of_eye); }},
            {{"start_s", "When it began; session clock, nine decimals keep each nanosecond", "s"},
             session_time_of(&GazeEvent::start)},
            {{"end_s", "When its last sample was taken; of what does not last, start_s", "s"},
             session_time_of(&GazeEvent::end)},
            {{"duration_s", "From its begin to the end of its last sample, as its detector gives it", "s"},
             [](auto& row) {
                 return when(is_eye_event(row.event.kind), SessionDuration(row.event.duration));
             }},
            {{"tracker_start_us", "start_s by the tracker's own clock", "us"},
             tracker_us_of(&GazeEvent::start)},
            {{"tracker_end_us", "end_s by the tracker's own clock", "us"}, tracker_us_of(&GazeEvent::end)},
        }};
    layout.add<TrackerEventRow>(event_value_columns("px", "the tracker's own unit", pupil));
    layout.add<GazeEventRow>({
        {{"text", "Words and numbers of what is no fixation, saccade or blink"},
         [](auto& row) { return row.event.text; }},
    });
    return layout;
}

void write_gaze_events(TableWriter& writer, const RowLayout<GazeEventRow>& layout,
                       const SessionRecord& record, const TrialRecord& trial) {
    const std::optional<ClockMap> clock_map = record.clock_map(trial);
    const SessionRecord::EventOrigin::From origin = record.event_origin(trial.sitting).from;
    record.read_gaze_events(trial, [&](const GazeEvent& event) {
        layout.write(writer, {{event}, trial.trial.index + 1, clock_map, origin});
    });
}

void write_gaze_events_outside(TableWriter& writer, const RowLayout<GazeEventRow>& layout,
                               const SessionRecord& record) {
    // They are of the sitting whose gaze was imported.
    int sitting = 1;
    for (const TrialRecord& trial : record.trials())
        if (record.gaze_source(trial.sitting))
            sitting = trial.sitting;
    const std::optional<ClockMap> clock_map = record.clock_map(sitting);
    record.read_gaze_events_outside([&](const GazeEvent& event) {
        layout.write(writer, {{event}, 0, clock_map, SessionRecord::EventOrigin::From::tracker});
    });
}

} // namespace overt
