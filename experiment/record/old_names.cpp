#include "experiment/record/old_names.h"

#include <algorithm>
#include <map>
#include <vector>

#include <SQLiteCpp/Database.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/record/sql.h"

namespace overt {
namespace {

struct Renamed {
    std::string_view old_name, name;
};
constexpr Renamed renamed[] = {{"sculpture", "object"}};

/// Of each table of the file: its columns.
std::map<std::string, std::vector<std::string>> columns_by_table(const SQLite::Database& database) {
    std::map<std::string, std::vector<std::string>> tables;
    for (Query row(database, "SELECT m.name, c.name FROM main.sqlite_schema AS m, pragma_table_info(m.name, "
                             "'main') AS c WHERE m.type IN ('table', 'view') AND m.name NOT LIKE 'sqlite_%' "
                             "ORDER BY m.name, c.cid");
         row.step();) {
        std::string table = row.text();
        tables[std::move(table)].push_back(row.text());
    }
    return tables;
}

bool is_renamed(const std::string& name) { return todays_name(name) != name; }

} // namespace

std::string_view todays_name(std::string_view name) {
    const auto found = std::ranges::find(renamed, name, &Renamed::old_name);
    return found == std::end(renamed) ? name : found->name;
}

std::string todays_names(std::string_view list) {
    constexpr std::string_view separator = ", ";
    std::string names;
    while (true) {
        const std::size_t end = list.find(separator);
        names += todays_name(list.substr(0, end));
        if (end == std::string_view::npos)
            return names;
        names += separator;
        list.remove_prefix(end + separator.size());
    }
}

void show_todays_names(SQLite::Database& database) {
    for (const auto& [table, columns] : columns_by_table(database)) {
        if (!is_renamed(table) && std::ranges::none_of(columns, is_renamed))
            continue;
        std::vector<std::string> shown;
        for (const std::string& column : columns)
            shown.push_back(fmt::format("\"{}\" AS \"{}\"", column, todays_name(column)));
        database.exec(fmt::format("CREATE TEMP VIEW \"{}\" AS SELECT {} FROM main.\"{}\"", todays_name(table),
                                  fmt::join(shown, ", "), table));
    }
}

void rename_to_today(SQLite::Database& database) {
    for (const auto& [table, columns] : columns_by_table(database)) {
        const bool is_table = has_table(database, table.c_str());
        if (!is_table)
            continue; // a view follows its tables
        for (const std::string& column : columns)
            if (is_renamed(column))
                database.exec(fmt::format("ALTER TABLE \"{}\" RENAME COLUMN \"{}\" TO \"{}\"", table, column,
                                          todays_name(column)));
        if (is_renamed(table))
            database.exec(fmt::format("ALTER TABLE \"{}\" RENAME TO \"{}\"", table, todays_name(table)));
    }
}

} // namespace overt
