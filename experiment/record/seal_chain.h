/// The chain of seals over a session's rows: each seal hashes rows and the seal before it, so that a changed
/// byte in any sealed row, or a row that is gone, cannot go unseen. docs/session_format.md says how to
/// recompute it.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiment/base/content_hash.h"
#include "experiment/record/row_digest.h"

namespace SQLite {
class Database;
}

namespace overt {

/// When a seal is set.
enum class SealKind : std::uint8_t {
    beginning, ///< the header, before the first sitting
    sitting,   ///< a sitting began; covers what an earlier one had left unsealed, too
    trial,     ///< an attempt at a trial ended
    other,     ///< rows were written that are not of a trial and may be replaced
    end        ///< a sitting ended in order
};
std::string_view name_of(SealKind kind);

/// Which of a table's rows one seal covers.
enum class SealedRows : std::uint8_t {
    all,      ///< as they are now; what an earlier seal says of them is of the past
    of_trial, ///< those with the seal's trial_id
    of_none,  ///< those with the trial_id 0 or less, which belong to no trial; as "all"
    new_ones  ///< those with an id beyond what earlier seals cover
};
std::string_view name_of(SealedRows rows);

/// How a table's rows are sealed. Follows from the table's columns alone, so that a new table is in the chain
/// as soon as it is in the schema: a table with a `trial_id` goes with its trials; one whose key is `id` and
/// that has a `sitting` only grows; of any other all rows are sealed again whenever they have changed.
struct SealedTable {
    enum class Growth : std::uint8_t { by_trial, by_id, any };
    std::string name;
    std::string columns; ///< separated by ", "; of a seal in the record, those that there were
    std::string order;   ///< by its key
    Growth growth = Growth::any;
};

/// All tables but those of the chain itself and the file's hash (file_hash.h), and their statements as the
/// table "sqlite_schema".
std::vector<SealedTable> tables_to_seal(const SQLite::Database& database);

/// The rows of a table that a seal covers, for digest_rows() with these parameters: the trial's id, or the
/// ids after which and up to which.
RowChoice sealed_choice(const SealedTable& table, SealedRows rows);

/// One line of a seal.
struct TableSeal {
    std::string name, columns;
    SealedRows rows = SealedRows::all;
    std::int64_t after_id = 0, to_id = 0;
    std::int64_t row_count = 0;
    ContentHash sha256;
    std::string locator;
};

/// The seal's own hash.
ContentHash seal_hash(const ContentHash& previous, SealKind kind, std::int64_t sitting,
                      std::optional<std::int64_t> trial_id, const std::vector<TableSeal>& tables);

/// Sets seals. The writer's thread; within the caller's transaction. Throws SQLite::Exception.
class SealWriter {
  public:
    /// Takes up the chain where it ends. The database must outlive this.
    explicit SealWriter(SQLite::Database& database);

    /// There is no seal yet: the session is being made, or comes from an earlier program.
    bool is_new() const { return seals_ == 0; }

    /// The first seal, and one for each trial there already is. `sitting`: 0 before the first.
    void begin(int sitting);
    void seal_trial(int sitting, std::int64_t trial_id);
    /// Everything that no trial has.
    void seal_rest(SealKind kind, int sitting);

  private:
    void set(SealKind kind, int sitting, std::optional<std::int64_t> trial_id);
    std::optional<TableSeal> seal_of(const SealedTable& table, SealKind kind,
                                     std::optional<std::int64_t> trial_id);

    SQLite::Database& database_;
    std::int64_t seals_ = 0;
    ContentHash last_;
    std::map<std::string, std::int64_t> sealed_to_;     ///< by table that grows by id
    std::map<std::string, ContentHash> sealed_content_; ///< by table whose rows are sealed as they are
};

/// Forgets the chain and seals all rows as they are now: for a session that was made over, not recorded.
/// Throws SQLite::Exception.
void seal_all_anew(SQLite::Database& database);

} // namespace overt
