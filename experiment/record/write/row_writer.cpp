#include "experiment/record/write/row_writer.h"

#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sqlite3.h>

#include "experiment/base/error.h"
#include "experiment/base/number_text.h"
#include "experiment/record/file_hash.h"
#include "experiment/record/read/trial_rows.h"
#include "experiment/record/schema_migration.h"
#include "experiment/record/session_file.h"
#include "experiment/record/session_schema.h"
#include "experiment/record/sql.h"
#include "experiment/record/stimulus_columns.h"
#include "experiment/record/write/probe_rows.h"

namespace overt {
namespace {

/// Write-ahead log: a transaction costs a write to the end of a file and no wait for the disk. Checkpoints
/// never happen by themselves (they flush the disk): the end of a trial is the time for them.
SQLite::Database open_for_rows(const std::filesystem::path& file) {
    migrate_session_file(file);
    SQLite::Database database = open_session_file(file, SessionFileUse::write);
    try {
        database.exec(
            "PRAGMA journal_mode = WAL; PRAGMA synchronous = NORMAL; PRAGMA wal_autocheckpoint = 0");
        complete_session_tables(database);
    } catch (const SQLite::Exception& reason) {
        throw_record_error(file, "opening the session for writing", reason);
    }
    return database;
}

std::int64_t number(const SQLite::Database& database, const char* sql, std::int64_t parameter = 0) {
    Query query(database, sql);
    query.bind(1, parameter);
    return query.step() ? query.integer() : 0;
}

/// As it stands in a table: NULL outside of trials.
std::optional<int> number_of_trial(int trial) { return trial < 0 ? std::nullopt : std::optional(trial); }

/// "0 2".
std::optional<std::string> text_of_places(const std::optional<std::vector<int>>& places) {
    return places ? std::optional(fmt::format("{}", fmt::join(*places, " "))) : std::nullopt;
}

} // namespace

RowWriter::RowWriter(const std::filesystem::path& session_file, const Sitting& sitting) try
    : lock_(session_file.parent_path()), database_(open_for_rows(session_file)),
      insert_flip_(database_,
                   "INSERT INTO flip (trial_id, n, refresh_in_trial, refresh, planned, shown, pose, "
                   "requested_ns, swapped_ns, vertical_blank_ns, source, missed, uncertainty_ns, step) "
                   "VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?,?)"),
      insert_slot_flip_(database_, "INSERT OR REPLACE INTO slot_flip (trial_id, refresh_in_trial, place, "
                                   "planned, shown, pose) VALUES (?,?,?,?,?,?)"),
      insert_steered_flip_(database_, "INSERT OR REPLACE INTO steered_flip (trial_id, refresh_in_trial, "
                                      "place, level, input_ns) VALUES (?,?,?,?,?)"),
      insert_missed_(database_,
                     "INSERT OR REPLACE INTO missed_refresh (trial_id, refresh_in_trial, refresh, planned, "
                     "shown, pose, vertical_blank_ns, uncertainty_ns) VALUES (?,?,?,?,?,?,?,?)"),
      insert_sample_(database_, "INSERT INTO sample VALUES (?,?,?,?,?,?,?)"),
      insert_clock_pair_(database_, "INSERT INTO clock_pair VALUES (NULL,?,?,?,?)"),
      insert_event_(database_, "INSERT INTO event VALUES (NULL,?,?,?,?,?)"),
      insert_map_(database_,
                  "INSERT OR REPLACE INTO map (object, view, pose, file, sha256, made) VALUES (?,?,?,?,?,?)"),
      insert_trial_(database_,
                    fmt::format("INSERT INTO trial (trial_id, sitting, trial, attempt, task, {}, status, "
                                "started_ns) VALUES (?,?,?,?,?{},'open',?)",
                                stimulus_columns(), marks_of_stimulus())),
      finish_trial_(
          database_,
          "UPDATE trial SET status = ?, task_screen_onset_ns = ?, presentation_onset_ns = ?, "
          "presentation_end_ns = ?, response_screen_onset_ns = ?, responded_ns = ?, shown_refreshes = ?, "
          "missed_refreshes = ?, drift_deg = ?, answer = ?, lost_flips = ?, lost_samples = ?, "
          "failure = ?, comes_again = ? WHERE trial_id = ?"),
      outside_counts_(counts_so_far(0)), seals_(database_), gaze_rows_(database_) {
    begin_sitting(sitting);
    checkpoint();
} catch (const SQLite::Exception& reason) {
    throw_record_error(session_file, "opening the session for writing", reason);
}

RowWriter::Counts RowWriter::counts_so_far(std::int64_t trial_id) {
    return {trial_id,
            number(database_, "SELECT COALESCE(MAX(n) + 1, 0) FROM flip WHERE trial_id = ?1", trial_id),
            number(database_, "SELECT COALESCE(MAX(n) + 1, 0) FROM sample WHERE trial_id = ?1", trial_id)};
}

void RowWriter::begin_sitting(const Sitting& sitting) {
    SQLite::Transaction transaction(database_);
    sitting_ = static_cast<int>(number(database_, "SELECT COALESCE(MAX(sitting), 0) + 1 + ?1 FROM sitting"));
    if (seals_.is_new())
        seals_.begin(sitting_);
    // Whatever is still open was left by a program that has ended: the lock says so.
    std::vector<std::int64_t> left_open;
    for (Query row(database_, "SELECT trial_id FROM trial WHERE status = 'open' ORDER BY trial_id");
         row.step();)
        left_open.push_back(row.integer());
    database_.exec("UPDATE trial SET status = 'interrupted' WHERE status = 'open'");
    for (const std::int64_t trial_id : left_open)
        seals_.seal_trial(sitting_, trial_id);

    const std::optional<Resumption>& resumed = sitting.resumption;
    insert_values(
        database_, "INTO sitting (sitting, started_utc, closed, resumed, program_version, program_sha256)",
        sitting_, sitting.started_utc, 0, resumed ? std::optional(name_of(resumed->policy)) : std::nullopt,
        sitting.program_version, sitting.program_sha256);
    write_options(sitting.options);
    if (sitting.detection)
        events_.emplace(gaze_rows_, sitting_, *sitting.detection);
    if (resumed) {
        for (const std::int64_t attempt_id : resumed->superseded)
            insert_values(database_, "OR IGNORE INTO superseded", attempt_id, sitting_,
                          "the block was restarted");
        SQLite::Statement take_back(database_, "DELETE FROM given_up WHERE trial = ?");
        for (const int trial : resumed->restarted)
            run_statement(take_back, trial);
        if (resumed->skipped)
            insert_values(database_, "OR REPLACE INTO given_up", *resumed->skipped, sitting_,
                          "interrupted, and skipped");
    }
    forget_file_hash(database_);
    seals_.seal_rest(SealKind::sitting, sitting_);
    transaction.commit();
}

void RowWriter::write_options(const std::vector<RecordedOption>& options) {
    database_.exec(option_tables_sql);
    int n = 0;
    for (const RecordedOption& option : options)
        insert_values(database_, "INTO run_option (sitting, n, name, value)", sitting_, ++n, option.name,
                      option.value);
}

void RowWriter::begin() {
    if (in_transaction_)
        return;
    database_.exec("BEGIN");
    in_transaction_ = true;
    if (!file_hash_.empty())
        note_file_hash(database_, std::exchange(file_hash_, {}));
}

void RowWriter::commit() {
    if (!in_transaction_)
        return;
    if (needs_seal_)
        seals_.seal_rest(SealKind::other, sitting_);
    needs_seal_ = false;
    database_.exec("COMMIT");
    in_transaction_ = false;
}

void RowWriter::roll_back() noexcept {
    database_.tryExec("ROLLBACK");
    in_transaction_ = false;
}

void RowWriter::commit_to_disk() {
    commit();
    database_.exec("PRAGMA synchronous = NORMAL");
}

void RowWriter::write(const FlipRecord& flip) {
    begin();
    Counts& counts = counts_of(flip.trial);
    const FlipReport& report = flip.report;
    run_statement(insert_flip_, counts.trial_id, counts.flips++, flip.refresh_in_trial, report.refresh.value,
                  flip.planned.value, flip.shown.value, flip.pose.value, report.requested, report.swapped,
                  report.vertical_blank, static_cast<int>(report.source), flip.missed_refreshes,
                  report.uncertainty, flip.step);
}

void RowWriter::write(const SlotFlip& flip) {
    begin();
    run_statement(insert_slot_flip_, counts_of(flip.trial).trial_id, flip.refresh_in_trial, flip.place,
                  flip.planned.value, flip.shown.value, flip.pose.value);
}

void RowWriter::write(const SteeredFlip& flip) {
    begin();
    run_statement(insert_steered_flip_, counts_of(flip.trial).trial_id, flip.refresh_in_trial, flip.place,
                  flip.level < 0 ? std::nullopt : std::optional(flip.level), flip.input_at);
}

void RowWriter::write(const MissedRefresh& refresh) {
    begin();
    run_statement(insert_missed_, counts_of(refresh.trial).trial_id, refresh.refresh_in_trial,
                  refresh.refresh.value, refresh.planned.value, refresh.shown.value, refresh.pose.value,
                  refresh.vertical_blank, refresh.uncertainty);
}

void RowWriter::write(const SampleRow& row) {
    begin();
    const GazeSample& sample = row.sample;
    Counts& counts = counts_of(row.trial);
    using Pixels = std::optional<double>;
    run_statement(insert_sample_, counts.trial_id, counts.samples++, sample.sampled_at,
                  static_cast<int>(sample.eye), sample.gaze ? Pixels(sample.gaze->x_px) : std::nullopt,
                  sample.gaze ? Pixels(sample.gaze->y_px) : std::nullopt,
                  shortest_decimal(sample.pupil_area));
    if (events_ && row.trial == open_trial_)
        events_->sample(sample);
}

/// Outside of attempts nothing is kept: a trial's rows are what its seal covers.
void RowWriter::write(const TrackerItemRow& row) {
    if (row.trial < 0 || row.trial != open_trial_)
        return;
    begin();
    if (const auto* detail = std::get_if<SampleDetail>(&row.item))
        gaze_rows_.detail(*detail);
    else if (const std::optional<GazeEvent> event = gaze_event_of(row.item))
        gaze_rows_.event(*event);
}

void RowWriter::write(const RecordedCalibration& calibration) {
    begin();
    gaze_rows_.calibration(sitting_, calibration);
}

std::optional<std::int64_t> RowWriter::attempt_of(int trial) const {
    return trial >= 0 && trial == open_trial_ ? std::optional(trial_counts_.trial_id) : std::nullopt;
}

std::optional<std::int64_t> RowWriter::attempt_at(int trial, SessionTime at) const {
    for (auto attempt = attempts_.rbegin(); attempt != attempts_.rend(); ++attempt)
        if (attempt->trial == trial && attempt->at <= at)
            return attempt->trial_id;
    return {};
}

void RowWriter::write(const std::vector<RecordedButton>& buttons) {
    begin();
    database_.exec(device_tables_sql);
    for (const RecordedButton& button : buttons)
        insert_values(database_,
                      "INTO button_change (sitting, at_ns, uncertainty_ns, trial, attempt_id, box, used_by, "
                      "button, name, is_down, device_us, meaning)",
                      sitting_, button.at, button.uncertainty, number_of_trial(button.trial),
                      attempt_of(button.trial), button.box, button.is_operators ? "operator" : "observer",
                      button.button, button.name, button.is_down, button.device_time, button.meaning);
}

void RowWriter::write(const std::vector<RecordedMarker>& markers) {
    begin();
    database_.exec(device_tables_sql);
    for (const RecordedMarker& marker : markers)
        insert_values(database_,
                      "INTO marker (sitting, at_ns, trial, attempt_id, output, text, code, is_sent, "
                      "not_before_ns, not_after_ns, planned_refresh, shown_refresh)",
                      sitting_, marker.at, number_of_trial(marker.trial), attempt_at(marker.trial, marker.at),
                      marker.output, marker.text, marker.code, marker.is_sent, marker.not_before,
                      marker.not_after, marker.planned_refresh, marker.shown_refresh);
}

void RowWriter::write(const std::vector<RecordedKeyPress>& presses) {
    begin();
    database_.exec(device_tables_sql);
    for (const RecordedKeyPress& press : presses)
        insert_values(
            database_,
            "INTO key_press (sitting, at_ns, uncertainty_ns, trial, attempt_id, device, name, code, "
            "modifiers, text, screen, meaning)",
            sitting_, press.at, press.uncertainty, number_of_trial(press.trial),
            attempt_at(press.trial, press.at), press.device, press.name, press.code, press.modifiers,
            press.text, name_of(press.screen), press.meaning);
}

void RowWriter::write(const GazeYield& gaze) {
    begin();
    insert_values(database_, "OR REPLACE INTO trial_gaze (trial_id, samples, without_gaze, missing)",
                  trial_counts_.trial_id, gaze.samples, gaze.without_gaze, gaze.missing);
}

void RowWriter::write(const ClockPair& pair) {
    begin();
    run_statement(insert_clock_pair_, sitting_, pair.before, pair.other, pair.after);
}

void RowWriter::write(const EventRow& event) {
    begin();
    run_statement(insert_event_, sitting_, event.at, number_of_trial(event.trial), event.kind, event.detail);
}

void RowWriter::write(const RecordedMap& map) {
    begin_sealed();
    run_statement(insert_map_, map.viewed.object, map.viewed.view, map.pose.value, map.file, map.sha256,
                  map.made == RecordedMap::Made::prepared ? "prepared" : "live");
}

void RowWriter::write(const RecordedBox& box) {
    begin_sealed();
    database_.exec(box_tables_sql);
    const bool is_there = box.use == RecordedBox::Use::box;
    insert_values(database_,
                  "OR REPLACE INTO display_box (sitting, use, port, product, serial_number, firmware_date, "
                  "mode, gamma_table, settled_after_ns, video_rate_hz)",
                  sitting_, name_of(box.use), box.port, box.product, box.serial_number, box.firmware_date,
                  box.mode, box.gamma_table, is_there ? std::optional(box.settled_after) : std::nullopt,
                  is_there ? std::optional(box.video_rate_hz) : std::nullopt);
}

void RowWriter::write(const std::vector<BoxClockPair>& readings) {
    begin();
    database_.exec(box_tables_sql);
    for (const BoxClockPair& reading : readings)
        insert_values(database_, "INTO box_clock_pair (sitting, before_ns, box_us, after_ns)", sitting_,
                      reading.before, reading.other, reading.after);
}

void RowWriter::write(const RecordedConsent& consent) {
    begin_sealed();
    database_.exec(observer_tables_sql);
    insert_values(database_, "INTO consent (sitting, observer, accepted, at_ns, at_utc, text_sha256)",
                  sitting_, consent.observer, consent.accepted, consent.at, consent.utc, consent.text_sha256);
}

void RowWriter::write(const RecordedAnswer& answer) {
    begin();
    database_.exec(observer_tables_sql);
    insert_values(database_,
                  "OR REPLACE INTO answer_recording (trial_id, file, sha256, device, sample_rate_hz, "
                  "measured_rate_hz, bits, input_latency_ns, samples, onset_sample, onset_uncertainty_ns, "
                  "overruns, lost_samples, peak_dbfs, noise_dbfs, clipped_samples, voice_onset_ns, "
                  "voice_end_ns, fault)",
                  trial_counts_.trial_id, answer.file, answer.sha256, answer.device, answer.sample_rate_hz,
                  answer.measured_rate_hz, answer.bits, answer.input_latency, answer.samples,
                  answer.onset_sample, answer.onset_uncertainty, answer.overruns, answer.lost_samples,
                  answer.peak_dbfs, answer.noise_dbfs, answer.clipped_samples, answer.voice_onset,
                  answer.voice_end, answer.fault);
}

void RowWriter::write(const std::vector<RecordedObserverField>& fields) {
    begin_sealed();
    database_.exec(observer_tables_sql);
    // A form replaces what was filled in at the same moment.
    const std::string asked = fields.empty() ? std::string(form_at_begin) : fields.front().asked;
    SQLite::Statement forget(database_,
                             "DELETE FROM observer_field WHERE COALESCE((SELECT asked FROM observer_form "
                             "WHERE observer_form.field = observer_field.id), 'begin') = ?1");
    forget.bind(1, asked);
    forget.exec();
    for (const RecordedObserverField& field : fields) {
        insert_values(database_, "INTO observer_field (id, title, value)", field.id, field.title,
                      field.value);
        insert_values(database_, "OR REPLACE INTO observer_form (field, sitting, asked, at_ns)", field.id,
                      sitting_, field.asked, field.at);
    }
}

void RowWriter::write(const TrialStart& start) {
    const Trial& trial = start.trial;
    begin();
    trial_counts_ = {number(database_, "SELECT COALESCE(MAX(trial_id), 0) + 1 + ?1 FROM trial"), 0, 0};
    open_trial_ = trial.index;
    attempts_.push_back({trial.index, start.at, trial_counts_.trial_id});
    const std::int64_t attempt =
        1 + number(database_, "SELECT COUNT(*) FROM trial WHERE trial = ?1", trial.index);
    run_statement(insert_trial_, trial_counts_.trial_id, sitting_, trial.index, attempt, trial.task,
                  trial.stimulus, start.at);
    for (std::size_t i = 0; i < trial.shown_count(); ++i) {
        const auto [stimulus, slot] = trial.shown(i);
        insert_values(database_,
                      fmt::format("INTO presentation (trial_id, place, slot, {})", stimulus_columns()),
                      trial_counts_.trial_id, static_cast<int>(i), slot, stimulus);
    }
    gaze_rows_.begin_trial(trial_counts_.trial_id);
    if (events_)
        events_->begin_trial();
}

/// The first and the last refresh at which a flip showed each.
void RowWriter::note_refreshes_of_presentations() {
    SQLite::Statement first(
        database_,
        "UPDATE presentation SET (first_refresh, last_refresh) = "
        "(SELECT MIN(refresh_in_trial), MAX(refresh_in_trial) FROM flip "
        "WHERE flip.trial_id = presentation.trial_id AND shown >= 0) WHERE trial_id = ? AND place = 0");
    run_statement(first, trial_counts_.trial_id);
    SQLite::Statement further(
        database_,
        "UPDATE presentation SET (first_refresh, last_refresh) = "
        "(SELECT MIN(refresh_in_trial), MAX(refresh_in_trial) FROM slot_flip "
        "WHERE slot_flip.trial_id = presentation.trial_id AND slot_flip.place = presentation.place "
        "AND shown >= 0) WHERE trial_id = ? AND place > 0");
    run_statement(further, trial_counts_.trial_id);
}

void RowWriter::write(const TrialFinish& finish) {
    OVERT_EXPECTS(finish.trial.index == open_trial_);
    const TrialOutcome& outcome = finish.outcome;
    commit();
    database_.exec("PRAGMA synchronous = FULL"); // makes the next commit flush the whole log
    begin();
    if (events_)
        events_->finish_trial();
    const std::string_view afterwards = name_of(outcome.afterwards);
    run_statement(finish_trial_, outcome.status == TrialOutcome::Status::completed ? "completed" : "aborted",
                  outcome.task_screen_onset, outcome.presentation_onset, outcome.presentation_end,
                  outcome.response_screen_onset, outcome.responded_at, outcome.shown_refreshes,
                  outcome.missed_refreshes, outcome.drift, outcome.answer, finish.lost_flips,
                  finish.lost_samples,
                  outcome.failure.empty() ? std::nullopt : std::optional(outcome.failure),
                  afterwards.empty() ? std::nullopt : std::optional(afterwards), trial_counts_.trial_id);
    note_refreshes_of_presentations();
    if (outcome.responded_uncertainty)
        insert_values(database_, "INTO response_press (trial_id, uncertainty_ns)", trial_counts_.trial_id,
                      outcome.responded_uncertainty);
    if (const std::optional<SwapModes>& swaps = outcome.swaps)
        insert_values(database_, "INTO swap_modes (trial_id, flipped, copied, suboptimal_copied, skipped)",
                      trial_counts_.trial_id, swaps->flipped, swaps->copied, swaps->suboptimal_copied,
                      swaps->skipped);
    int number = 0;
    for (const AttemptStep& step : outcome.steps)
        insert_values(database_,
                      "INTO step (trial_id, n, kind, id, planned_refreshes, drawn_s, still_frame, begin_ns, "
                      "end_ns, ended_by, gaze_onset_us, gaze_detected_us, places)",
                      trial_counts_.trial_id, ++number, step.kind, step.id, step.planned_refreshes,
                      step.drawn_s, step.still_frame, step.begin, step.end,
                      step.ended_by ? std::optional(name_of(*step.ended_by)) : std::nullopt, step.gaze_onset,
                      step.gaze_detected, text_of_places(step.places));
    write_answers(outcome);
    write_probe_rows(database_, trial_counts_.trial_id, outcome);
    for (const int trial : outcome.left_out)
        insert_values(database_, "OR REPLACE INTO given_up", trial, sitting_, "the criterion was met");
    seals_.seal_trial(sitting_, trial_counts_.trial_id);
    if (!outcome.left_out.empty())
        seals_.seal_rest(SealKind::other, sitting_);
    forget_file_hash(database_);
    commit_to_disk();
}

/// What could be set, and what was, with the numbers of the answers.
void RowWriter::write_matches(const TrialOutcome& outcome) {
    int number = 0;
    for (const GivenAnswer& given : outcome.given) {
        ++number;
        int axis = 0;
        for (const MatchSetting& set : given.settings)
            insert_values(database_,
                          "INTO match_setting (trial_id, n, axis, slot, along, start, final, low, high, "
                          "reference, changes, reversals, stopped_low, stopped_high)",
                          trial_counts_.trial_id, number, axis++, given.slot, set.along, set.start, set.final,
                          set.low, set.high, set.reference, set.changes, set.reversals, set.stopped_low,
                          set.stopped_high);
        for (const MatchLevel& level : given.levels)
            insert_values(
                database_,
                fmt::format("INTO match_level (trial_id, n, level, {}, first, second)", stimulus_columns()),
                trial_counts_.trial_id, number, level.level, level.stimulus, level.values.front(),
                level.values.size() > 1 ? std::optional(level.values[1]) : std::nullopt);
    }
}

void RowWriter::write_answers(const TrialOutcome& outcome) {
    int number = 0;
    for (const GivenAnswer& given : outcome.given)
        insert_values(
            database_,
            "INTO given_answer (trial_id, n, id, item, kind, is_missed, value, number, key, device, "
            "correct, is_correct, zero, stimulus_onset_ns, window_onset_ns, window_end_ns, "
            "screen_onset_ns, first_input_ns, answered_ns, uncertainty_ns, is_tied, place, mapping, "
            "changes)",
            trial_counts_.trial_id, ++number, given.id, given.item, given.kind, given.is_missed, given.value,
            given.number, given.key, given.device, given.correct, given.is_correct, name_of(given.zero),
            given.stimulus_onset, given.window_onset, given.window_end, given.screen_onset,
            given.first_input_at, given.answered_at, given.uncertainty, given.is_tied, given.place,
            given.mapping, given.changes);
    write_matches(outcome);
    number = 0;
    for (const AnswerInput& taken : outcome.inputs) {
        const ObserverInput& input = taken.input;
        using Kind = ObserverInput::Kind;
        const bool points = input.kind == Kind::pointer_moved || input.kind == Kind::pointer_down ||
                            input.kind == Kind::pointer_up;
        const bool turns = input.kind == Kind::wheel || input.kind == Kind::dial || input.kind == Kind::tilt;
        const auto of = [](bool is_there, auto value) {
            return is_there ? std::optional(value) : std::nullopt;
        };
        insert_values(database_,
                      "INTO answer_input (trial_id, n, id, item, kind, at_ns, uncertainty_ns, device, key, "
                      "character, right_px, down_px, button, steps, state, has_counted, number)",
                      trial_counts_.trial_id, ++number, taken.id, taken.item, name_of(input.kind), input.at,
                      input.uncertainty, input.device.view(), input.key.view(),
                      of(input.kind == Kind::text, static_cast<int>(input.character)),
                      of(points, input.right_px), of(points, input.down_px), of(points, input.button),
                      of(turns, input.steps), name_of(taken.state), taken.has_counted, taken.number);
    }
}

void RowWriter::checkpoint() noexcept {
    // Nobody is waited for who reads the session just now.
    sqlite3_busy_timeout(database_.getHandle(), 0);
    try {
        Query refused(database_, "PRAGMA wal_checkpoint(TRUNCATE)");
        if (refused.step() && refused.integer() == 0)
            file_hash_ = hash_of_folded_rows(database_);
    } catch (const SQLite::Exception&) {
        file_hash_.clear();
    }
    sqlite3_busy_timeout(database_.getHandle(), writer_patience_ms);
}

void RowWriter::close() {
    commit();
    database_.exec("PRAGMA synchronous = FULL");
    begin();
    SQLite::Statement close_sitting(database_, "UPDATE sitting SET closed = 1 WHERE sitting = ?");
    run_statement(close_sitting, sitting_);
    seals_.seal_rest(SealKind::end, sitting_);
    forget_file_hash(database_);
    commit_to_disk();
    try {
        static_cast<void>(fold_log(database_));
    } catch (const SQLite::Exception&) {
        // All is recorded; what is left to do needs more room on the disk.
    }
}

} // namespace overt
