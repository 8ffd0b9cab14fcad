#include "experiment/record/seal_chain.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/error.h"
#include "experiment/record/sql.h"

namespace overt {
namespace {

constexpr std::array<std::string_view, 5> kind_names{"beginning", "sitting", "trial", "other", "end"};
constexpr std::array<std::string_view, 4> rows_names{"all", "trial", "no trial", "new"};

SealedTable describe_table(const SQLite::Database& database, const std::string& name) {
    std::vector<std::string> columns;
    std::map<int, std::string> key; // by place in the key
    for (Query row(database,
                   fmt::format("SELECT name, pk FROM pragma_table_info('{}') ORDER BY cid", name).c_str());
         row.step();) {
        columns.push_back(row.text());
        if (const int place = row.small(); place > 0)
            key[place] = columns.back();
    }
    const auto has = [&](std::string_view column) {
        return std::find(columns.begin(), columns.end(), column) != columns.end();
    };
    SealedTable table{name, fmt::format("{}", fmt::join(columns, ", ")), "", SealedTable::Growth::any};
    for (const auto& [place, column] : key)
        table.order += (table.order.empty() ? "" : ", ") + column;
    if (table.order.empty())
        table.order = "rowid";
    if (has("trial_id"))
        table.growth = SealedTable::Growth::by_trial;
    else if (has("sitting") && key.size() == 1 && key.begin()->second == "id")
        table.growth = SealedTable::Growth::by_id;
    return table;
}

SealedTable schema_table() {
    return {"sqlite_schema", "type, name, tbl_name, sql", "type, name", SealedTable::Growth::any};
}

} // namespace

std::string_view name_of(SealKind kind) { return kind_names[static_cast<std::size_t>(kind)]; }
std::string_view name_of(SealedRows rows) { return rows_names[static_cast<std::size_t>(rows)]; }

std::vector<SealedTable> tables_to_seal(const SQLite::Database& database) {
    std::vector<std::string> names;
    for (Query row(database,
                   "SELECT name FROM sqlite_schema WHERE type = 'table' AND name NOT LIKE "
                   "'sqlite_%' AND name NOT IN ('seal', 'sealed_table', 'file_hash') ORDER BY name");
         row.step();)
        names.push_back(row.text());
    std::vector<SealedTable> tables{schema_table()};
    for (const std::string& name : names)
        tables.push_back(describe_table(database, name));
    return tables;
}

RowChoice sealed_choice(const SealedTable& table, SealedRows rows) {
    constexpr std::array<std::string_view, 4> conditions{"", "trial_id = ?", "trial_id <= 0",
                                                         "id > ? AND id <= ?"};
    return {table.name, table.columns, std::string(conditions[static_cast<std::size_t>(rows)]), table.order};
}

ContentHash seal_hash(const ContentHash& previous, SealKind kind, std::int64_t sitting,
                      std::optional<std::int64_t> trial_id, const std::vector<TableSeal>& tables) {
    ContentHasher hasher;
    hasher.add(previous).add(name_of(kind)).add(sitting).add(trial_id.value_or(0));
    for (const TableSeal& table : tables) {
        hasher.add(table.name).add(table.columns).add(name_of(table.rows));
        hasher.add(table.after_id).add(table.to_id).add(table.row_count);
        hasher.add(table.sha256).add(table.locator);
    }
    return hasher.finish();
}

SealWriter::SealWriter(SQLite::Database& database) : database_(database) {
    for (Query row(database_, "SELECT seal, sha256 FROM seal ORDER BY seal DESC LIMIT 1"); row.step();) {
        seals_ = row.integer();
        last_ = row.text();
    }
    for (Query row(database_, "SELECT name, covers, to_id, sha256 FROM sealed_table ORDER BY seal");
         row.step();) {
        const std::string name = row.text(), covers = row.text();
        const std::int64_t to_id = row.integer();
        if (covers == name_of(SealedRows::new_ones))
            sealed_to_[name] = to_id;
        else if (covers != name_of(SealedRows::of_trial))
            sealed_content_[name] = row.text();
    }
}

std::optional<TableSeal> SealWriter::seal_of(const SealedTable& table, SealKind kind,
                                             std::optional<std::int64_t> trial_id) {
    TableSeal seal{table.name, table.columns, SealedRows::all, 0, 0, 0, {}, {}};
    switch (table.growth) {
    case SealedTable::Growth::any:
        break;
    case SealedTable::Growth::by_trial:
        // Rows that belong to no trial are few, and are sealed with what else belongs to none.
        seal.rows = trial_id ? SealedRows::of_trial : SealedRows::of_none;
        seal.after_id = trial_id.value_or(0);
        if (kind == SealKind::beginning)
            return std::nullopt;
        break;
    case SealedTable::Growth::by_id: {
        seal.rows = SealedRows::new_ones;
        seal.after_id = sealed_to_[table.name];
        Query last(database_, fmt::format("SELECT COALESCE(MAX(id), 0) FROM \"{}\"", table.name).c_str());
        last.step();
        seal.to_id = last.integer();
        if (seal.to_id == seal.after_id)
            return std::nullopt;
        sealed_to_[table.name] = seal.to_id;
        break;
    }
    }
    const RowDigest digest =
        digest_rows(database_, sealed_choice(table, seal.rows), seal.after_id, seal.to_id);
    seal.row_count = digest.rows;
    seal.sha256 = digest.sha256;
    seal.locator = digest.locator.bytes();
    if (seal.rows == SealedRows::all || seal.rows == SealedRows::of_none) {
        ContentHash& sealed = sealed_content_[table.name];
        const bool is_known = sealed == seal.sha256 || (sealed.empty() && digest.rows == 0);
        if (is_known && kind != SealKind::beginning)
            return std::nullopt;
        sealed = seal.sha256;
    }
    return seal;
}

void SealWriter::set(SealKind kind, int sitting, std::optional<std::int64_t> trial_id) {
    std::vector<TableSeal> tables;
    for (const SealedTable& table : tables_to_seal(database_))
        if (std::optional<TableSeal> seal = seal_of(table, kind, trial_id))
            tables.push_back(*std::move(seal));
    const ContentHash hash = seal_hash(last_, kind, sitting, trial_id, tables);
    ++seals_;
    SQLite::Statement insert(database_, "INSERT INTO seal VALUES (?,?,?,?,?,?)");
    run_statement(insert, seals_, std::string(name_of(kind)), sitting, trial_id, last_, hash);
    SQLite::Statement insert_table(database_, "INSERT INTO sealed_table VALUES (?,?,?,?,?,?,?,?,?)");
    for (const TableSeal& table : tables) {
        insert_table.bind(9, table.locator.data(), static_cast<int>(table.locator.size()));
        run_statement(insert_table, seals_, table.name, table.columns, std::string(name_of(table.rows)),
                      table.after_id, table.to_id, table.row_count, table.sha256);
    }
    last_ = hash;
}

void SealWriter::begin(int sitting) {
    OVERT_EXPECTS(is_new());
    std::vector<std::int64_t> trials;
    for (Query row(database_, "SELECT trial_id FROM trial WHERE status <> 'open' ORDER BY trial_id");
         row.step();)
        trials.push_back(row.integer());
    set(SealKind::beginning, sitting, std::nullopt);
    for (const std::int64_t trial : trials)
        set(SealKind::trial, sitting, trial);
}

void seal_all_anew(SQLite::Database& database) {
    database.exec("DELETE FROM sealed_table; DELETE FROM seal");
    Query sitting(database, "SELECT COALESCE(MAX(sitting), 0) FROM sitting");
    sitting.step();
    const int last = sitting.small();
    SealWriter writer(database);
    writer.begin(last);
    writer.seal_rest(SealKind::end, last);
}

void SealWriter::seal_trial(int sitting, std::int64_t trial_id) { set(SealKind::trial, sitting, trial_id); }

void SealWriter::seal_rest(SealKind kind, int sitting) { set(kind, sitting, std::nullopt); }

} // namespace overt
