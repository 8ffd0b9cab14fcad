/// Rows of two session files side by side: which tables and columns are compared, and what a row is called.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <SQLiteCpp/Database.h>

#include "experiment/record/seal_chain.h"

struct sqlite3_stmt;

namespace overt {

/// A column that tells when, where or by which build something was recorded.
struct CircumstanceColumn {
    std::string_view table, column;
};
inline constexpr CircumstanceColumn circumstance_columns[] = {
    {"session", "started_utc"},
    {"session", "program_version"},
    {"session", "compiler"},
    {"session", "compiler_flags"},
    {"session", "commit_id"},
    {"session", "gl_context"},
    {"session", "gl_vendor"},
    {"session", "gl_renderer"},
    {"session", "gl_version"},
    {"sitting", "started_utc"},
    {"sitting", "program_version"},
    {"sitting", "program_sha256"},
    {"consent", "at_utc"},
    {"map", "sha256"}, // of the file; its pixels are compared
    {"stimulus", "drawn_by"},
    {"stimulus", "source"}, // a path as it was written; the frames are compared
};
inline bool is_circumstance(std::string_view table, std::string_view column) {
    return std::any_of(std::begin(circumstance_columns), std::end(circumstance_columns),
                       [&](const auto& of) { return of.table == table && of.column == column; });
}

/// Hashes of frames are compared where both files know them: earlier programs did not, nor does a session
/// that drew nothing.
inline bool may_be_unknown(std::string_view table, std::string_view column) {
    return table == "stimulus" && column == "frames_sha256";
}

/// A table that both files have.
struct ComparedTable {
    std::string name;
    std::vector<std::string> columns; ///< that both have
    std::vector<std::string> keys;    ///< by which its rows find each other; none: they do by their order
    std::string order;
    SealedTable::Growth growth = SealedTable::Growth::any;

    /// -1 if there is none.
    int column_called(std::string_view name_of_column) const {
        const auto found = std::find(columns.begin(), columns.end(), name_of_column);
        return found == columns.end() ? -1 : static_cast<int>(found - columns.begin());
    }
    /// Index of the time at which a row of a table that only grows happened; -1 if there is none.
    int time_column() const { return std::max(column_called("at_ns"), column_called("before_ns")); }
    /// All columns, in order; events about the machine's threads are left out.
    std::string select() const;
};

/// The tables of the recorded file that the other has, too, but for seals and options. Throws
/// SQLite::Exception.
std::vector<ComparedTable> tables_to_compare(const SQLite::Database& recorded,
                                             const SQLite::Database& replayed);

/// Reads rows, of any types. Throws SQLite::Exception.
class RowCursor {
  public:
    RowCursor(const SQLite::Database& database, const std::string& sql);
    /// Goes to the next row; is_there() tells whether there was one.
    void step();
    bool is_there() const { return is_there_; }

    std::int64_t integer(int column) const;
    /// As people read it; "nothing" for NULL.
    std::string text(int column) const;
    /// Bit for bit, and of the same type.
    bool is_same(int column, const RowCursor& other) const;
    /// Below, above or at 0, as their order in the table is; integers by value, else as text.
    int compare(int column, const RowCursor& other) const;

  private:
    struct Finalizer {
        void operator()(sqlite3_stmt* statement) const;
    };
    const SQLite::Database& database_;
    std::unique_ptr<sqlite3_stmt, Finalizer> statement_;
    bool is_there_ = false;
};

} // namespace overt
