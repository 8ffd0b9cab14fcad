#include "experiment/record/verify/seal_check.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <set>
#include <tuple>

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>

#include "experiment/record/old_names.h"
#include "experiment/record/seal_chain.h"
#include "experiment/record/session_schema.h"
#include "experiment/record/sql.h"

namespace overt {
namespace {

struct Seal {
    std::int64_t number = 0;
    std::string kind;
    std::int64_t sitting = 0;
    std::optional<std::int64_t> trial_id;
    ContentHash previous, sha256;
    std::vector<TableSeal> tables;
};

template <class Enum, int count> std::optional<Enum> called(const std::string& word) {
    for (int i = 0; i < count; ++i)
        if (name_of(static_cast<Enum>(i)) == word)
            return static_cast<Enum>(i);
    return std::nullopt;
}

class SealCheck {
  public:
    SealCheck(const SQLite::Database& database, bool is_closed)
        : database_(database), is_closed_(is_closed), has_todays_names_(has_table(database, "object")) {}

    SealFindings run() {
        attempt("trial", {}, [&] { learn_trials(); });
        attempt("seal", {}, [&] { read_seals(); });
        attempt("sealed_table", {}, [&] { read_table_seals(); });
        check_links();
        attempt("sqlite_schema", {}, [&] { tables_ = tables_to_seal(database_); });
        for (const Seal& seal : seals_)
            for (const TableSeal& table : seal.tables)
                check_rows(seal, table);
        for (const SealedTable& table : tables_)
            attempt(table.name, {}, [&] { look_for_unsealed(table); });
        return std::move(findings_);
    }

  private:
    /// What SQLite cannot read is damage, and the rest is looked at all the same.
    template <class Work>
    void attempt(const std::string& table, std::optional<std::int64_t> trial_id, const Work& work) {
        try {
            work();
        } catch (const SQLite::Exception& error) {
            report(table, trial_id, "", fmt::format("cannot be read: {}", error.what()));
        }
    }

    void report(const std::string& table, std::optional<std::int64_t> trial_id, std::string row,
                std::string what) {
        Damage damage{session_file_name, table, trial_id, {}, {}, std::move(row), std::move(what)};
        if (trial_id)
            if (const auto known = trials_.find(*trial_id); known != trials_.end())
                std::tie(damage.trial, damage.attempt) = known->second;
        findings_.damages.push_back(std::move(damage));
    }

    void learn_trials() {
        for (Query row(database_, "SELECT trial_id, trial, attempt FROM trial"); row.step();) {
            std::pair<int, int>& trial = trials_[row.integer()];
            row.read(trial.first, trial.second);
        }
    }

    void read_seals() {
        for (Query row(database_, "SELECT seal, kind, sitting, NULLIF(trial_id, 0), previous, sha256 "
                                  "FROM seal ORDER BY seal");
             row.step();) {
            Seal seal;
            row.read(seal.number, seal.kind, seal.sitting, seal.trial_id, seal.previous, seal.sha256);
            seals_.push_back(std::move(seal));
        }
    }

    void read_table_seals() {
        for (Query row(database_, "SELECT seal, name, columns, covers, after_id, to_id, row_count, sha256, "
                                  "locator FROM sealed_table ORDER BY seal, name");
             row.step();) {
            std::int64_t number = 0;
            TableSeal table;
            std::string covers;
            row.read(number, table.name, table.columns, covers, table.after_id, table.to_id, table.row_count,
                     table.sha256);
            table.locator = row.bytes();
            const auto rows = called<SealedRows, 4>(covers);
            const auto seal = std::lower_bound(
                seals_.begin(), seals_.end(), number,
                [](const Seal& other, std::int64_t wanted) { return other.number < wanted; });
            if (seal == seals_.end() || seal->number != number || !rows) {
                report("sealed_table", {}, fmt::format("seal = {}, name = {}", number, table.name),
                       "belongs to no seal");
                continue;
            }
            table.rows = *rows;
            seal->tables.push_back(std::move(table));
        }
    }

    /// Each seal has its own hash and that of the seal before it.
    void check_links() {
        ContentHash previous;
        std::int64_t expected = 1;
        for (Seal& seal : seals_) {
            const auto kind = called<SealKind, 5>(seal.kind);
            if (seal.number != expected || seal.previous != previous || !kind ||
                seal_hash(previous, *kind, seal.sitting, seal.trial_id, in_order(seal.tables)) != seal.sha256)
                report("seal", seal.trial_id, fmt::format("seal = {}", seal.number),
                       "this seal does not fit the one before it, or what it says of the tables");
            previous = seal.sha256;
            expected = seal.number + 1;
        }
        findings_.seals = static_cast<std::int64_t>(seals_.size());
        findings_.last = previous;
        if (seals_.empty())
            report("seal", {}, "", "there is no seal at all");
    }

