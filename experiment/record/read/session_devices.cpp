/// What response boxes, keyboards and outputs of markers did in a session.
#include "experiment/record/read/session_record.h"
#include "experiment/record/sql.h"

namespace overt {
std::vector<RecordedButton> SessionRecord::button_changes() const {
    return reading_session(file_, [&] {
        return read_later_rows(
            database(), "button_change",
            "SELECT sitting, at_ns, uncertainty_ns, COALESCE(trial, -1), attempt_id, box, "
            "used_by = 'operator', button, name, is_down, device_us, meaning FROM button_change ORDER BY id",
            [](Query& row) {
                RecordedButton button;
                std::optional<std::int64_t> device_us;
                row.read(button.sitting, button.at, button.uncertainty, button.trial, button.attempt_id,
                         button.box, button.is_operators, button.button, button.name, button.is_down,
                         device_us, button.meaning);
                if (device_us)
                    button.device_time = BoxTime(BoxClock::duration(*device_us));
                return button;
            });
    });
}

std::vector<RecordedKeyPress> SessionRecord::key_presses() const {
    return reading_session(file_, [&] {
        return read_later_rows(
            database(), "key_press",
            "SELECT sitting, at_ns, uncertainty_ns, COALESCE(trial, -1), attempt_id, device, name, code, "
            "modifiers, text, screen, meaning FROM key_press ORDER BY id",
            [](Query& row) {
                RecordedKeyPress press;
                std::string screen;
                row.read(press.sitting, press.at, press.uncertainty, press.trial, press.attempt_id,
                         press.device, press.name, press.code, press.modifiers, press.text, screen,
                         press.meaning);
                for (int phase = 0; phase < session_phase_count; ++phase)
                    if (screen == name_of(static_cast<SessionPhase>(phase)))
                        press.screen = static_cast<SessionPhase>(phase);
                return press;
            });
    });
}

std::vector<RecordedMarker> SessionRecord::markers() const {
    return reading_session(file_, [&] {
        return read_later_rows(database(), "marker",
                               "SELECT sitting, at_ns, COALESCE(trial, -1), attempt_id, output, text, code, "
                               "is_sent, not_before_ns, not_after_ns, planned_refresh, "
                               "shown_refresh FROM marker ORDER BY id",
                               [](Query& row) {
                                   RecordedMarker marker;
                                   row.read(marker.sitting, marker.at, marker.trial, marker.attempt_id,
                                            marker.output, marker.text, marker.code, marker.is_sent,
                                            marker.not_before, marker.not_after, marker.planned_refresh,
                                            marker.shown_refresh);
                                   return marker;
                               });
    });
}

} // namespace overt
