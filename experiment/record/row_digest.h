/// Hashes of rows, and a short code beside them that finds the one row that was changed.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "experiment/base/content_hash.h"

struct sqlite3_stmt;

namespace SQLite {
class Database;
}

namespace overt {

/// Finds one changed row among many by the bits of its number, as a Hamming code finds a bit: the first word
/// is the exclusive or of all rows' short hashes, word 1 + b that of the rows whose number has bit b. A
/// single changed row changes the words of its number's bits, all by the same amount.
class RowLocator {
  public:
    void add(std::uint64_t row_hash);

    /// Little-endian words, for the record.
    std::string bytes() const;

    /// Number of the row, from 0, that differs between these two, if it is one row alone and both have as
    /// many rows. `recorded` as bytes() gave it.
    std::optional<std::int64_t> differing_row(const std::string& recorded) const;

  private:
    std::int64_t rows_ = 0;
    std::vector<std::uint64_t> words_{0};
};

struct RowDigest {
    std::int64_t rows = 0;
    ContentHash sha256; ///< over the rows in their order, each with its values' types and lengths
    RowLocator locator;
};

/// Which rows of which table, in words that a statement can be made of.
struct RowChoice {
    std::string table;
    std::string columns;   ///< separated by ", "
    std::string condition; ///< what follows WHERE, with up to two question marks; empty: all rows
    std::string order;     ///< what follows ORDER BY
};

/// Reads the rows and digests them. Throws SQLite::Exception.
RowDigest digest_rows(const SQLite::Database& database, const RowChoice& rows, std::int64_t first_parameter,
                      std::int64_t second_parameter);

} // namespace overt
