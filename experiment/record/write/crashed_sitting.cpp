#include "experiment/record/write/crashed_sitting.h"

#include <cstdint>
#include <vector>

#include <SQLiteCpp/SQLiteCpp.h>

#include "experiment/base/error.h"
#include "experiment/ports/event_kinds.h"
#include "experiment/record/file_hash.h"
#include "experiment/record/seal_chain.h"
#include "experiment/record/session_file.h"
#include "experiment/record/session_lock.h"
#include "experiment/record/sql.h"

namespace overt {
namespace {

std::int64_t number_in(const SQLite::Database& database, const char* sql) {
    Query query(database, sql);
    return query.step() ? query.integer() : 0;
}

bool close_last_sitting(SQLite::Database& database, const std::string& what) {
    const auto sitting = static_cast<int>(
        number_in(database, "SELECT COALESCE(MAX(sitting), 0) FROM sitting WHERE closed = 0"));
    if (sitting == 0)
        return false;
    SQLite::Transaction transaction(database);
    SealWriter seals(database);
    std::vector<std::int64_t> left_open;
    for (Query row(database, "SELECT trial_id FROM trial WHERE status = 'open' ORDER BY trial_id");
         row.step();)
        left_open.push_back(row.integer());
    database.exec("UPDATE trial SET status = 'interrupted' WHERE status = 'open'");
    for (const std::int64_t trial_id : left_open)
        seals.seal_trial(sitting, trial_id);
    // The session's clock ended with the program: what comes last on it is the latest that is known.
    const std::int64_t at_ns = number_in(database, "SELECT COALESCE(MAX(at_ns), 0) FROM event");
    for (const std::string_view kind : {program_crashed_event, session_aborted_event})
        insert_values(database, "INTO event (sitting, at_ns, trial, kind, detail)", sitting, at_ns,
                      std::optional<int>(), std::string(kind), what);
    SQLite::Statement close(database, "UPDATE sitting SET closed = 1 WHERE sitting = ?");
    run_statement(close, sitting);
    seals.seal_rest(SealKind::end, sitting);
    forget_file_hash(database);
    transaction.commit();
    return true;
}

} // namespace

bool close_crashed_sitting(const std::filesystem::path& session_file, const std::string& what) {
    const SessionLock lock(session_file.parent_path());
    SQLite::Database database = open_session_file(session_file, SessionFileUse::write);
    try {
        if (!close_last_sitting(database, what))
            return false;
        static_cast<void>(fold_log(database));
        return true;
    } catch (const SQLite::Exception& reason) {
        throw_record_error(session_file, "closing the record of a program that crashed", reason);
    }
}

} // namespace overt
