/// A table whose rows are values of a struct: each column stands in one line with its name, its meaning and
/// the member that it holds. What makes the table, writes and reads its rows and documents it comes from
/// those lines.
#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <span>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/error.h"
#include "experiment/base/kind_table.h"
#include "experiment/record/sql.h"

namespace overt {

/// The words by which an enumeration stands in a table, by its values from 0.
template <class Enum> inline constexpr std::array<const char*, 2> stored_words{};

// How values of each type stand in a table: there and back.
inline std::int64_t stored(std::int64_t value) { return value; }
inline int stored(int value) { return value; }
inline int stored(bool value) { return value ? 1 : 0; }
inline double stored(double value) { return value; }
inline const std::string& stored(const std::string& value) { return value; }
inline double stored(Degrees value) { return value.value; }
inline std::int64_t stored(SessionDuration value) { return value.count(); }
/// A seed, in decimal text: SQLite's integers are signed.
inline std::string stored(std::uint64_t value) { return std::to_string(value); }
/// A kind of a table stands there by its name, so that tables may grow.
template <TableKind Kind> std::string stored(Kind kind) { return std::string(name_of(kind)); }
template <class Enum>
requires(std::is_enum_v<Enum> && !TableKind<Enum>) const char* stored(Enum value) {
    return stored_words<Enum>[static_cast<std::size_t>(value)];
}

inline void read_into(std::uint64_t& value, Query& row) {
    const std::string text = row.text();
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size())
        throw RecordError(fmt::format("table session: the seed is no number: {}", text));
}
template <TableKind Kind> void read_into(Kind& kind, Query& row) {
    const std::string name = row.text();
    const auto found = std::ranges::find(names_of<Kind>, name);
    if (found == names_of<Kind>.end())
        throw RecordError(fmt::format("there is no kind \"{}\": the session is of a later program", name));
    kind = static_cast<Kind>(found - names_of<Kind>.begin());
}
template <class Enum>
requires(std::is_enum_v<Enum> && !TableKind<Enum>) void read_into(Enum& value, Query& row) {
    const std::string text = row.text();
    std::size_t index = 0;
    while (index + 1 < stored_words<Enum>.size() && text != stored_words<Enum>[index])
        ++index;
    value = static_cast<Enum>(index);
}

template <class Row> struct RowColumn {
    std::string_view name;    ///< ends in its unit
    std::string_view meaning; ///< for docs/session_format.md
    /// What sessions of earlier programs are taken to say, which lack the column; as SQL. Empty: all have it.
    std::string_view before;
    std::string (*type)(std::string_view name); ///< by SQL, with what it demands of values
    void (*bind)(SQLite::Statement&, int index, const Row&);
    void (*read)(Query&, Row&);
};

/// What a path of members, and of places in an array or vector, leads to.
template <auto step, auto... steps> constexpr auto& member_at(auto& from) {
    const auto next = [](auto& whole) -> auto& {
        if constexpr (std::is_member_pointer_v<decltype(step)>)
            return whole.*step;
        else
            return whole[step];
    };
    if constexpr (sizeof...(steps) == 0)
        return next(from);
    else
        return member_at<steps...>(next(from));
}

/// A column that holds the member to which the path leads: column<&Row::screen, &Screen::size_px, 0>(…).
template <auto first, auto... steps>
constexpr auto column(std::string_view name, std::string_view meaning, std::string_view before = {}) {
    return []<class Row, class Member>(Member Row::*, auto... words) -> RowColumn<Row> {
        using Value = std::remove_reference_t<decltype(member_at<first, steps...>(std::declval<Row&>()))>;
        return {words...,
                [](std::string_view column_name) -> std::string {
                    if constexpr (std::is_enum_v<Value> && !TableKind<Value>)
                        return fmt::format("TEXT NOT NULL CHECK ({} IN ('{}'))", column_name,
                                           fmt::join(stored_words<Value>, "', '"));
                    using Stored = decltype(stored(Value{}));
                    return std::is_floating_point_v<Stored> ? "REAL NOT NULL"
                           : std::is_integral_v<Stored>     ? "INTEGER NOT NULL"
                                                            : "TEXT NOT NULL";
                },
                [](SQLite::Statement& statement, int index, const Row& row) {
                    bind_value(statement, index, stored(member_at<first, steps...>(row)));
                },
                [](Query& query, Row& row) { read_into(member_at<first, steps...>(row), query); }};
    }(first, name, meaning, before);
}

template <class Row> struct RowTable {
    const char* name;
    const char* key; ///< the first column, as SQL declares it: a number that is no member
    std::span<const RowColumn<Row>> columns;
};

/// The statement that makes the table.
template <class Row> std::string create_sql(const RowTable<Row>& table) {
    std::string sql = fmt::format("CREATE TABLE {} (\n    {}", table.name, table.key);
    for (const RowColumn<Row>& column : table.columns) {
        sql += fmt::format(",\n    {} {}", column.name, column.type(column.name));
        if (!column.before.empty())
            sql += fmt::format(" DEFAULT {}", column.before);
    }
    return sql + "\n) STRICT;\n";
}

/// Throws SQLite::Exception.
template <class Row>
void insert_row(SQLite::Database& database, const RowTable<Row>& table, int key, const Row& row) {
    std::string marks = "?";
    for (std::size_t i = 0; i < table.columns.size(); ++i)
        marks += ",?";
    // All columns of a new table, in its order.
    SQLite::Statement statement(database, fmt::format("INSERT INTO {} VALUES ({})", table.name, marks));
    int index = 0;
    bind_value(statement, ++index, key);
    for (const RowColumn<Row>& column : table.columns)
        column.bind(statement, ++index, row);
    statement.exec();
}

/// All rows by their keys. Columns go by name, so that those of a later program change nothing here, and one
/// that an earlier program did not have reads as it says. Throws SQLite::Exception and RecordError.
template <class Row>
std::vector<Row> read_table(const SQLite::Database& database, const RowTable<Row>& table) {
    std::string sql;
    for (const RowColumn<Row>& column : table.columns) {
        sql += sql.empty() ? "SELECT " : ", ";
        sql += column.before.empty() || has_column(database, table.name, std::string(column.name).c_str())
                   ? column.name
                   : column.before;
    }
    return read_rows(database, fmt::format("{} FROM {} ORDER BY rowid", sql, table.name), [&](Query& query) {
        Row row;
        for (const RowColumn<Row>& column : table.columns)
            column.read(query, row);
        return row;
    });
}

/// The rows of a Markdown table of the columns and what they mean.
template <class Row> std::string describe(const RowTable<Row>& table) {
    std::string text;
    for (const RowColumn<Row>& column : table.columns)
        text += fmt::format("| `{}` | {} |\n", column.name, column.meaning);
    return text;
}

} // namespace overt
