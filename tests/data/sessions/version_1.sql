-- The tables of session format 1, as the first program made them.
CREATE TABLE session (
    id INTEGER PRIMARY KEY CHECK (id = 1),
    protocol_name TEXT NOT NULL, protocol_title TEXT NOT NULL,
    protocol_text TEXT NOT NULL, protocol_sha256 TEXT NOT NULL,
    observer_label TEXT NOT NULL, observer_number INTEGER NOT NULL,
    session_number INTEGER NOT NULL, seed TEXT NOT NULL,
    started_utc TEXT NOT NULL,
    clock TEXT NOT NULL CHECK (clock IN ('steady', 'virtual')),
    program_version TEXT NOT NULL, compiler TEXT NOT NULL, compiler_flags TEXT NOT NULL, commit_id TEXT NOT NULL,
    gl_context TEXT NOT NULL, gl_vendor TEXT NOT NULL, gl_renderer TEXT NOT NULL, gl_version TEXT NOT NULL,
    tracker_name TEXT NOT NULL, tracker_rate_hz REAL NOT NULL,
    tracker_eye TEXT NOT NULL CHECK (tracker_eye IN ('left', 'right')),
    screen_width_px INTEGER NOT NULL, screen_height_px INTEGER NOT NULL,
    screen_width_mm REAL NOT NULL, screen_height_mm REAL NOT NULL, viewing_distance_mm REAL NOT NULL,
    image_left_px INTEGER NOT NULL, image_top_px INTEGER NOT NULL,
    image_width_px INTEGER NOT NULL, image_height_px INTEGER NOT NULL,
    refresh_hz REAL NOT NULL, display_latency_ns INTEGER NOT NULL,
    output_mode TEXT NOT NULL, background REAL NOT NULL,
    frame_count INTEGER NOT NULL, frame_rate_hz REAL NOT NULL, amplitude_deg REAL NOT NULL,
    playback TEXT NOT NULL CHECK (playback IN ('cycle', 'ping-pong')), duration_s REAL NOT NULL
) STRICT;
CREATE TABLE schedule (trial INTEGER PRIMARY KEY, task INTEGER NOT NULL, sculpture INTEGER NOT NULL,
                       material INTEGER NOT NULL) STRICT;
CREATE TABLE task (task INTEGER PRIMARY KEY, id TEXT NOT NULL, question TEXT NOT NULL) STRICT;
CREATE TABLE sculpture (
    sculpture INTEGER PRIMARY KEY, id TEXT NOT NULL, title TEXT NOT NULL,
    mesh_sha256 TEXT NOT NULL, mesh_file TEXT NOT NULL,
    camera_x REAL NOT NULL, camera_y REAL NOT NULL, camera_z REAL NOT NULL,
    target_x REAL NOT NULL, target_y REAL NOT NULL, target_z REAL NOT NULL, vertical_fov_deg REAL NOT NULL,
    axis_x REAL NOT NULL, axis_y REAL NOT NULL, axis_z REAL NOT NULL,
    min_x REAL NOT NULL, min_y REAL NOT NULL, min_z REAL NOT NULL,
    max_x REAL NOT NULL, max_y REAL NOT NULL, max_z REAL NOT NULL
) STRICT;
CREATE TABLE part (sculpture INTEGER NOT NULL, part INTEGER NOT NULL, name TEXT NOT NULL,
                   PRIMARY KEY (sculpture, part)) STRICT, WITHOUT ROWID;
CREATE TABLE material (material INTEGER PRIMARY KEY, id TEXT NOT NULL, title TEXT NOT NULL) STRICT;
CREATE TABLE stimulus (sculpture INTEGER NOT NULL, material INTEGER NOT NULL, source TEXT NOT NULL,
                       frames_sha256 TEXT NOT NULL, PRIMARY KEY (sculpture, material)) STRICT, WITHOUT ROWID;
CREATE TABLE pose (pose INTEGER PRIMARY KEY, angle_deg REAL NOT NULL) STRICT;
CREATE TABLE animation_frame (frame INTEGER PRIMARY KEY, pose INTEGER NOT NULL) STRICT;
CREATE TABLE map (sculpture INTEGER NOT NULL, pose INTEGER NOT NULL, file TEXT NOT NULL, sha256 TEXT NOT NULL,
                  made TEXT NOT NULL CHECK (made IN ('prepared', 'live')),
                  PRIMARY KEY (sculpture, pose)) STRICT, WITHOUT ROWID;
CREATE TABLE sitting (sitting INTEGER PRIMARY KEY, started_utc TEXT NOT NULL,
                      closed INTEGER NOT NULL) STRICT;
CREATE TABLE trial (
    trial_id INTEGER PRIMARY KEY, sitting INTEGER NOT NULL REFERENCES sitting,
    trial INTEGER NOT NULL, attempt INTEGER NOT NULL,
    task INTEGER NOT NULL, sculpture INTEGER NOT NULL, material INTEGER NOT NULL,
    status TEXT NOT NULL CHECK (status IN ('open', 'completed', 'aborted')),
    started_ns INTEGER NOT NULL,
    task_screen_onset_ns INTEGER, presentation_onset_ns INTEGER, presentation_end_ns INTEGER,
    response_screen_onset_ns INTEGER, responded_ns INTEGER,
    shown_refreshes INTEGER, missed_refreshes INTEGER, drift_deg REAL, answer TEXT,
    lost_flips INTEGER, lost_samples INTEGER
) STRICT;
CREATE TABLE flip (
    trial_id INTEGER NOT NULL, n INTEGER NOT NULL,
    refresh_in_trial INTEGER NOT NULL, refresh INTEGER NOT NULL,
    planned INTEGER NOT NULL, shown INTEGER NOT NULL, pose INTEGER NOT NULL,
    requested_ns INTEGER NOT NULL, swapped_ns INTEGER NOT NULL, vertical_blank_ns INTEGER NOT NULL,
    source INTEGER NOT NULL, missed INTEGER NOT NULL,
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
