#include "experiment/record/session_record.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "experiment/error.h"
#include "experiment/record/gaze_rows.h"
#include "experiment/record/header_checks.h"
#include "experiment/record/header_rows.h"
#include "experiment/record/session_file.h"
#include "experiment/record/session_schema.h"
#include "experiment/record/sql.h"

namespace overt {
namespace {

/// Runs a reader; what SQLite has to complain of becomes a sentence with the file's name.
template <class Read> auto reading(const std::filesystem::path& file, Read read) {
    try {
        return read();
    } catch (const SQLite::Exception& reason) {
        throw_record_error(file, "reading the session", reason);
    }
}

TrialRecord::Status status_from(const std::string& word) {
    for (const auto status :
         {TrialRecord::Status::completed, TrialRecord::Status::aborted, TrialRecord::Status::interrupted})
        if (word == name_of(status))
            return status;
    return TrialRecord::Status::open;
}

TrialOutcome::Afterwards afterwards_from(const std::string& word) {
    if (word == "now")
        return TrialOutcome::Afterwards::now;
    if (word == "end-of-block")
        return TrialOutcome::Afterwards::end_of_block;
    return word == "never" ? TrialOutcome::Afterwards::never : TrialOutcome::Afterwards::undecided;
}

TrialRecord read_trial(Query& row) {
    TrialRecord record;
    record.id = row.integer();
    record.sitting = row.small();
    record.trial.index = row.small();
    record.attempt = row.small();
    record.trial.task = row.small();
    record.trial.condition.sculpture = row.small();
    record.trial.condition.material = row.small();
    record.status = status_from(row.text());
    record.started = row.session_time();
    TrialOutcome& outcome = record.outcome;
    outcome.status = record.status == TrialRecord::Status::completed ? TrialOutcome::Status::completed
                                                                     : TrialOutcome::Status::aborted;
    outcome.task_screen_onset = row.session_time();
    outcome.presentation_onset = row.session_time();
    outcome.presentation_end = row.session_time();
    outcome.response_screen_onset = row.session_time();
    outcome.responded_at = row.session_time();
    outcome.shown_refreshes = row.small();
    outcome.missed_refreshes = row.small();
    if (const auto drift_deg = row.optional_real())
        outcome.drift = Degrees{*drift_deg};
    outcome.answer = row.text();
    record.lost_flips = row.integer();
    record.lost_samples = row.integer();
    outcome.failure = row.text();
    outcome.afterwards = afterwards_from(row.text());
    record.is_superseded = row.integer() != 0;
    record.counts = record.status == TrialRecord::Status::completed && !record.is_superseded;
    return record;
}

std::vector<TrialRecord> read_trials(const SQLite::Database& database) {
    std::vector<TrialRecord> trials;
    // Sessions of earlier programs know of nothing that was completed and does not count.
    const bool tells_fates = has_column(database, "trial", "comes_again");
    const std::string sql = fmt::format(
        "SELECT trial_id, sitting, trial, attempt, task, sculpture, material, status, started_ns, "
        "task_screen_onset_ns, presentation_onset_ns, presentation_end_ns, response_screen_onset_ns, "
        "responded_ns, shown_refreshes, missed_refreshes, drift_deg, answer, lost_flips, lost_samples, {} "
        "FROM trial ORDER BY trial_id",
        tells_fates ? "failure, comes_again, trial_id IN (SELECT attempt_id FROM superseded)"
                    : "NULL, NULL, 0");
    for (Query row(database, sql.c_str()); row.step();)
        trials.push_back(read_trial(row));
    return trials;
}

FlipRecord read_flip(Query& row, int trial) {
    FlipRecord flip;
    flip.trial = trial;
    flip.refresh_in_trial = row.small();
    flip.report.refresh.value = row.integer();
    flip.planned.value = row.small();
    flip.shown.value = row.small();
    flip.pose.value = row.small();
    flip.report.requested = row.session_time();
    flip.report.swapped = row.session_time();
    flip.report.vertical_blank = row.session_time();
    flip.report.source = static_cast<VblankSource>(row.small());
    flip.report.missed_refreshes = row.small();
    flip.report.uncertainty = SessionDuration(row.integer());
    return flip;
}

GazeSample read_sample(Query& row) {
    GazeSample sample;
    sample.sampled_at = row.tracker_time();
    sample.eye = row.small() == 0 ? Eye::left : Eye::right;
    const auto x_px = row.optional_real(), y_px = row.optional_real();
    if (x_px && y_px)
        sample.gaze = ScreenPoint{*x_px, *y_px};
    sample.pupil_area = static_cast<float>(row.real());
    return sample;
}

RecordedBox::Use use_from(const std::string& word) {
    for (const auto use : {RecordedBox::Use::box, RecordedBox::Use::declined, RecordedBox::Use::simulated})
        if (word == name_of(use))
            return use;
    return RecordedBox::Use::no_mode;
}

bool has_table(const SQLite::Database& database, const char* name) {
    Query row(
        database,
        fmt::format("SELECT COUNT(*) FROM sqlite_schema WHERE type = 'table' AND name = '{}'", name).c_str());
    return row.step() && row.integer() > 0;
}

/// Indices that lead out of the header's lists would be undefined behaviour in every reader.
void check_indices(const SessionHeader& header, const std::vector<TrialRecord>& trials,
                   const std::filesystem::path& file) {
    const auto within = [](int index, std::size_t count) {
        return index >= 0 && static_cast<std::size_t>(index) < count;
    };
    for (const TrialRecord& record : trials) {
        const Trial& trial = record.trial;
        if (!within(trial.task, header.tasks.size()) ||
            !within(trial.condition.sculpture, header.sculptures.size()) ||
            !within(trial.condition.material, header.materials.size()))
            throw RecordError(
                fmt::format("{}: table trial, trial_id {}: it names a task, sculpture or material "
                            "that the session does not have: the file is damaged.",
                            file.string(), record.id));
    }
}

} // namespace

std::string_view name_of(TrialRecord::Status status) {
    switch (status) {
    case TrialRecord::Status::open:
        return "open";
    case TrialRecord::Status::completed:
        return "completed";
    case TrialRecord::Status::aborted:
        return "aborted";
    case TrialRecord::Status::interrupted:
        return "interrupted";
    }
    return "unknown";
}

SessionRecord::SessionRecord(const std::filesystem::path& session)
    : directory_(std::filesystem::is_directory(session) ? session : session.parent_path()),
      file_(std::filesystem::is_directory(session) ? session / session_file_name : session),
      database_(std::make_unique<SQLite::Database>(open_session_file(file_, SessionFileUse::read))) {
    reading(file_, [&] {
        header_ = read_session_header(*database_);
        trials_ = read_trials(*database_);
        for (TrialRecord& trial : trials_) {
            const auto planned = static_cast<std::size_t>(trial.trial.index);
            if (trial.trial.index >= 0 && planned < header_.schedule.trials.size())
                trial.trial.block = header_.schedule.trials[planned].block;
        }
    });
    check_header(header_, file_);
    check_indices(header_, trials_, file_);
}
SessionRecord::~SessionRecord() = default;
SessionRecord::SessionRecord(SessionRecord&&) noexcept = default;
SessionRecord& SessionRecord::operator=(SessionRecord&&) noexcept = default;

std::vector<FlipRecord> SessionRecord::flips(const TrialRecord& trial) const {
    return reading(file_, [&] {
        std::vector<FlipRecord> flips;
        const std::string sql =
            fmt::format("SELECT refresh_in_trial, refresh, planned, shown, pose, requested_ns, swapped_ns, "
                        "vertical_blank_ns, source, missed, {} FROM flip WHERE trial_id = ? ORDER BY n",
                        has_column(*database_, "flip", "uncertainty_ns") ? "uncertainty_ns" : "0");
        Query row(*database_, sql.c_str());
        row.bind(1, trial.id);
        while (row.step())
            flips.push_back(read_flip(row, trial.trial.index));
        return flips;
    });
}

std::vector<MissedRefresh> SessionRecord::missed_refreshes(const TrialRecord& trial) const {
    return reading(file_, [&] {
        std::vector<MissedRefresh> missed;
        if (!has_table(*database_, "missed_refresh"))
            return missed;
        Query row(*database_,
                  "SELECT refresh_in_trial, refresh, planned, shown, pose, vertical_blank_ns, "
                  "uncertainty_ns FROM missed_refresh WHERE trial_id = ? ORDER BY refresh_in_trial");
        row.bind(1, trial.id);
        while (row.step())
            missed.push_back({trial.trial.index,
                              row.small(),
                              {row.integer()},
                              {row.small()},
                              {row.small()},
                              {row.small()},
                              row.session_time(),
                              SessionDuration(row.integer())});
        return missed;
    });
}

std::vector<GazeSample> SessionRecord::samples(const TrialRecord& trial) const {
    std::vector<GazeSample> samples;
    read_samples(trial, 65536, [&](std::span<const GazeSample> piece) {
        samples.insert(samples.end(), piece.begin(), piece.end());
    });
    return samples;
}

void SessionRecord::read_samples(const TrialRecord& trial, std::size_t most,
                                 const std::function<void(std::span<const GazeSample>)>& take) const {
    reading(file_, [&] {
        std::vector<GazeSample> piece;
        Query row(*database_,
                  "SELECT tracker_us, eye, x_px, y_px, pupil_area FROM sample WHERE trial_id = ? ORDER BY n");
        row.bind(1, trial.id);
        while (row.step()) {
            piece.push_back(read_sample(row));
            if (piece.size() == most) {
                take(piece);
                piece.clear();
            }
        }
        if (!piece.empty())
            take(piece);
    });
}

std::optional<std::pair<TrackerTime, TrackerTime>>
SessionRecord::sample_span(const TrialRecord& trial) const {
    return reading(file_, [&]() -> std::optional<std::pair<TrackerTime, TrackerTime>> {
        Query row(*database_, "SELECT COUNT(*), COALESCE(MIN(tracker_us), 0), COALESCE(MAX(tracker_us), 0) "
                              "FROM sample WHERE trial_id = ?");
        row.bind(1, trial.id);
        if (!row.step() || row.integer() == 0)
            return std::nullopt;
        const TrackerTime first = row.tracker_time();
        return std::pair{first, row.tracker_time()};
    });
}

void SessionRecord::read_gaze_events(const TrialRecord& trial,
                                     const std::function<void(const GazeEvent&)>& take) const {
    reading(file_, [&] {
        if (has_table(*database_, "gaze_event"))
            overt::read_gaze_events(*database_, trial.id, take);
    });
}

void SessionRecord::read_gaze_events_outside(const std::function<void(const GazeEvent&)>& take) const {
    reading(file_, [&] {
        if (has_table(*database_, "gaze_event"))
            overt::read_gaze_events(*database_, 0, take);
    });
}

std::optional<GazeSource> SessionRecord::gaze_source(int sitting) const {
    return reading(file_, [&] {
        return has_table(*database_, "gaze_source") ? read_gaze_source(*database_, sitting) : std::nullopt;
    });
}

SessionRecord::Eyes SessionRecord::eyes(int sitting) const {
    return reading(file_, [&] {
        Query row(
            *database_,
            "SELECT COALESCE(MAX(eye = 0), 0), COALESCE(MAX(eye <> 0), 0) FROM sample WHERE trial_id IN "
            "(SELECT trial_id FROM trial WHERE sitting = ?)");
        row.bind(1, sitting);
        row.step();
        Eyes eyes;
        eyes.left = row.integer() != 0;
        eyes.right = row.integer() != 0;
        return eyes;
    });
}

std::vector<RecordedEvent> SessionRecord::events() const {
    std::vector<RecordedEvent> events;
    read_events([&](const RecordedEvent& event) { events.push_back(event); });
    return events;
}

void SessionRecord::read_events(const std::function<void(const RecordedEvent&)>& take) const {
    reading(file_, [&] {
        for (Query row(*database_, "SELECT sitting, at_ns, trial, kind, detail FROM event ORDER BY id");
             row.step();)
            take(
                {row.small(), row.session_time(), row.optional_small().value_or(-1), row.text(), row.text()});
    });
}

std::vector<RecordedConsent> SessionRecord::consents() const {
    return reading(file_, [&] {
        std::vector<RecordedConsent> consents;
        if (!has_table(*database_, "consent"))
            return consents;
        for (Query row(*database_,
                       "SELECT observer, accepted, at_ns, at_utc, text_sha256 FROM consent ORDER BY n");
             row.step();)
            consents.push_back({row.text(), row.integer() != 0, row.session_time(), row.text(), row.text()});
        return consents;
    });
}

std::optional<RecordedAnswer> SessionRecord::answer_recording(const TrialRecord& trial) const {
    return reading(file_, [&]() -> std::optional<RecordedAnswer> {
        if (!has_table(*database_, "answer_recording"))
            return std::nullopt;
        Query row(*database_,
                  "SELECT file, sha256, device, sample_rate_hz, measured_rate_hz, bits, "
                  "input_latency_ns, samples, onset_sample, onset_uncertainty_ns, overruns, "
                  "lost_samples, peak_dbfs, noise_dbfs, clipped_samples, fault, "
                  "COALESCE(voice_onset_ns, 0), voice_onset_ns IS NULL, COALESCE(voice_end_ns, 0), "
                  "voice_end_ns IS NULL FROM answer_recording WHERE trial_id = ?");
        row.bind(1, trial.id);
        if (!row.step())
            return std::nullopt;
        RecordedAnswer answer;
        answer.trial = trial.trial.index;
        answer.file = row.text();
        answer.sha256 = row.text();
        answer.device = row.text();
        answer.sample_rate_hz = row.real();
        answer.measured_rate_hz = row.real();
        answer.bits = row.small();
        answer.input_latency = SessionDuration(row.integer());
        answer.samples = row.integer();
        answer.onset_sample = row.real();
        answer.onset_uncertainty = SessionDuration(row.integer());
        answer.overruns = row.integer();
        answer.lost_samples = row.integer();
        answer.peak_dbfs = row.real();
        answer.noise_dbfs = row.real();
        answer.clipped_samples = row.integer();
        answer.fault = row.text();
        const auto time_or_nothing = [&]() -> std::optional<SessionDuration> {
            const SessionDuration time(row.integer());
            return row.integer() == 0 ? std::optional(time) : std::nullopt;
        };
        answer.voice_onset = time_or_nothing();
        answer.voice_end = time_or_nothing();
        return answer;
    });
}

std::vector<RecordedObserverField> SessionRecord::observer_fields() const {
    return reading(file_, [&] {
        std::vector<RecordedObserverField> fields;
        if (!has_table(*database_, "observer_field"))
            return fields;
        for (Query row(*database_, "SELECT id, title, value FROM observer_field ORDER BY n"); row.step();) {
            RecordedObserverField field;
            field.id = row.text();
            field.title = row.text();
            field.value = row.text();
            fields.push_back(std::move(field));
        }
        return fields;
    });
}

std::vector<ClockPair> SessionRecord::clock_pairs(int sitting) const {
    return reading(file_, [&] {
        std::vector<ClockPair> pairs;
        Query row(*database_,
                  "SELECT before_ns, tracker_us, after_ns FROM clock_pair WHERE sitting = ? ORDER BY id");
        row.bind(1, sitting);
        while (row.step())
            pairs.push_back(
                {row.session_time(), row.tracker_time(), row.session_time()});
        return pairs;
    });
}

std::optional<ClockMap> SessionRecord::clock_map(int sitting) const {
    const std::vector<ClockPair> pairs = clock_pairs(sitting);
    return pairs.empty() ? std::nullopt : std::optional<ClockMap>(ClockMap(pairs));
}

std::vector<std::pair<int, RecordedBox>> SessionRecord::display_boxes() const {
    return reading(file_, [&] {
        std::vector<std::pair<int, RecordedBox>> boxes;
        if (!has_table(*database_, "display_box"))
            return boxes;
        for (Query row(*database_, "SELECT sitting, use, port, product, serial_number, firmware_date, mode, "
                                   "gamma_table, COALESCE(settled_after_ns, 0), COALESCE(video_rate_hz, 0.0) "
                                   "FROM display_box ORDER BY sitting");
             row.step();) {
            const int sitting = row.small();
            boxes.emplace_back(sitting, RecordedBox{use_from(row.text()), row.text(), row.text(), row.text(),
                                                    row.text(), row.text(), row.text(),
                                                    SessionDuration(row.integer()), row.real()});
        }
        return boxes;
    });
}

std::vector<BoxClockReading> SessionRecord::box_clock_readings(int sitting) const {
    return reading(file_, [&] {
        std::vector<BoxClockReading> readings;
        if (!has_table(*database_, "box_clock_pair"))
            return readings;
        Query row(*database_,
                  "SELECT before_ns, box_us, after_ns FROM box_clock_pair WHERE sitting = ? ORDER BY id");
        row.bind(1, sitting);
        while (row.step())
            readings.push_back({row.session_time(), row.integer(), row.session_time()});
        return readings;
    });
}

std::optional<KnownInterval> SessionRecord::refresh_interval(int sitting) const {
    const auto known = intervals_.find(sitting);
    if (known != intervals_.end())
        return known->second;
    std::vector<RefreshFit> lines;
    for (const TrialRecord& trial : trials_) {
        if (trial.sitting != sitting)
            continue;
        if (const std::vector<FlipRecord> rows = flips(trial); rows.size() >= 3)
            lines.push_back(LedgerFit(rows, header_.display.refresh_hz).line());
    }
    return intervals_[sitting] = common_interval(lines);
}

std::optional<LedgerFit> SessionRecord::ledger_fit(const TrialRecord& trial) const {
    const std::vector<FlipRecord> rows = flips(trial);
    if (rows.empty())
        return std::nullopt;
    return LedgerFit(rows, header_.display.refresh_hz, refresh_interval(trial.sitting));
}

FlipHistory SessionRecord::flip_history(const TrialRecord& trial) const {
    const RecordedDisplay& display = header_.display;
    const std::optional<LedgerFit> fit = ledger_fit(trial);
    // Of an imported session not even the refresh rate may be known.
    if (!fit)
        return FlipHistory({}, {{}, 1.0, 1.0}, {});
    return FlipHistory(fit->flips(),
                       {display.latency, display.refresh_hz, static_cast<double>(display.screen.screen_px.y)},
                       make_page_cycle(header_.animation, display.refresh_hz));
}

SessionTime SessionRecord::last_time() const {
    return reading(file_, [&] {
        Query row(*database_,
                  "SELECT MAX((SELECT COALESCE(MAX(at_ns), 0) FROM event), "
                  "(SELECT COALESCE(MAX(MAX(started_ns, COALESCE(responded_ns, 0))), 0) FROM trial), "
                  "(SELECT COALESCE(MAX(after_ns), 0) FROM clock_pair), "
                  "(SELECT COALESCE(MAX(vertical_blank_ns), 0) FROM flip))");
        row.step();
        SessionTime last = row.session_time();
        if (has_table(*database_, "box_clock_pair")) {
            Query box(*database_, "SELECT COALESCE(MAX(after_ns), 0) FROM box_clock_pair");
            box.step();
            last = std::max(last, box.session_time());
        }
        return last;
    });
}

std::vector<std::pair<int, std::string>> SessionRecord::resumptions() const {
    return reading(file_, [&] {
        std::vector<std::pair<int, std::string>> resumptions;
        const char* const sql =
            has_column(*database_, "sitting", "resumed")
                ? "SELECT sitting, resumed FROM sitting WHERE sitting > 1 ORDER BY sitting"
                : "SELECT sitting, NULL FROM sitting WHERE sitting > 1 ORDER BY sitting";
        for (Query row(*database_, sql); row.step();) {
            const int sitting = row.small();
            resumptions.emplace_back(sitting, row.text());
        }
        return resumptions;
    });
}

std::vector<int> SessionRecord::given_up() const {
    return reading(file_, [&] {
        std::vector<int> trials;
        if (!has_table(*database_, "given_up"))
            return trials;
        for (Query row(*database_, "SELECT trial FROM given_up ORDER BY trial"); row.step();)
            trials.push_back(row.small());
        return trials;
    });
}

bool SessionRecord::is_complete() const {
    std::set<int> done;
    for (const int trial : given_up())
        done.insert(trial);
    for (const TrialRecord& attempt : trials_)
        if (attempt.counts || (attempt.status == TrialRecord::Status::aborted && !attempt.is_superseded &&
                               attempt.outcome.afterwards == TrialOutcome::Afterwards::never))
            done.insert(attempt.trial.index);
    return done.size() == header_.schedule.trials.size() && closed_in_order();
}

bool SessionRecord::closed_in_order() const {
    return reading(file_, [&] {
        Query row(*database_, "SELECT closed FROM sitting ORDER BY sitting DESC LIMIT 1");
        return row.step() && row.integer() != 0;
    });
}

std::vector<std::string> SessionRecord::damages() const {
    std::vector<std::string> damages;
    try {
        for (Query row(*database_, "PRAGMA integrity_check"); row.step();)
            if (const std::string finding = row.text(); finding != "ok")
                damages.push_back(fmt::format("{}: {}", file_.string(), finding));
    } catch (const SQLite::Exception& reason) {
        damages.push_back(fmt::format("{}: {}", file_.string(), reason.what()));
    }
    if (hash_of_text(header_.protocol.text) != header_.protocol.sha256)
        damages.push_back(
            fmt::format("{}: the protocol's text does not have the hash recorded with it.", file_.string()));
    return damages;
}

} // namespace overt
