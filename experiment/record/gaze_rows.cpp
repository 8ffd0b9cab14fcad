#include "experiment/record/gaze_rows.h"

#include "experiment/base/number_text.h"
#include "experiment/record/session_schema.h"
#include "experiment/record/sql.h"

namespace overt {
namespace {

using Pixels = std::optional<double>;

Pixels x_of(const std::optional<ScreenPoint>& place) { return place ? Pixels(place->x_px) : std::nullopt; }
Pixels y_of(const std::optional<ScreenPoint>& place) { return place ? Pixels(place->y_px) : std::nullopt; }

std::optional<ScreenPoint> read_place(Query& row) {
    const Pixels x_px = row.optional_real(), y_px = row.optional_real();
    return x_px && y_px ? std::optional(ScreenPoint{*x_px, *y_px}) : std::nullopt;
}

GazeEvent read_event(Query& row) {
    GazeEvent event;
    event.kind = gaze_event_kind(row.text()).value_or(GazeEvent::Kind::note);
    if (const std::optional<int> eye = row.optional_small())
        event.eye = *eye == 0 ? Eye::left : Eye::right;
    row.read(event.start, event.end);
    event.duration = row.tracker_time().time_since_epoch();
    event.place = read_place(row);
    event.arrival = read_place(row);
    row.read(event.pupil, event.amplitude_deg, event.peak_velocity_deg_s, event.text);
    return event;
}

SQLite::Database& with_tables(SQLite::Database& database) {
    database.exec(gaze_tables_sql);
    return database;
}

} // namespace

GazeRows::GazeRows(SQLite::Database& database)
    : database_(with_tables(database)), insert_sample_(database, "INSERT INTO sample VALUES (?,?,?,?,?,?,?)"),
      insert_event_(database, "INSERT INTO gaze_event VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)"),
      insert_detail_(database, "INSERT INTO sample_detail VALUES (?,?,?,?,?,?,?,?)") {}

void GazeRows::begin_trial(std::int64_t trial_id) {
    trial_id_ = trial_id;
    samples_ = events_ = details_ = 0;
}

void GazeRows::sample(const GazeSample& sample) {
    run_statement(insert_sample_, trial_id_, samples_++, sample.sampled_at, static_cast<int>(sample.eye),
                  x_of(sample.gaze), y_of(sample.gaze), shortest_decimal(sample.pupil_area));
}

void GazeRows::event(const GazeEvent& event) {
    std::int64_t& count = trial_id_ == 0 ? outside_events_ : events_;
    run_statement(insert_event_, trial_id_, count++, name_of(event.kind),
                  event.eye ? std::optional(static_cast<int>(*event.eye)) : std::nullopt, event.start,
                  event.end, event.duration, x_of(event.place), y_of(event.place), x_of(event.arrival),
                  y_of(event.arrival), event.pupil, event.amplitude_deg, event.peak_velocity_deg_s,
                  event.text);
}

void GazeRows::detail(const SampleDetail& detail) {
    const auto mm = [&](int axis) {
        return detail.eye_mm ? Pixels(shortest_decimal((*detail.eye_mm)[axis])) : std::nullopt;
    };
    run_statement(insert_detail_, trial_id_, details_++, detail.sampled_at, static_cast<int>(detail.eye),
                  detail.confidence ? Pixels(shortest_decimal(*detail.confidence)) : std::nullopt, mm(0),
                  mm(1), mm(2));
}

void GazeRows::calibration(int sitting, const RecordedCalibration& calibration) {
    const ValidationResult& found = calibration.validation;
    insert_values(
        database_, "INTO calibration (sitting, at_ns, trial, method, mean_deg, max_deg, within_limits)",
        sitting, calibration.at, calibration.trial < 0 ? std::nullopt : std::optional(calibration.trial),
        calibration.method, found.mean_error, found.max_error, calibration.is_within_limits);
    const std::int64_t id = database_.getLastInsertRowid();
    for (const ValidatedTarget& target : found.targets)
        insert_values(database_,
                      "INTO validated_target (sitting, calibration, eye, x_px, y_px, gaze_x_px, gaze_y_px, "
                      "error_deg, rms_s2s_deg, sd_deg)",
                      sitting, id, static_cast<int>(target.eye), target.target.x_px, target.target.y_px,
                      x_of(target.gaze), y_of(target.gaze),
                      target.gaze ? std::optional(target.error) : std::nullopt, target.rms_s2s, target.sd);
}

std::vector<RecordedCalibration> read_calibrations(const SQLite::Database& database, int sitting) {
    std::vector<RecordedCalibration> all;
    Query row(database, "SELECT id, at_ns, trial, method, mean_deg, max_deg, within_limits FROM calibration "
                        "WHERE sitting = ? ORDER BY id");
    row.bind(1, sitting);
    while (row.step()) {
        RecordedCalibration calibration;
        std::int64_t id = 0;
        std::optional<int> trial;
        row.read(id, calibration.at, trial, calibration.method, calibration.validation.mean_error,
                 calibration.validation.max_error, calibration.is_within_limits);
        calibration.trial = trial.value_or(-1);
        Query of(database,
                 "SELECT eye, x_px, y_px, gaze_x_px, gaze_y_px, error_deg, rms_s2s_deg, sd_deg FROM "
                 "validated_target WHERE calibration = ? ORDER BY id");
        of.bind(1, id);
        while (of.step()) {
            ValidatedTarget target;
            target.eye = of.small() == 0 ? Eye::left : Eye::right;
            of.read(target.target.x_px, target.target.y_px);
            target.gaze = read_place(of);
            target.error = {of.optional_real().value_or(0.0)};
            of.read(target.rms_s2s, target.sd);
            calibration.validation.targets.push_back(target);
        }
        all.push_back(std::move(calibration));
    }
    return all;
}

void GazeRows::line_left_out(int sitting, const std::string& detail) {
    insert_values(database_, "INTO event (sitting, at_ns, trial, kind, detail)", sitting, 0,
                  std::optional<int>(), "line left out", detail);
}

void GazeRows::source(int sitting, const GazeSource& source) {
    insert_values(database_, "OR REPLACE INTO gaze_source", sitting, source.file, source.sha256,
                  source.header, source.pupil_is_diameter ? "diameter" : "area", source.rate_hz,
                  source.has_left ? (source.has_right ? "both" : "left") : "right", source.px_per_deg_x,
                  source.px_per_deg_y, source.skipped_lines);
}

void GazeRows::detection(int sitting, const EventDetection& detection) {
    insert_values(database_, "OR REPLACE INTO event_detection", sitting, detection.name, detection.version,
                  detection.parameters);
}

std::optional<EventDetection> read_event_detection(const SQLite::Database& database, int sitting) {
    Query row(database, "SELECT name, version, parameters FROM event_detection WHERE sitting = ?");
    row.bind(1, sitting);
    if (!row.step())
        return std::nullopt;
    EventDetection detection;
    row.read(detection.name, detection.version, detection.parameters);
    return detection;
}

void read_gaze_events(const SQLite::Database& database, std::int64_t trial_id,
                      const std::function<void(const GazeEvent&)>& take) {
    Query row(database, "SELECT kind, eye, start_us, end_us, duration_us, x_px, y_px, arrival_x_px, "
                        "arrival_y_px, pupil, amplitude_deg, peak_velocity_deg_s, text FROM gaze_event "
                        "WHERE trial_id = ? ORDER BY n");
    row.bind(1, trial_id);
    while (row.step())
        take(read_event(row));
}

std::optional<GazeSource> read_gaze_source(const SQLite::Database& database, int sitting) {
    Query row(database, "SELECT file, sha256, header, pupil, rate_hz, eyes, px_per_deg_x, px_per_deg_y, "
                        "skipped_lines FROM gaze_source WHERE sitting = ?");
    row.bind(1, sitting);
    if (!row.step())
        return std::nullopt;
    GazeSource source;
    std::string pupil, eyes;
    row.read(source.file, source.sha256, source.header, pupil, source.rate_hz, eyes, source.px_per_deg_x,
             source.px_per_deg_y, source.skipped_lines);
    source.pupil_is_diameter = pupil == "diameter";
    source.has_left = eyes != "right";
    source.has_right = eyes != "left";
    return source;
}

} // namespace overt
