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

std::int64_t microseconds(TrackerTime time) { return time.time_since_epoch().count(); }

GazeEvent read_event(Query& row) {
    GazeEvent event;
    event.kind = gaze_event_kind(row.text()).value_or(GazeEvent::Kind::note);
    if (const std::optional<int> eye = row.optional_small())
        event.eye = *eye == 0 ? Eye::left : Eye::right;
    event.start = row.tracker_time();
    event.end = row.tracker_time();
    event.duration = row.tracker_time().time_since_epoch();
    event.place = read_place(row);
    event.arrival = read_place(row);
    event.pupil = row.optional_real();
    event.amplitude_deg = row.optional_real();
    event.peak_velocity_deg_s = row.optional_real();
    event.text = row.text();
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
    run_statement(insert_sample_, trial_id_, samples_++, microseconds(sample.sampled_at),
                  static_cast<int>(sample.eye), x_of(sample.gaze), y_of(sample.gaze),
                  shortest_decimal(sample.pupil_area));
}

void GazeRows::event(const GazeEvent& event) {
    std::int64_t& count = trial_id_ == 0 ? outside_events_ : events_;
    run_statement(insert_event_, trial_id_, count++, std::string(name_of(event.kind)),
                  event.eye ? std::optional(static_cast<int>(*event.eye)) : std::nullopt,
                  microseconds(event.start), microseconds(event.end),
                  static_cast<std::int64_t>(event.duration.count()), x_of(event.place), y_of(event.place),
                  x_of(event.arrival), y_of(event.arrival), event.pupil, event.amplitude_deg,
                  event.peak_velocity_deg_s, event.text);
}

void GazeRows::detail(const SampleDetail& detail) {
    const auto mm = [&](int axis) {
        return detail.eye_mm ? Pixels(shortest_decimal((*detail.eye_mm)[axis])) : std::nullopt;
    };
    run_statement(
        insert_detail_, trial_id_, details_++, microseconds(detail.sampled_at), static_cast<int>(detail.eye),
        detail.confidence ? Pixels(shortest_decimal(*detail.confidence)) : std::nullopt, mm(0), mm(1), mm(2));
}

void GazeRows::calibration(int sitting, const RecordedCalibration& calibration) {
    SQLite::Statement insert(database_, "INSERT INTO calibration (sitting, at_ns, trial, method, mean_deg, "
                                        "max_deg, within_limits) VALUES (?,?,?,?,?,?,?)");
    const ValidationResult& found = calibration.validation;
    run_statement(insert, sitting, calibration.at,
                  calibration.trial < 0 ? std::nullopt : std::optional(calibration.trial), calibration.method,
                  found.mean_error.value, found.max_error.value, calibration.is_within_limits ? 1 : 0);
    const std::int64_t id = database_.getLastInsertRowid();
    SQLite::Statement insert_target(
        database_,
        "INSERT INTO validated_target (sitting, calibration, eye, x_px, y_px, gaze_x_px, gaze_y_px, "
        "error_deg, rms_s2s_deg, sd_deg) VALUES (?,?,?,?,?,?,?,?,?,?)");
    const auto degrees = [](const std::optional<Degrees>& angle) {
        return angle ? std::optional(angle->value) : std::nullopt;
    };
    for (const ValidatedTarget& target : found.targets)
        run_statement(insert_target, sitting, id, static_cast<int>(target.eye), target.target.x_px,
                      target.target.y_px, x_of(target.gaze), y_of(target.gaze),
                      target.gaze ? std::optional(target.error.value) : std::nullopt, degrees(target.rms_s2s),
                      degrees(target.sd));
}

std::vector<RecordedCalibration> read_calibrations(const SQLite::Database& database, int sitting) {
    std::vector<RecordedCalibration> all;
    Query row(database, "SELECT id, at_ns, trial, method, mean_deg, max_deg, within_limits FROM calibration "
                        "WHERE sitting = ? ORDER BY id");
    row.bind(1, sitting);
    while (row.step()) {
        RecordedCalibration calibration;
        const std::int64_t id = row.integer();
        calibration.at = row.session_time();
        calibration.trial = row.optional_small().value_or(-1);
        calibration.method = row.text();
        calibration.validation.mean_error = {row.real()};
        calibration.validation.max_error = {row.real()};
        calibration.is_within_limits = row.integer() != 0;
        Query of(database,
                 "SELECT eye, x_px, y_px, gaze_x_px, gaze_y_px, error_deg, rms_s2s_deg, sd_deg FROM "
                 "validated_target WHERE calibration = ? ORDER BY id");
        of.bind(1, id);
        while (of.step()) {
            ValidatedTarget target;
            target.eye = of.small() == 0 ? Eye::left : Eye::right;
            target.target.x_px = of.real();
            target.target.y_px = of.real();
            target.gaze = read_place(of);
            target.error = {of.optional_real().value_or(0.0)};
            const auto degrees = [&]() -> std::optional<Degrees> {
                const std::optional<double> value = of.optional_real();
                return value ? std::optional(Degrees{*value}) : std::nullopt;
            };
            target.rms_s2s = degrees();
            target.sd = degrees();
            calibration.validation.targets.push_back(target);
        }
        all.push_back(std::move(calibration));
    }
    return all;
}

void GazeRows::line_left_out(int sitting, const std::string& detail) {
    SQLite::Statement insert(database_, "INSERT INTO event (sitting, at_ns, trial, kind, detail) "
                                        "VALUES (?, 0, NULL, 'line left out', ?)");
    run_statement(insert, sitting, detail);
}

void GazeRows::source(int sitting, const GazeSource& source) {
    SQLite::Statement insert(database_, "INSERT OR REPLACE INTO gaze_source VALUES (?,?,?,?,?,?,?,?,?,?)");
    run_statement(insert, sitting, source.file, source.sha256, source.header,
                  source.pupil_is_diameter ? "diameter" : "area", source.rate_hz,
                  source.has_left ? (source.has_right ? "both" : "left") : "right", source.px_per_deg_x,
                  source.px_per_deg_y, source.skipped_lines);
}

void GazeRows::detection(int sitting, const EventDetection& detection) {
    SQLite::Statement insert(database_, "INSERT OR REPLACE INTO event_detection VALUES (?,?,?,?)");
    run_statement(insert, sitting, detection.name, detection.version, detection.parameters);
}

std::optional<EventDetection> read_event_detection(const SQLite::Database& database, int sitting) {
    Query row(database, "SELECT name, version, parameters FROM event_detection WHERE sitting = ?");
    row.bind(1, sitting);
    if (!row.step())
        return std::nullopt;
    EventDetection detection;
    detection.name = row.text();
    detection.version = row.small();
    detection.parameters = row.text();
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
    source.file = row.text();
    source.sha256 = row.text();
    source.header = row.text();
    source.pupil_is_diameter = row.text() == "diameter";
    source.rate_hz = row.real();
    const std::string eyes = row.text();
    source.has_left = eyes != "right";
    source.has_right = eyes != "left";
    source.px_per_deg_x = row.optional_real();
    source.px_per_deg_y = row.optional_real();
    source.skipped_lines = row.integer();
    return source;
}

} // namespace overt
