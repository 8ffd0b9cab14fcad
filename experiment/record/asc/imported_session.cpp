#include "experiment/record/asc/imported_session.h"

#include "experiment/record/file_hash.h"
#include "experiment/record/manifest.h"
#include "experiment/record/read/session_record.h"
#include "experiment/record/seal_chain.h"
#include "experiment/record/session_file.h"
#include "experiment/record/session_schema.h"
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

void finish_imported_session(const std::filesystem::path& folder, const ProgramBuild& program) {
    write_session_rows(folder / session_file_name, [](SQLite::Database& database) {
        forget_file_hash(database); // that of the session which this is a copy of
        Query version(database, "PRAGMA user_version");
        if (version.step() && version.small() >= first_version_with_seals)
            seal_all_anew(database);
    });
    const SessionRecord record(folder);
    reopen_manifest(folder, record.header(), {"overt", program.version, hash_of_file("/proc/self/exe")});
    static_cast<void>(close_manifest(folder)); // it has no log: nobody knows of the folder yet
}

} // namespace overt
