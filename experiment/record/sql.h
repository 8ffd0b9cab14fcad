/// The little that the record needs on top of SQLiteCpp: values bound in order, rows read in order, and
/// errors that say which file.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>

#include "experiment/session_time.h"
#include "experiment/stimulus_lists.h"
#include "experiment/units.h"

struct sqlite3_stmt;

namespace overt {

inline void bind_value(SQLite::Statement& statement, int index, std::int64_t value) {
    statement.bind(index, value);
}
inline void bind_value(SQLite::Statement& statement, int index, int value) { statement.bind(index, value); }
/// NaN becomes NULL: SQLite knows no NaN.
inline void bind_value(SQLite::Statement& statement, int index, double value) {
    statement.bind(index, value);
}
inline void bind_value(SQLite::Statement& statement, int index, const std::string& value) {
    statement.bind(index, value);
}
inline void bind_value(SQLite::Statement& statement, int index, const char* value) {
    statement.bind(index, value);
}
inline void bind_value(SQLite::Statement& statement, int index, std::string_view value) {
    statement.bind(index, std::string(value));
}
inline void bind_value(SQLite::Statement& statement, int index, bool value) {
    statement.bind(index, value ? 1 : 0);
}
inline void bind_value(SQLite::Statement& statement, int index, Degrees value) {
    statement.bind(index, value.value);
}
/// In the unit of the clock: nanoseconds of a session, microseconds of a tracker or a box.
template <class Rep, class Period>
void bind_value(SQLite::Statement& statement, int index, std::chrono::duration<Rep, Period> value) {
    statement.bind(index, static_cast<std::int64_t>(value.count()));
}
template <class Clock, class Duration>
void bind_value(SQLite::Statement& statement, int index, std::chrono::time_point<Clock, Duration> value) {
    bind_value(statement, index, value.time_since_epoch());
}
template <class T> void bind_value(SQLite::Statement& statement, int index, const std::optional<T>& value) {
    if (value)
        bind_value(statement, index, *value);
    else
        statement.bind(index);
}

/// Binds a value to the next question mark, or a stimulus to the next ones: its index in each list.
template <class Value> void bind_next(SQLite::Statement& statement, int& index, const Value& value) {
    bind_value(statement, ++index, value);
}
inline void bind_next(SQLite::Statement& statement, int& index, const Stimulus& value) {
    for (const StimulusList& list : stimulus_lists)
        bind_value(statement, ++index, value.*list.index);
}
template <class Value>
constexpr std::size_t marks_of = std::is_same_v<Value, Stimulus> ? stimulus_lists.size() : 1;

/// Runs a statement that gives no rows with these values for its question marks, and makes it ready for the
/// next run. Throws SQLite::Exception.
template <class... Values> void run_statement(SQLite::Statement& statement, const Values&... values) {
    [[maybe_unused]] int index = 0;
    (bind_next(statement, index, values), ...);
    statement.exec();
    statement.reset();
}

/// Adds a row: `into` is "INTO table (columns of the values)", or "OR REPLACE INTO …". Throws
/// SQLite::Exception.
template <class... Values>
void insert_values(SQLite::Database& database, const std::string& into, const Values&... values) {
    std::string marks = "?";
    for (std::size_t i = 1; i < (marks_of<Values> + ...); ++i)
        marks += ",?";
    SQLite::Statement statement(database, fmt::format("INSERT {} VALUES ({})", into, marks));
    run_statement(statement, values...);
}

/// Reads the rows of a SELECT, and of each row its columns from left to right. On SQLite's C interface,
/// because SQLiteCpp counts references for each single value. Throws SQLite::Exception.
class Query {
  public:
    /// The database must outlive the query.
    Query(const SQLite::Database& database, const char* sql);

    /// Value of the `index`-th question mark, from 1.
    Query& bind(int index, std::int64_t value);

    /// Goes to the next row; false when there is none.
    bool step();

    // The next column of the row.
    std::int64_t integer();
    int small() { return static_cast<int>(integer()); }
    double real();
    std::string text();
    std::string bytes(); ///< of a blob
    /// Throw RecordError for times that are centuries away: differences of any two must be times, too.
    SessionTime session_time();
    TrackerTime tracker_time();
    /// Passes over the next column if it is NULL.
    bool skip_null();
    /// Nothing if NULL.
    std::optional<double> optional_real() { return skip_null() ? std::nullopt : std::optional(real()); }
    std::optional<int> optional_small() { return skip_null() ? std::nullopt : std::optional(small()); }

    /// The next columns, each as its value's type has it (read_into); what run_statement() is for writing.
    template <class... Values> void read(Values&... values) { (read_into(values, *this), ...); }

  private:
    struct Finalizer {
        void operator()(sqlite3_stmt* statement) const;
    };
    const SQLite::Database& database_;
    std::unique_ptr<sqlite3_stmt, Finalizer> statement_;
    int column_ = 0;
};

inline void read_into(int& value, Query& row) { value = row.small(); }
inline void read_into(std::int64_t& value, Query& row) { value = row.integer(); }
inline void read_into(Stimulus& value, Query& row) {
    for (const StimulusList& list : stimulus_lists)
        value.*list.index = row.small();
}
inline void read_into(bool& value, Query& row) { value = row.integer() != 0; }
inline void read_into(double& value, Query& row) { value = row.real(); }
inline void read_into(std::string& value, Query& row) { value = row.text(); }
inline void read_into(Degrees& value, Query& row) { value.value = row.real(); }
inline void read_into(SessionTime& value, Query& row) { value = row.session_time(); }
inline void read_into(SessionDuration& value, Query& row) { value = SessionDuration(row.integer()); }
inline void read_into(TrackerTime& value, Query& row) { value = row.tracker_time(); }
template <class T> void read_into(std::optional<T>& value, Query& row) {
    value.reset();
    if (!row.skip_null())
        read_into(value.emplace(), row);
}

/// Whether a table has a column: earlier versions of the program may have made it without.
bool has_column(const SQLite::Database& database, const char* table, const char* column);

/// Whether there is such a table: earlier versions of the program may have made the file without.
bool has_table(const SQLite::Database& database, const char* table);

/// The rows of a SELECT with these values for its question marks, each as `read(row)` gives it. Throws
/// SQLite::Exception, and what `read` throws.
template <class Read, class... Values>
auto read_rows(const SQLite::Database& database, const std::string& sql, Read read, Values... values) {
    std::vector<std::invoke_result_t<Read&, Query&>> rows;
    Query row(database, sql.c_str());
    [[maybe_unused]] int index = 0;
    (row.bind(++index, values), ...);
    while (row.step())
        rows.push_back(read(row));
    return rows;
}

/// The same of a table that sessions of earlier programs lack: they have no rows of it.
template <class Read, class... Values>
auto read_later_rows(const SQLite::Database& database, const char* table, const std::string& sql, Read read,
                     Values... values) {
    using Rows = decltype(read_rows(database, sql, read, values...));
    return has_table(database, table) ? read_rows(database, sql, read, values...) : Rows();
}

/// Throws a RecordError that names the file, what was being done, SQLite's reason and the remedy.
[[noreturn]] void throw_record_error(const std::filesystem::path& file, std::string_view doing,
                                     const SQLite::Exception& reason);

/// Runs a reader of a session; what SQLite has to complain of becomes a RecordError with the file's name.
template <class Read> auto reading_session(const std::filesystem::path& file, Read read) {
    try {
        return read();
    } catch (const SQLite::Exception& reason) {
        throw_record_error(file, "reading the session", reason);
    }
}

} // namespace overt
