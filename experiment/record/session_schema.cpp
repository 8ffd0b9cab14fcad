#include "experiment/record/session_schema.h"

#include <string>
#include <vector>

#include <SQLiteCpp/Database.h>

#include "experiment/record/header_tables.h"
#include "experiment/record/sql.h"
#include "experiment/record/stimulus_columns.h"

namespace overt {

namespace {

// `flip` and `sample` are written thousands of times a second: their only key is the order of arrival within
// a trial, so each row is appended at the end of one tree, and a trial's rows lie together. They refuse no
// row: no uniqueness of refreshes, no foreign keys.
const char* const session_schema_sql = R"sql(
CREATE TABLE characterisation_file (n INTEGER PRIMARY KEY, name TEXT NOT NULL, text TEXT NOT NULL) STRICT;
CREATE TABLE schedule (trial INTEGER PRIMARY KEY, task INTEGER NOT NULL, @stimulus,
                       block INTEGER NOT NULL DEFAULT 0) STRICT;
CREATE TABLE block (block INTEGER PRIMARY KEY, id TEXT NOT NULL) STRICT;
CREATE TABLE protocol_file (n INTEGER PRIMARY KEY, name TEXT NOT NULL, text TEXT NOT NULL,
                            sha256 TEXT NOT NULL) STRICT;
CREATE TABLE task (task INTEGER PRIMARY KEY, id TEXT NOT NULL, question TEXT NOT NULL) STRICT;
CREATE TABLE part (object INTEGER NOT NULL, part INTEGER NOT NULL, name TEXT NOT NULL,
                   PRIMARY KEY (object, part)) STRICT, WITHOUT ROWID;
CREATE TABLE entry_column (list TEXT NOT NULL, entry INTEGER NOT NULL, n INTEGER NOT NULL, name TEXT NOT NULL,
                           text TEXT NOT NULL, number REAL, PRIMARY KEY (list, entry, n)) STRICT, WITHOUT ROWID;
CREATE TABLE stimulus (@stimulus, source TEXT NOT NULL, frames_sha256 TEXT NOT NULL,
                       made_from_sha256 TEXT NOT NULL DEFAULT '', drawn_by TEXT NOT NULL DEFAULT '',
                       PRIMARY KEY (@indices)) STRICT, WITHOUT ROWID;
CREATE TABLE pose (pose INTEGER PRIMARY KEY, angle_deg REAL NOT NULL, tilt_w REAL NOT NULL DEFAULT 1,
                   tilt_x REAL NOT NULL DEFAULT 0, tilt_y REAL NOT NULL DEFAULT 0, tilt_z REAL NOT NULL DEFAULT 0,
                   shift_x REAL NOT NULL DEFAULT 0, shift_y REAL NOT NULL DEFAULT 0,
                   shift_z REAL NOT NULL DEFAULT 0) STRICT;
CREATE TABLE animation_frame (motion INTEGER NOT NULL DEFAULT 0, frame INTEGER NOT NULL, pose INTEGER NOT NULL,
                              light_deg REAL NOT NULL DEFAULT 0, PRIMARY KEY (motion, frame)) STRICT, WITHOUT ROWID;
CREATE TABLE camera (object INTEGER NOT NULL, view INTEGER NOT NULL, x REAL NOT NULL, y REAL NOT NULL,
                     z REAL NOT NULL, target_x REAL NOT NULL, target_y REAL NOT NULL, target_z REAL NOT NULL,
                     vertical_fov_deg REAL NOT NULL, aside REAL NOT NULL DEFAULT 0,
                     PRIMARY KEY (object, view)) STRICT, WITHOUT ROWID;
CREATE TABLE map (object INTEGER NOT NULL, view INTEGER NOT NULL DEFAULT 0, pose INTEGER NOT NULL,
                  file TEXT NOT NULL, sha256 TEXT NOT NULL,
                  made TEXT NOT NULL CHECK (made IN ('prepared', 'live')),
                  kind TEXT NOT NULL DEFAULT 'triangles' CHECK (kind IN ('triangles', 'coordinates')),
                  PRIMARY KEY (object, view, pose)) STRICT, WITHOUT ROWID;
CREATE TABLE sitting (sitting INTEGER PRIMARY KEY, started_utc TEXT NOT NULL,
                      closed INTEGER NOT NULL,
                      resumed TEXT CHECK (resumed IN ('redo', 'skip', 'restart-block')),
                      program_version TEXT NOT NULL DEFAULT '', program_sha256 TEXT NOT NULL DEFAULT '') STRICT;
CREATE TABLE trial (
    trial_id INTEGER PRIMARY KEY, sitting INTEGER NOT NULL REFERENCES sitting,
    trial INTEGER NOT NULL, attempt INTEGER NOT NULL,
    task INTEGER NOT NULL, @stimulus,
    status TEXT NOT NULL CHECK (status IN ('open', 'completed', 'aborted', 'interrupted')),
    started_ns INTEGER NOT NULL,
    task_screen_onset_ns INTEGER, presentation_onset_ns INTEGER, presentation_end_ns INTEGER,
    response_screen_onset_ns INTEGER, responded_ns INTEGER,
    shown_refreshes INTEGER, missed_refreshes INTEGER, drift_deg REAL, answer TEXT,
    lost_flips INTEGER, lost_samples INTEGER,
    failure TEXT, comes_again TEXT CHECK (comes_again IN ('never', 'now', 'end-of-block'))
) STRICT;
CREATE TABLE superseded (attempt_id INTEGER PRIMARY KEY, sitting INTEGER NOT NULL, why TEXT NOT NULL) STRICT;
CREATE TABLE given_up (trial INTEGER PRIMARY KEY, sitting INTEGER NOT NULL, why TEXT NOT NULL) STRICT;
CREATE VIEW counted_trial AS SELECT * FROM trial
    WHERE status = 'completed' AND trial_id NOT IN (SELECT attempt_id FROM superseded);
CREATE TABLE flip (
    trial_id INTEGER NOT NULL, n INTEGER NOT NULL,
    refresh_in_trial INTEGER NOT NULL, refresh INTEGER NOT NULL,
    planned INTEGER NOT NULL, shown INTEGER NOT NULL, pose INTEGER NOT NULL,
    requested_ns INTEGER NOT NULL, swapped_ns INTEGER NOT NULL, vertical_blank_ns INTEGER NOT NULL,
    source INTEGER NOT NULL, missed INTEGER NOT NULL, uncertainty_ns INTEGER NOT NULL DEFAULT 0,
    step INTEGER NOT NULL DEFAULT 0,
    PRIMARY KEY (trial_id, n)
) STRICT, WITHOUT ROWID;
CREATE TABLE sample (
    trial_id INTEGER NOT NULL, n INTEGER NOT NULL,
    tracker_us INTEGER NOT NULL, eye INTEGER NOT NULL, x_px REAL, y_px REAL, pupil_area REAL,
    PRIMARY KEY (trial_id, n)
) STRICT, WITHOUT ROWID;
CREATE TABLE clock_pair (id INTEGER PRIMARY KEY, sitting INTEGER NOT NULL REFERENCES sitting,
                         before_ns INTEGER NOT NULL, tracker_us INTEGER NOT NULL, after_ns INTEGER NOT NULL) STRICT;
CREATE TABLE event (id INTEGER PRIMARY KEY, sitting INTEGER NOT NULL REFERENCES sitting,
                    at_ns INTEGER NOT NULL, trial INTEGER, kind TEXT NOT NULL, detail TEXT NOT NULL) STRICT;
CREATE TABLE seal (
    seal INTEGER PRIMARY KEY,
    kind TEXT NOT NULL CHECK (kind IN ('beginning', 'sitting', 'trial', 'other', 'end')),
    sitting INTEGER NOT NULL, trial_id INTEGER, previous TEXT NOT NULL, sha256 TEXT NOT NULL
) STRICT;
CREATE TABLE sealed_table (
    seal INTEGER NOT NULL, name TEXT NOT NULL, columns TEXT NOT NULL,
    covers TEXT NOT NULL CHECK (covers IN ('all', 'trial', 'no trial', 'new')),
    after_id INTEGER NOT NULL, to_id INTEGER NOT NULL, row_count INTEGER NOT NULL,
    sha256 TEXT NOT NULL, locator BLOB NOT NULL,
    PRIMARY KEY (seal, name)
) STRICT, WITHOUT ROWID;
)sql";

} // namespace

