/// What a session's record says of missed refreshes, row by row. The program itself reckons them from the
/// flips.
#pragma once

#include <filesystem>
#include <vector>

#include "experiment/flip_report.h"
#include "experiment/record/session_file.h"
#include "experiment/record/session_schema.h"
#include "experiment/record/sql.h"

namespace overt::test {

/// Of a trial by its id, in the order of their refreshes; none in sessions of earlier programs. The rows tell
/// no index of the trial.
inline std::vector<MissedRefresh> missed_rows(const std::filesystem::path& session, std::int64_t trial_id) {
    const SQLite::Database database = open_session_file(session / session_file_name, SessionFileUse::read);
    return read_later_rows(
        database, "missed_refresh",
        "SELECT refresh_in_trial, refresh, planned, shown, pose, vertical_blank_ns, uncertainty_ns "
        "FROM missed_refresh WHERE trial_id = ? ORDER BY refresh_in_trial",
        [](Query& row) {
            return MissedRefresh{0,
                                 row.small(),
                                 {row.integer()},
                                 {row.small()},
                                 {row.small()},
                                 {row.small()},
                                 row.session_time(),
                                 SessionDuration(row.integer())};
        },
        trial_id);
}

} // namespace overt::test
