#include "experiment/record/verify/sitting_cut.h"

#include <string>
#include <vector>

#include <fmt/format.h>

#include "experiment/ports/session_phase.h"
#include "experiment/record/seal_chain.h"
#include "experiment/record/session_file.h"
#include "experiment/record/sql.h"

namespace overt {

namespace {

bool was_calibrated(const SQLite::Database& database) {
    Query row(database, fmt::format("SELECT 1 FROM event WHERE kind = '{}' AND detail = '{}'", phase_event,
                                    name_of(SessionPhase::calibration))
                            .c_str());
    return row.step();
}

} // namespace

void forget_sittings_from(const std::filesystem::path& session_file, int sitting) {
    SQLite::Database database = open_session_file(session_file, SessionFileUse::write);
    try {
        SQLite::Transaction transaction(database);
        database.exec("PRAGMA defer_foreign_keys = ON");
        database.exec("CREATE TEMP TABLE forgotten AS SELECT trial_id FROM trial WHERE sitting >= " +
                      std::to_string(sitting));
        // Of later parts of the form it is known in which sitting they were filled in.
        if (has_table(database, "observer_form"))
            database.exec(
                fmt::format("DELETE FROM observer_field WHERE id IN (SELECT field FROM observer_form "
                            "WHERE asked <> 'begin' AND sitting >= {})",
                            sitting));
        for (const SealedTable& table : tables_to_seal(database)) {
            const char* const name = table.name.c_str();
            if (has_column(database, name, "sitting"))
                database.exec(fmt::format("DELETE FROM {} WHERE sitting >= {}", name, sitting));
            else if (has_column(database, name, "trial_id"))
                database.exec(
                    fmt::format("DELETE FROM {} WHERE trial_id IN (SELECT trial_id FROM forgotten)", name));
        }
        // What is filled in at the beginning has no sitting in older sessions: it comes before the tracker is
        // calibrated.
        if (has_table(database, "observer_field") && !was_calibrated(database))
            database.exec("DELETE FROM observer_field");
        for (const char* const table : {"seal", "sealed_table", "file_hash"})
            if (has_table(database, table))
                database.exec(fmt::format("DELETE FROM {}", table));
        database.exec("DROP TABLE forgotten");
        transaction.commit();
        static_cast<void>(fold_log(database));
    } catch (const SQLite::Exception& reason) {
        throw_record_error(session_file, "taking the copy of a session back to an earlier sitting", reason);
    }
}

} // namespace overt