const char* const box_tables_sql = R"sql(
CREATE TABLE IF NOT EXISTS display_box (
    sitting INTEGER PRIMARY KEY REFERENCES sitting,
    use TEXT NOT NULL CHECK (use IN ('box', 'declined', 'simulated', 'not needed')),
    port TEXT NOT NULL, product TEXT NOT NULL, serial_number TEXT NOT NULL, firmware_date TEXT NOT NULL,
    mode TEXT NOT NULL, gamma_table TEXT NOT NULL, settled_after_ns INTEGER, video_rate_hz REAL
) STRICT;
CREATE TABLE IF NOT EXISTS box_clock_pair (
    id INTEGER PRIMARY KEY, sitting INTEGER NOT NULL REFERENCES sitting,
    before_ns INTEGER NOT NULL, box_us INTEGER NOT NULL, after_ns INTEGER NOT NULL
) STRICT;
)sql";

const char* const observer_tables_sql = R"sql(
CREATE TABLE IF NOT EXISTS observer_field (n INTEGER PRIMARY KEY, id TEXT NOT NULL, title TEXT NOT NULL,
                                           value TEXT NOT NULL) STRICT;
CREATE TABLE IF NOT EXISTS observer_form (
    field TEXT PRIMARY KEY, sitting INTEGER NOT NULL REFERENCES sitting, asked TEXT NOT NULL, at_ns INTEGER
) STRICT, WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS dataset_entry (n INTEGER PRIMARY KEY, key TEXT NOT NULL, value TEXT NOT NULL) STRICT;
CREATE TABLE IF NOT EXISTS consent (
    n INTEGER PRIMARY KEY, sitting INTEGER NOT NULL REFERENCES sitting, observer TEXT NOT NULL,
    accepted INTEGER NOT NULL CHECK (accepted IN (0, 1)), at_ns INTEGER NOT NULL, at_utc TEXT NOT NULL,
    text_sha256 TEXT NOT NULL
) STRICT;
CREATE TABLE IF NOT EXISTS answer_recording (
    trial_id INTEGER PRIMARY KEY, file TEXT NOT NULL, sha256 TEXT NOT NULL, device TEXT NOT NULL,
    sample_rate_hz REAL NOT NULL, measured_rate_hz REAL NOT NULL, bits INTEGER NOT NULL,
    input_latency_ns INTEGER NOT NULL, samples INTEGER NOT NULL, onset_sample REAL NOT NULL,
    onset_uncertainty_ns INTEGER NOT NULL, overruns INTEGER NOT NULL, lost_samples INTEGER NOT NULL,
    peak_dbfs REAL NOT NULL, noise_dbfs REAL NOT NULL, clipped_samples INTEGER NOT NULL,
    voice_onset_ns INTEGER, voice_end_ns INTEGER, fault TEXT NOT NULL
) STRICT;
)sql";