    /// As the writer listed them: the schema first, then by name.
    static std::vector<TableSeal> in_order(std::vector<TableSeal> tables) {
        std::stable_sort(tables.begin(), tables.end(), [](const TableSeal& a, const TableSeal& b) {
            const auto rank = [](const TableSeal& table) { return table.name != "sqlite_schema"; };
            return std::pair(rank(a), a.name) < std::pair(rank(b), b.name);
        });
        return tables;
    }

    void check_rows(const Seal& seal, const TableSeal& sealed) {
        if (sealed.rows == SealedRows::of_trial)
            sealed_trials_.insert(seal.trial_id.value_or(0));
        if (sealed.rows == SealedRows::new_ones)
            sealed_to_[sealed.name] = std::max(sealed_to_[sealed.name], sealed.to_id);
        if (sealed.rows == SealedRows::of_none)
            has_outside_seal_.insert(sealed.name);
        const bool is_of_now = sealed.rows == SealedRows::all || sealed.rows == SealedRows::of_none;
        if (is_of_now && latest_seal_of(sealed.name, sealed.rows) != seal.number)
            return; // the rows were others then
        attempt(sealed.name, sealed.rows == SealedRows::of_trial ? seal.trial_id : std::nullopt,
                [&] { compare(seal, sealed); });
    }

    std::int64_t latest_seal_of(const std::string& table, SealedRows rows) {
        if (latest_.empty())
            for (const Seal& seal : seals_)
                for (const TableSeal& sealed : seal.tables)
                    latest_[{sealed.name, sealed.rows}] = seal.number;
        return latest_[{table, rows}];
    }

    /// The file's own names for tables and columns that a seal may know by the names of an earlier format.
    std::string names_here(const std::string& sealed) const {
        return has_todays_names_ ? todays_names(sealed) : sealed;
    }

    void compare(const Seal& seal, const TableSeal& sealed) {
        const auto known =
            std::find_if(tables_.begin(), tables_.end(),
                         [name = names_here(sealed.name)](const auto& table) { return table.name == name; });
        if (known == tables_.end())
            return report(sealed.name, seal.trial_id, "", "the table is gone");
        SealedTable table = *known;
        table.columns = names_here(sealed.columns);
        if (!has_columns(*known, table.columns))
            return report("sealed_table", seal.trial_id,
                          fmt::format("seal = {}, name = {}", seal.number, sealed.name),
                          "names columns that the table does not have");
        const RowChoice rows = sealed_choice(table, sealed.rows);
        const RowDigest now = digest_rows(database_, rows, sealed.after_id, sealed.to_id);
        if (now.sha256 == sealed.sha256 && now.rows == sealed.row_count)
            return;
        // What only grows is sealed with some trial, and belongs to one only by its own word.
        const auto trial_id = sealed.rows == SealedRows::of_trial ? seal.trial_id : std::nullopt;
        if (now.rows != sealed.row_count)
            return report(sealed.name, trial_id, "",
                          fmt::format("has {} rows where {} were sealed", now.rows, sealed.row_count));
        const std::optional<std::int64_t> row = now.locator.differing_row(sealed.locator);
        report(sealed.name, trial_id, row ? key_of(rows, sealed, *row) : "",
               row ? "is not as it was sealed" : "has rows that are not as they were sealed");
        if (row && sealed.rows == SealedRows::new_ones)
            findings_.damages.back().trial = trial_of(table, findings_.damages.back().row);
    }

    /// What a seal says is text of the file: it becomes part of a statement only where it is names of columns
    /// that are there.
    static bool has_columns(const SealedTable& table, std::string_view sealed) {
        std::set<std::string_view> there;
        const auto each = [](std::string_view list, const auto& take) {
            while (!list.empty()) {
                const std::string_view name = list.substr(0, list.find(", "));
                take(name);
                list.remove_prefix(std::min(list.size(), name.size() + 2));
            }
        };
        each(table.columns, [&](std::string_view name) { there.insert(name); });
        bool all = !sealed.empty();
        each(sealed, [&](std::string_view name) { all = all && there.contains(name); });
        return all;
    }

