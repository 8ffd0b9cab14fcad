#include "experiment/record/tables/gaze_event_rows.h"

#include "experiment/record/tables/joined_cells.h"

namespace overt {
namespace {

class GazeEventRows {
  public:
    GazeEventRows(TableWriter& writer, const SessionRecord& record, int sitting)
        : row_(writer), clock_map_(record.clock_map(sitting)) {}

    /// `trial`: from 1; 0: outside of trials.
    void write(const GazeEvent& event, int trial) {
        trial > 0 ? row_.integer(trial) : row_.missing();
        row_.word(name_of(event.kind));
        event.eye ? row_.word(*event.eye == Eye::left ? "left" : "right") : row_.missing();
        session_time(event.start);
        session_time(event.end);
        is_eye_event(event.kind) ? row_.seconds(SessionDuration(event.duration)) : row_.missing();
        row_.integer(event.start.time_since_epoch().count()).integer(event.end.time_since_epoch().count());
        place(event.place);
        place(event.arrival);
        number(event.pupil, pupil_decimals);
        number(event.amplitude_deg, pixel_decimals);
        number(event.peak_velocity_deg_s, pixel_decimals);
        row_.text(event.text).end_row();
    }

  private:
    void session_time(TrackerTime time) {
        clock_map_ ? row_.seconds(clock_map_->to_session(time).time) : row_.missing();
    }
    void place(const std::optional<ScreenPoint>& place) {
        place ? row_.fixed(place->x_px, pixel_decimals).fixed(place->y_px, pixel_decimals) : row_.missing(2);
    }
    void number(const std::optional<double>& value, int decimals) {
        value ? row_.fixed(*value, decimals) : row_.missing();
    }

    TableWriter& row_;
    std::optional<ClockMap> clock_map_;
};

} // namespace

Table gaze_events_table() {
    return {
        "gaze_events",
        "What the eye tracker itself said besides samples, in the completed trials and outside of trials; "
        "only of gaze that was imported from the tracker's file.",
        {{"trial", "Position of the trial in the observer's order, from 1; n/a outside of trials", "", {}},
         {"kind",
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
         {"eye", "Which eye", "", {{"left", "left eye"}, {"right", "right eye"}}},
         {"start_s", "When it began; session clock, nine decimals keep each nanosecond", "s", {}},
         {"end_s", "When its last sample was taken; of what does not last, start_s", "s", {}},
         {"duration_s", "From its begin to the end of its last sample, as the tracker gives it", "s", {}},
         {"tracker_start_us", "start_s by the tracker's own clock", "us", {}},
         {"tracker_end_us", "end_s by the tracker's own clock", "us", {}},
         {"x_px", "Mean place of a fixation, start of a saccade, to the right", "px", {}},
         {"y_px", "The same, downwards", "px", {}},
         {"end_x_px", "End of a saccade, to the right", "px", {}},
         {"end_y_px", "The same, downwards", "px", {}},
         {"pupil", "Mean pupil size of a fixation", "the tracker's own unit", {}},
         {"amplitude_deg", "Size of a saccade", "deg", {}},
         {"peak_velocity_deg_s", "Peak velocity of a saccade", "deg/s", {}},
         {"text", "Words and numbers of what is no fixation, saccade or blink", "", {}}}};
}

void write_gaze_events(TableWriter& writer, const SessionRecord& record, const TrialRecord& trial) {
    GazeEventRows rows(writer, record, trial.sitting);
    record.read_gaze_events(trial, [&](const GazeEvent& event) { rows.write(event, trial.trial.index + 1); });
}

void write_gaze_events_outside(TableWriter& writer, const SessionRecord& record) {
    // They are of the sitting whose gaze was imported.
    int sitting = 1;
    for (const TrialRecord& trial : record.trials())
        if (record.gaze_source(trial.sitting))
            sitting = trial.sitting;
    GazeEventRows rows(writer, record, sitting);
    record.read_gaze_events_outside([&](const GazeEvent& event) { rows.write(event, 0); });
}

} // namespace overt