const char* const ledger_tables_sql = R"sql(
CREATE TABLE IF NOT EXISTS missed_refresh (
    trial_id INTEGER NOT NULL, refresh_in_trial INTEGER NOT NULL, refresh INTEGER NOT NULL,
    planned INTEGER NOT NULL, shown INTEGER NOT NULL, pose INTEGER NOT NULL,
    vertical_blank_ns INTEGER NOT NULL, uncertainty_ns INTEGER NOT NULL,
    PRIMARY KEY (trial_id, refresh_in_trial)
) STRICT, WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS response_press (
    trial_id INTEGER PRIMARY KEY, uncertainty_ns INTEGER NOT NULL
) STRICT;
CREATE TABLE IF NOT EXISTS step (
    trial_id INTEGER NOT NULL, n INTEGER NOT NULL, kind TEXT NOT NULL, id TEXT NOT NULL,
    planned_refreshes INTEGER, drawn_s REAL, still_frame INTEGER, begin_ns INTEGER, end_ns INTEGER,
    ended_by TEXT, gaze_onset_us INTEGER, gaze_detected_us INTEGER, places TEXT,
    PRIMARY KEY (trial_id, n)
) STRICT, WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS swap_modes (
    trial_id INTEGER PRIMARY KEY, flipped INTEGER NOT NULL, copied INTEGER NOT NULL,
    suboptimal_copied INTEGER NOT NULL, skipped INTEGER NOT NULL
) STRICT;
)sql";

