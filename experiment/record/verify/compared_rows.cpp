#include "experiment/record/verify/compared_rows.h"

#include <bit>
#include <cstring>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sqlite3.h>

#include "experiment/ports/event_kinds.h"

namespace overt {
namespace {

std::vector<std::string> words_of(const std::string& list) {
    std::vector<std::string> words;
    for (std::size_t at = 0; at < list.size();) {
        const std::size_t comma = std::min(list.find(", ", at), list.size());
        words.push_back(list.substr(at, comma - at));
        at = comma + 2;
    }
    return words;
}

} // namespace

std::string ComparedTable::select() const {
    return fmt::format(
        "SELECT {} FROM {}{} ORDER BY {}", fmt::join(columns, ", "), name,
        name == "event" ? fmt::format(" WHERE kind NOT IN ('{}', '{}')", thread_event, earlier_sessions_event)
                        : "",
        order);
}

std::vector<ComparedTable> tables_to_compare(const SQLite::Database& recorded,
                                             const SQLite::Database& replayed) {
    std::map<std::string, SealedTable> others;
    for (SealedTable& table : tables_to_seal(replayed))
        others[table.name] = std::move(table);
    std::vector<ComparedTable> tables;
    for (const SealedTable& table : tables_to_seal(recorded)) {
        const auto other = others.find(table.name);
        if (table.name == "sqlite_schema" || table.name == "run_option" || other == others.end())
            continue;
        ComparedTable compared{table.name, {}, {}, table.order, table.growth};
        const std::vector<std::string> there = words_of(other->second.columns);
        for (std::string& column : words_of(table.columns)) {
            const bool counts_rows = table.growth == SealedTable::Growth::by_id && column == "id";
            if (!counts_rows && std::find(there.begin(), there.end(), column) != there.end())
                compared.columns.push_back(std::move(column));
        }
        if (table.growth != SealedTable::Growth::by_id && table.order != "rowid")
            compared.keys = words_of(table.order);
        tables.push_back(std::move(compared));
    }
    return tables;
}

void RowCursor::Finalizer::operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }

RowCursor::RowCursor(const SQLite::Database& database, const std::string& sql) : database_(database) {
    sqlite3_stmt* statement = nullptr;
    database.check(sqlite3_prepare_v2(database.getHandle(), sql.c_str(), -1, &statement, nullptr));
    statement_.reset(statement);
    step();
}

void RowCursor::step() {
    const int result = sqlite3_step(statement_.get());
    if (result != SQLITE_ROW && result != SQLITE_DONE)
        database_.check(result);
    is_there_ = result == SQLITE_ROW;
}

std::int64_t RowCursor::integer(int column) const { return sqlite3_column_int64(statement_.get(), column); }

std::string RowCursor::text(int column) const {
    sqlite3_stmt* const row = statement_.get();
    switch (sqlite3_column_type(row, column)) {
    case SQLITE_NULL:
        return "nothing";
    case SQLITE_FLOAT:
        return fmt::format("{}", sqlite3_column_double(row, column));
    case SQLITE_BLOB:
        return fmt::format("{} bytes", sqlite3_column_bytes(row, column));
    default:
        return {reinterpret_cast<const char*>(sqlite3_column_text(row, column)),
                static_cast<std::size_t>(sqlite3_column_bytes(row, column))};
    }
}

bool RowCursor::is_same(int column, const RowCursor& other) const {
    sqlite3_stmt *const a = statement_.get(), *const b = other.statement_.get();
    const int type = sqlite3_column_type(a, column);
    if (type != sqlite3_column_type(b, column))
        return false;
    switch (type) {
    case SQLITE_NULL:
        return true;
    case SQLITE_INTEGER:
        return sqlite3_column_int64(a, column) == sqlite3_column_int64(b, column);
    case SQLITE_FLOAT:
        return std::bit_cast<std::uint64_t>(sqlite3_column_double(a, column)) ==
               std::bit_cast<std::uint64_t>(sqlite3_column_double(b, column));
    default: {
        const int bytes = sqlite3_column_bytes(a, column);
        // Of no bytes SQLite gives a null pointer.
        return bytes == sqlite3_column_bytes(b, column) &&
               (bytes == 0 || std::memcmp(sqlite3_column_blob(a, column), sqlite3_column_blob(b, column),
                                          static_cast<std::size_t>(bytes)) == 0);
    }
    }
}

int RowCursor::compare(int column, const RowCursor& other) const {
    if (sqlite3_column_type(statement_.get(), column) == SQLITE_INTEGER) {
        const std::int64_t a = integer(column), b = other.integer(column);
        return a < b ? -1 : a > b;
    }
    return text(column).compare(other.text(column));
}

} // namespace overt
