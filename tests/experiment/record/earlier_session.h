/// Session files as earlier programs wrote them.
#pragma once

#include <string>
#include <vector>

#include <SQLiteCpp/SQLiteCpp.h>

#include "experiment/record/session_schema.h"
#include "tests/experiment/record/session_fixture.h"

namespace overt::testing {

/// Turns a session file of today into one of an earlier version: its tables (tests/data/sessions), with the
/// rows of today as far as there were columns for them.
inline void make_earlier(const std::filesystem::path& file, int version) {
    const std::filesystem::path earlier = file.string() + ".earlier";
    {
        SQLite::Database database(earlier.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
        database.exec("PRAGMA application_id = " + std::to_string(session_application_id) +
                      "; PRAGMA user_version = " + std::to_string(version));
        database.exec(text_of(std::filesystem::path(OVERT_SOURCE_DIR) / "tests/data/sessions" /
                              ("version_" + std::to_string(version) + ".sql")));
        database.exec("ATTACH '" + file.string() +
                      "' AS today; "
                      "UPDATE today.trial SET status = 'open' WHERE status = 'interrupted'");
        std::vector<std::string> tables;
        SQLite::Statement names(database, "SELECT name FROM main.sqlite_schema WHERE type = 'table'");
        while (names.executeStep())
            tables.push_back(names.getColumn(0).getString());
        for (const std::string& table : tables) {
            std::string columns;
            SQLite::Statement column(database, "SELECT a.name FROM pragma_table_info('" + table +
                                                   "', 'main') AS a JOIN pragma_table_info('" + table +
                                                   "', 'today') AS b ON a.name = b.name");
            while (column.executeStep())
                columns += (columns.empty() ? "" : ", ") + column.getColumn(0).getString();
            database.exec("INSERT INTO main." + table + " (" + columns + ") SELECT " + columns +
                          " FROM today." + table);
        }
    }
    std::filesystem::rename(earlier, file);
}

} // namespace overt::testing