const char* const answer_tables_sql = R"sql(
CREATE TABLE IF NOT EXISTS given_answer (
    trial_id INTEGER NOT NULL, n INTEGER NOT NULL, id TEXT NOT NULL, item TEXT NOT NULL, kind TEXT NOT NULL,
    is_missed INTEGER NOT NULL CHECK (is_missed IN (0, 1)), value TEXT NOT NULL, number REAL, key TEXT NOT NULL,
    device TEXT NOT NULL, correct TEXT NOT NULL, is_correct INTEGER, zero TEXT NOT NULL,
    stimulus_onset_ns INTEGER, window_onset_ns INTEGER, window_end_ns INTEGER, screen_onset_ns INTEGER,
    first_input_ns INTEGER, answered_ns INTEGER, uncertainty_ns INTEGER,
    is_tied INTEGER NOT NULL CHECK (is_tied IN (0, 1)), place INTEGER NOT NULL, mapping INTEGER NOT NULL,
    changes INTEGER NOT NULL,
    PRIMARY KEY (trial_id, n)
) STRICT, WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS answer_input (
    trial_id INTEGER NOT NULL, n INTEGER NOT NULL, id TEXT NOT NULL, item TEXT NOT NULL, kind TEXT NOT NULL,
    at_ns INTEGER NOT NULL, uncertainty_ns INTEGER NOT NULL, device TEXT NOT NULL, key TEXT NOT NULL,
    character INTEGER, right_px REAL, down_px REAL, button INTEGER, steps REAL,
    state TEXT NOT NULL CHECK (state IN ('before', 'open', 'late')),
    has_counted INTEGER NOT NULL CHECK (has_counted IN (0, 1)), number REAL,
    PRIMARY KEY (trial_id, n)
) STRICT, WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS match_setting (
    trial_id INTEGER NOT NULL, n INTEGER NOT NULL, axis INTEGER NOT NULL, slot INTEGER NOT NULL,
    along TEXT NOT NULL, start REAL NOT NULL, final REAL NOT NULL, low REAL NOT NULL, high REAL NOT NULL,
    reference REAL, changes INTEGER NOT NULL, reversals INTEGER NOT NULL, stopped_low INTEGER NOT NULL,
    stopped_high INTEGER NOT NULL,
    PRIMARY KEY (trial_id, n, axis)
) STRICT, WITHOUT ROWID;
)sql";