    /// The trial that a row outside of the tables of trials names, such as an event. `key`: "id = 12".
    std::optional<int> trial_of(const SealedTable& table, std::string_view key) const {
        std::int64_t id = 0;
        const std::string_view number = key.substr(std::min(key.size(), key.rfind(' ') + 1));
        const auto read = std::from_chars(number.data(), number.data() + number.size(), id);
        if (read.ec != std::errc() || read.ptr != number.data() + number.size() ||
            !has_column(database_, table.name.c_str(), "trial"))
            return std::nullopt;
        Query row(database_, fmt::format("SELECT trial FROM \"{}\" WHERE id = ?", table.name).c_str());
        row.bind(1, id);
        return row.step() ? row.optional_small() : std::nullopt;
    }

    /// The key of the n-th of these rows.
    std::string key_of(const RowChoice& rows, const TableSeal& sealed, std::int64_t n) const {
        Query row(database_, fmt::format("SELECT {} FROM \"{}\"{}{} ORDER BY {} LIMIT 1 OFFSET {}",
                                         rows.order, rows.table, rows.condition.empty() ? "" : " WHERE ",
                                         rows.condition, rows.order, n)
                                 .c_str());
        if (sealed.rows == SealedRows::of_trial || sealed.rows == SealedRows::new_ones)
            row.bind(1, sealed.after_id);
        if (sealed.rows == SealedRows::new_ones)
            row.bind(2, sealed.to_id);
        std::string key;
        if (!row.step())
            return key;
        std::string_view names = rows.order;
        while (!names.empty()) {
            const std::string_view name = names.substr(0, names.find(", "));
            key += fmt::format("{}{} = {}", key.empty() ? "" : ", ", name, row.text());
            names.remove_prefix(std::min(names.size(), name.size() + 2));
        }
        return key;
    }

    void look_for_unsealed(const SealedTable& table) {
        if (table.growth == SealedTable::Growth::by_trial)
            return look_for_unsealed_trials(table);
        if (table.growth != SealedTable::Growth::by_id)
            return;
        Query row(database_, fmt::format("SELECT COUNT(*) FROM \"{}\" WHERE id > ?", table.name).c_str());
        row.bind(1, sealed_to_[table.name]);
        row.step();
        unsealed(table.name, {}, row.integer(), is_closed_);
    }

    void look_for_unsealed_trials(const SealedTable& table) {
        for (Query row(database_,
                       fmt::format("SELECT t.trial_id, COUNT(*), (SELECT status FROM trial WHERE "
                                   "trial.trial_id = t.trial_id) FROM \"{}\" AS t GROUP BY t.trial_id",
                                   table.name)
                           .c_str());
             row.step();) {
            const std::int64_t trial_id = row.integer(), count = row.integer();
            const std::string status = row.text();
            if (trial_id <= 0 && !has_outside_seal_.contains(table.name))
                unsealed(table.name, {}, count, is_closed_);
            else if (trial_id > 0 && !sealed_trials_.contains(trial_id))
                unsealed(table.name, trial_id, count, status != "open");
        }
    }

    void unsealed(const std::string& table, std::optional<std::int64_t> trial_id, std::int64_t rows,
                  bool is_damage) {
        if (rows > 0 && is_damage)
            report(table, trial_id, "", fmt::format("has {} rows without a seal", rows));
        else
            findings_.unsealed_rows += rows;
    }

    const SQLite::Database& database_;
    bool is_closed_, has_todays_names_;
    SealFindings findings_;
    std::map<std::int64_t, std::pair<int, int>> trials_; ///< trial and attempt by trial_id
    std::vector<Seal> seals_;
    std::vector<SealedTable> tables_;
    std::map<std::pair<std::string, SealedRows>, std::int64_t> latest_; ///< number of the latest seal of rows
    std::set<std::int64_t> sealed_trials_;
    std::map<std::string, std::int64_t> sealed_to_;
    std::set<std::string> has_outside_seal_;
};

} // namespace

std::string to_text(const Damage& damage) {
    std::string text = damage.file;
    if (!damage.table.empty())
        text += fmt::format(": table {}", damage.table);
    if (damage.trial)
        text += fmt::format(", trial {}{}", *damage.trial + 1,
                            damage.attempt ? fmt::format(" (attempt {})", *damage.attempt) : "");
    else if (damage.trial_id)
        text += fmt::format(", trial_id {}", *damage.trial_id);
    if (!damage.row.empty())
        text += fmt::format(", row {}", damage.row);
    return fmt::format("{}: {}", text, damage.what);
}

SealFindings check_seals(const SQLite::Database& database, bool is_closed) {
    return SealCheck(database, is_closed).run();
}

} // namespace overt
