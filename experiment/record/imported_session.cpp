#include "experiment/record/imported_session.h"

#include "experiment/record/session_file.h"
#include "experiment/record/sql.h"

namespace overt {

void write_session_rows(const std::filesystem::path& session_file,
                        const std::function<void(SQLite::Database&)>& write) {
    SQLite::Database database = open_session_file(session_file, SessionFileUse::write);
    try {
        // The folder is synced as a whole before anybody sees it.
        database.exec("PRAGMA journal_mode = MEMORY; PRAGMA synchronous = OFF");
        SQLite::Transaction transaction(database);
        write(database);
        transaction.commit();
        database.exec("PRAGMA journal_mode = DELETE");
    } catch (const SQLite::Exception& reason) {
        throw_record_error(session_file, "writing imported gaze", reason);
    }
}

} // namespace overt