const char* const probe_tables_sql = R"sql(
CREATE TABLE IF NOT EXISTS point (
    object INTEGER NOT NULL, n INTEGER NOT NULL, name TEXT NOT NULL, triangle INTEGER NOT NULL,
    weight_a REAL NOT NULL, weight_b REAL NOT NULL, weight_c REAL NOT NULL, x REAL NOT NULL, y REAL NOT NULL,
    z REAL NOT NULL, vertex INTEGER, part TEXT NOT NULL,
    PRIMARY KEY (object, n)
) STRICT, WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS shown_probe (
    trial_id INTEGER NOT NULL, n INTEGER NOT NULL, step INTEGER NOT NULL, id TEXT NOT NULL, point TEXT NOT NULL,
    place INTEGER NOT NULL, shown_refreshes INTEGER NOT NULL, visible_refreshes INTEGER NOT NULL,
    was_visible INTEGER NOT NULL CHECK (was_visible IN (0, 1)), x_px REAL NOT NULL, y_px REAL NOT NULL,
    slant_deg REAL NOT NULL, tilt_deg REAL NOT NULL,
    PRIMARY KEY (trial_id, n)
) STRICT, WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS gauge_setting (
    trial_id INTEGER NOT NULL, n INTEGER NOT NULL, probe TEXT NOT NULL, point TEXT NOT NULL,
    start_slant_deg REAL NOT NULL, start_tilt_deg REAL NOT NULL, slant_deg REAL NOT NULL, tilt_deg REAL NOT NULL,
    at_limit INTEGER NOT NULL CHECK (at_limit IN (0, 1)), true_slant_deg REAL, true_tilt_deg REAL,
    frame INTEGER, is_visible INTEGER,
    PRIMARY KEY (trial_id, n)
) STRICT, WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS gauge_change (
    trial_id INTEGER NOT NULL, n INTEGER NOT NULL, slant_deg REAL NOT NULL, tilt_deg REAL NOT NULL,
    PRIMARY KEY (trial_id, n)
) STRICT, WITHOUT ROWID;
)sql";

const char* const slot_tables_sql = R"sql(
CREATE TABLE IF NOT EXISTS slot (
    slot INTEGER PRIMARY KEY, id TEXT NOT NULL, title TEXT NOT NULL, left_px INTEGER NOT NULL,
    top_px INTEGER NOT NULL, width_px INTEGER NOT NULL, height_px INTEGER NOT NULL
) STRICT;
CREATE TABLE IF NOT EXISTS schedule_slot (
    trial INTEGER NOT NULL, place INTEGER NOT NULL, slot INTEGER NOT NULL, @stimulus,
    PRIMARY KEY (trial, place)
) STRICT, WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS schedule_level (
    trial INTEGER NOT NULL, n INTEGER NOT NULL, factor TEXT NOT NULL, level TEXT NOT NULL,
    PRIMARY KEY (trial, n)
) STRICT, WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS schedule_answer (
    trial INTEGER PRIMARY KEY, correct TEXT NOT NULL, role TEXT NOT NULL CHECK (role IN ('trial', 'catch', 'practice'))
) STRICT;
CREATE TABLE IF NOT EXISTS presentation (
    trial_id INTEGER NOT NULL, place INTEGER NOT NULL, slot INTEGER NOT NULL, @stimulus,
    first_refresh INTEGER, last_refresh INTEGER,
    PRIMARY KEY (trial_id, place)
) STRICT, WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS slot_flip (
    trial_id INTEGER NOT NULL, refresh_in_trial INTEGER NOT NULL, place INTEGER NOT NULL,
    planned INTEGER NOT NULL, shown INTEGER NOT NULL, pose INTEGER NOT NULL,
    PRIMARY KEY (trial_id, refresh_in_trial, place)
) STRICT, WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS steered_flip (
    trial_id INTEGER NOT NULL, refresh_in_trial INTEGER NOT NULL, place INTEGER NOT NULL,
    level INTEGER, input_ns INTEGER,
    PRIMARY KEY (trial_id, refresh_in_trial, place)
) STRICT, WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS match_level (
    trial_id INTEGER NOT NULL, n INTEGER NOT NULL, level INTEGER NOT NULL, @stimulus,
    first REAL NOT NULL, second REAL,
    PRIMARY KEY (trial_id, n, level)
) STRICT, WITHOUT ROWID;
)sql";

