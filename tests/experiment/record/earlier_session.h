/// Session files as earlier programs wrote them.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/record/old_names.h"
#include "experiment/record/seal_chain.h"
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
            const std::string of_today(todays_name(table));
            std::vector<std::string> there, columns, columns_of_today;
            SQLite::Statement column(database,
                                     "SELECT name FROM pragma_table_info('" + of_today + "', 'today')");
            while (column.executeStep())
                there.push_back(column.getColumn(0).getString());
            SQLite::Statement own(database, "SELECT name FROM pragma_table_info('" + table + "', 'main')");
            while (own.executeStep()) {
                const std::string name = own.getColumn(0).getString();
                if (std::find(there.begin(), there.end(), todays_name(name)) == there.end())
                    continue;
                columns.push_back(name);
                columns_of_today.emplace_back(todays_name(name));
            }
            if (!columns.empty())
                database.exec(fmt::format("INSERT INTO main.{} ({}) SELECT {} FROM today.{}", table,
                                          fmt::join(columns, ", "), fmt::join(columns_of_today, ", "),
                                          of_today));
        }
        if (version >= first_version_with_seals)
            seal_all_anew(database);
    }
    std::filesystem::rename(earlier, file);
}

} // namespace overt::testing
