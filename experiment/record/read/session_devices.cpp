/// What response boxes and outputs of markers did in a session.
#include "experiment/record/read/session_record.h"
#include "experiment/record/sql.h"

namespace overt {
namespace {

/// A column that holds a number, and the one after it, which says that it holds none.
std::optional<std::int64_t> number_or_nothing(Query& row) {
    const std::int64_t number = row.integer();
    return row.integer() == 0 ? std::optional(number) : std::nullopt;
}

} // namespace

std::vector<RecordedButton> SessionRecord::button_changes() const {
    return reading_session(file_, [&] {
        return read_later_rows(
            *database_, "button_change",
            "SELECT sitting, at_ns, uncertainty_ns, COALESCE(trial, -1), attempt_id, attempt_id IS NULL, "
            "box, "
            "used_by = 'operator', button, name, is_down, device_us, device_us IS NULL, meaning "
            "FROM button_change ORDER BY id",
            [](Query& row) {
                RecordedButton button;
                button.sitting = row.small();
                button.at = row.session_time();
                button.uncertainty = SessionDuration(row.integer());
                button.trial = row.small();
                button.attempt_id = number_or_nothing(row);
                button.box = row.text();
                button.is_operators = row.integer() != 0;
                button.button = row.small();
                button.name = row.text();
                button.is_down = row.integer() != 0;
                if (const auto us = number_or_nothing(row))
                    button.device_time = BoxTime(BoxClock::duration(*us));
                button.meaning = row.text();
                return button;
            });
    });
}

std::vector<RecordedMarker> SessionRecord::markers() const {
    return reading_session(file_, [&] {
        return read_later_rows(
            *database_, "marker",
            "SELECT sitting, at_ns, COALESCE(trial, -1), attempt_id, attempt_id IS NULL, output, text, code, "
            "is_sent, not_before_ns, not_after_ns, planned_refresh, "
            "shown_refresh FROM marker ORDER BY id",
            [](Query& row) {
                RecordedMarker marker;
                marker.sitting = row.small();
                marker.at = row.session_time();
                marker.trial = row.small();
                marker.attempt_id = number_or_nothing(row);
                marker.output = row.text();
                marker.text = row.text();
                marker.code = row.small();
                marker.is_sent = row.integer() != 0;
                marker.not_before = row.session_time();
                marker.not_after = row.session_time();
                marker.planned_refresh = row.optional_small();
                marker.shown_refresh = row.optional_small();
                return marker;
            });
    });
}

} // namespace overt