const char* const gaze_tables_sql = R"sql(
CREATE TABLE IF NOT EXISTS gaze_event (
    trial_id INTEGER NOT NULL, n INTEGER NOT NULL,
    kind TEXT NOT NULL, eye INTEGER, start_us INTEGER NOT NULL, end_us INTEGER NOT NULL,
    duration_us INTEGER NOT NULL, x_px REAL, y_px REAL, arrival_x_px REAL, arrival_y_px REAL, pupil REAL,
    amplitude_deg REAL, peak_velocity_deg_s REAL, text TEXT NOT NULL,
    PRIMARY KEY (trial_id, n)
) STRICT, WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS trial_gaze (
    trial_id INTEGER PRIMARY KEY, samples INTEGER NOT NULL, without_gaze INTEGER NOT NULL,
    missing INTEGER NOT NULL
) STRICT;
CREATE TABLE IF NOT EXISTS sample_detail (
    trial_id INTEGER NOT NULL, n INTEGER NOT NULL, tracker_us INTEGER NOT NULL, eye INTEGER NOT NULL,
    confidence REAL, eye_x_mm REAL, eye_y_mm REAL, eye_z_mm REAL,
    PRIMARY KEY (trial_id, n)
) STRICT, WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS calibration (
    id INTEGER PRIMARY KEY, sitting INTEGER NOT NULL REFERENCES sitting, at_ns INTEGER NOT NULL,
    trial INTEGER, method TEXT NOT NULL, mean_deg REAL NOT NULL, max_deg REAL NOT NULL,
    within_limits INTEGER NOT NULL CHECK (within_limits IN (0, 1))
) STRICT;
CREATE TABLE IF NOT EXISTS validated_target (
    id INTEGER PRIMARY KEY, sitting INTEGER NOT NULL REFERENCES sitting,
    calibration INTEGER NOT NULL REFERENCES calibration, eye INTEGER NOT NULL,
    x_px REAL NOT NULL, y_px REAL NOT NULL, gaze_x_px REAL, gaze_y_px REAL, error_deg REAL,
    rms_s2s_deg REAL, sd_deg REAL
) STRICT;
CREATE TABLE IF NOT EXISTS event_detection (
    sitting INTEGER PRIMARY KEY REFERENCES sitting, name TEXT NOT NULL, version INTEGER NOT NULL,
    parameters TEXT NOT NULL
) STRICT;
CREATE TABLE IF NOT EXISTS gaze_source (
    sitting INTEGER PRIMARY KEY REFERENCES sitting, file TEXT NOT NULL, sha256 TEXT NOT NULL,
    header TEXT NOT NULL, pupil TEXT NOT NULL CHECK (pupil IN ('area', 'diameter')), rate_hz REAL NOT NULL,
    eyes TEXT NOT NULL CHECK (eyes IN ('left', 'right', 'both')),
    px_per_deg_x REAL, px_per_deg_y REAL, skipped_lines INTEGER NOT NULL
) STRICT;
)sql";

