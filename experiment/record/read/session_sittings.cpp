/// What belongs to the sittings of a session: the observer's consent and form, clocks, display boxes, and how
/// each sitting took the session up.
#include "experiment/record/gaze_rows.h"
#include "experiment/record/read/session_record.h"
#include "experiment/record/sql.h"

namespace overt {
namespace {

RecordedBox::Use use_from(const std::string& word) {
    for (const auto use : {RecordedBox::Use::box, RecordedBox::Use::declined, RecordedBox::Use::simulated})
        if (word == name_of(use))
            return use;
    return RecordedBox::Use::no_mode;
}

} // namespace

std::vector<RecordedOption> SessionRecord::run_options(int sitting) const {
    return reading_session(file_, [&] {
        return read_later_rows(
            database(), "run_option", "SELECT name, value FROM run_option WHERE sitting = ?1 ORDER BY n",
            [](Query& row) {
                std::string name = row.text();
                return RecordedOption{std::move(name), row.text()};
            },
            static_cast<std::int64_t>(sitting));
    });
}

std::vector<RecordedConsent> SessionRecord::consents() const {
    return reading_session(file_, [&] {
        return read_later_rows(
            database(), "consent",
            "SELECT observer, accepted, at_ns, at_utc, text_sha256 FROM consent ORDER BY n", [](Query& row) {
                return RecordedConsent{row.text(), row.integer() != 0, row.session_time(), row.text(),
                                       row.text()};
            });
    });
}

std::vector<RecordedObserverField> SessionRecord::observer_fields() const {
    return reading_session(file_, [&] {
        const char* const sql =
            has_table(database(), "observer_form")
                ? "SELECT f.id, title, value, COALESCE(asked, 'begin'), at_ns FROM observer_field f "
                  "LEFT JOIN observer_form o ON o.field = f.id ORDER BY n"
                : "SELECT id, title, value, 'begin', NULL FROM observer_field ORDER BY n";
        return read_later_rows(database(), "observer_field", sql, [](Query& row) {
            RecordedObserverField field;
            row.read(field.id, field.title, field.value, field.asked, field.at);
            return field;
        });
    });
}

std::optional<GazeSource> SessionRecord::gaze_source(int sitting) const {
    return reading_session(file_, [&] {
        return has_table(database(), "gaze_source") ? read_gaze_source(database(), sitting) : std::nullopt;
    });
}

std::string SessionRecord::started_utc(int sitting) const {
    return reading_session(file_, [&] {
        Query row(database(), "SELECT started_utc FROM sitting WHERE sitting = ?");
        row.bind(1, sitting);
        return row.step() ? row.text() : std::string();
    });
}

std::vector<ClockPair> SessionRecord::clock_pairs(int sitting) const {
    return reading_session(file_, [&] {
        return read_rows(
            database(),
            "SELECT before_ns, tracker_us, after_ns FROM clock_pair WHERE sitting = ? ORDER BY id",
            [](Query& row) {
                return ClockPair{row.session_time(), row.tracker_time(), row.session_time()};
            },
            sitting);
    });
}

std::vector<RecordedCalibration> SessionRecord::calibrations(int sitting) const {
    return reading_session(file_, [&] {
        return has_table(database(), "calibration") ? read_calibrations(database(), sitting)
                                                    : std::vector<RecordedCalibration>();
    });
}

std::optional<ClockMap> SessionRecord::clock_map(const TrialRecord& trial) const {
    const std::optional<ClockMap> of_sitting = clock_map(trial.sitting);
    const SessionTime onset = trial.outcome.presentation_onset;
    return of_sitting ? std::optional(of_sitting->at(trial.reached(onset) ? onset : trial.started))
                      : std::nullopt;
}

std::vector<std::pair<int, RecordedBox>> SessionRecord::display_boxes() const {
    return reading_session(file_, [&] {
        return read_later_rows(
            database(), "display_box",
            "SELECT sitting, use, port, product, serial_number, firmware_date, mode, gamma_table, "
            "COALESCE(settled_after_ns, 0), COALESCE(video_rate_hz, 0.0) FROM display_box ORDER BY sitting",
            [](Query& row) {
                const int sitting = row.small();
                return std::pair{sitting, RecordedBox{use_from(row.text()), row.text(), row.text(),
                                                      row.text(), row.text(), row.text(), row.text(),
                                                      SessionDuration(row.integer()), row.real()}};
            });
    });
}

std::vector<BoxClockPair> SessionRecord::box_clock_readings(int sitting) const {
    return reading_session(file_, [&] {
        return read_later_rows(
            database(), "box_clock_pair",
            "SELECT before_ns, box_us, after_ns FROM box_clock_pair WHERE sitting = ? ORDER BY id",
            [](Query& row) {
                return BoxClockPair{row.session_time(), BoxTime(BoxClock::duration(row.integer())),
                                    row.session_time()};
            },
            sitting);
    });
}

std::vector<std::pair<int, std::string>> SessionRecord::resumptions() const {
    return reading_session(file_, [&] {
        const bool tells_policy = has_column(database(), "sitting", "resumed");
        return read_rows(database(),
                         tells_policy
                             ? "SELECT sitting, resumed FROM sitting WHERE sitting > 1 ORDER BY sitting"
                             : "SELECT sitting, NULL FROM sitting WHERE sitting > 1 ORDER BY sitting",
                         [](Query& row) {
                             const int sitting = row.small();
                             return std::pair{sitting, row.text()};
                         });
    });
}

std::vector<int> SessionRecord::skipped_trials() const {
    return reading_session(file_, [&] {
        return read_later_rows(database(), "given_up", "SELECT trial FROM given_up ORDER BY trial",
                               [](Query& row) { return row.small(); });
    });
}

bool SessionRecord::closed_in_order(int sitting) const {
    return reading_session(file_, [&] {
        Query row(database(), "SELECT closed FROM sitting WHERE sitting = ?1");
        row.bind(1, sitting);
        return row.step() && row.integer() != 0;
    });
}

bool SessionRecord::closed_in_order() const {
    return reading_session(file_, [&] {
        Query row(database(), "SELECT closed FROM sitting ORDER BY sitting DESC LIMIT 1");
        return row.step() && row.integer() != 0;
    });
}

} // namespace overt