const char* const device_tables_sql = R"sql(
CREATE TABLE IF NOT EXISTS button_change (
    id INTEGER PRIMARY KEY, sitting INTEGER NOT NULL REFERENCES sitting, at_ns INTEGER NOT NULL,
    uncertainty_ns INTEGER NOT NULL, trial INTEGER, attempt_id INTEGER, box TEXT NOT NULL,
    used_by TEXT NOT NULL CHECK (used_by IN ('observer', 'operator')), button INTEGER NOT NULL,
    name TEXT NOT NULL, is_down INTEGER NOT NULL CHECK (is_down IN (0, 1)), device_us INTEGER,
    meaning TEXT NOT NULL
) STRICT;
CREATE TABLE IF NOT EXISTS key_press (
    id INTEGER PRIMARY KEY, sitting INTEGER NOT NULL REFERENCES sitting, at_ns INTEGER NOT NULL,
    uncertainty_ns INTEGER NOT NULL, trial INTEGER, attempt_id INTEGER, device TEXT NOT NULL, name TEXT NOT NULL,
    code INTEGER, modifiers TEXT NOT NULL, text TEXT NOT NULL, screen TEXT NOT NULL, meaning TEXT NOT NULL
) STRICT;
CREATE TABLE IF NOT EXISTS marker (
    id INTEGER PRIMARY KEY, sitting INTEGER NOT NULL REFERENCES sitting, at_ns INTEGER NOT NULL,
    trial INTEGER, attempt_id INTEGER, output TEXT NOT NULL, text TEXT NOT NULL, code INTEGER NOT NULL,
    is_sent INTEGER NOT NULL CHECK (is_sent IN (0, 1)), not_before_ns INTEGER NOT NULL,
    not_after_ns INTEGER NOT NULL, planned_refresh INTEGER, shown_refresh INTEGER
) STRICT;
)sql";

const char* const option_tables_sql = R"sql(
CREATE TABLE IF NOT EXISTS run_option (
    sitting INTEGER NOT NULL REFERENCES sitting, n INTEGER NOT NULL, name TEXT NOT NULL, value TEXT NOT NULL,
    PRIMARY KEY (sitting, n)
) STRICT, WITHOUT ROWID;
)sql";

void make_session_tables(SQLite::Database& database) {
    for (const std::string& sql : {create_sql(session_table()), create_sql(characterisation_table()),
                                   create_sql(object_table()), create_sql(animation_table())})
        database.exec(sql);
    for (const char* const sql :
         {session_schema_sql, box_tables_sql, observer_tables_sql, ledger_tables_sql, answer_tables_sql,
          probe_tables_sql, slot_tables_sql, gaze_tables_sql, device_tables_sql, option_tables_sql})
        database.exec(with_stimulus_columns(sql));
    for (const StimulusList& list : stimulus_lists)
        if (list.name != object_table().name) // which has more columns
            database.exec(fmt::format(
                "CREATE TABLE {0} ({0} INTEGER PRIMARY KEY, id TEXT NOT NULL, title TEXT NOT NULL) STRICT",
                list.name));
}

namespace {

/// The lists that stimuli were not made of when the tables were: their stimuli have the first entry.
void add_later_lists(SQLite::Database& database) {
    std::vector<std::string> tables;
    for (Query row(database, "SELECT name FROM sqlite_schema WHERE type = 'table'"); row.step();)
        tables.push_back(row.text());
    const auto has = [&](const std::string& table, std::size_t list) {
        return has_column(database, table.c_str(), std::string(stimulus_lists[list].name).c_str());
    };
    for (const std::string& table : tables)
        for (std::size_t list = 2; list < stimulus_lists.size(); ++list)
            if (has(table, 0) && has(table, 1) && !has(table, list))
                database.exec(fmt::format("ALTER TABLE \"{}\" ADD COLUMN {} INTEGER NOT NULL DEFAULT 0",
                                          table, stimulus_lists[list].name));
}

} // namespace

void complete_session_tables(SQLite::Database& database) {
    add_later_lists(database);
    database.exec(ledger_tables_sql);
    database.exec(with_stimulus_columns(slot_tables_sql));
    database.exec(answer_tables_sql);
    database.exec(probe_tables_sql);
    if (!has_column(database, "flip", "step"))
        database.exec("ALTER TABLE flip ADD COLUMN step INTEGER NOT NULL DEFAULT 0");
    if (!has_column(database, "step", "places"))
        database.exec("ALTER TABLE step ADD COLUMN places TEXT");
}

} // namespace overt
