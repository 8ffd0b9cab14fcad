/// Rows of a recorded session put into the file of one that was made again.
#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "experiment/record/session_file.h"
#include "experiment/record/sql.h"
#include "experiment/record/verify/compared_rows.h"
#include "experiment/record/verify/record_comparison.h"

namespace overt {
namespace {

/// The tables that are written before the first trial, and by no sitting.
constexpr std::string_view header_table_names[] = {"session",
                                                   "characterisation",
                                                   "characterisation_file",
                                                   "schedule",
                                                   "block",
                                                   "protocol_file",
                                                   "task",
                                                   "part",
                                                   "entry_column",
                                                   "stimulus",
                                                   "pose",
                                                   "animation",
                                                   "animation_frame",
                                                   "camera",
                                                   "map",
                                                   "dataset_entry"};

/// A table of the entries of a list.
bool is_list(std::string_view table) {
    return std::ranges::find(stimulus_lists, table, &StimulusList::name) != stimulus_lists.end();
}

/// Columns that two tables of one name have both, separated by commas.
std::string common_columns(SQLite::Database& database, const std::string& table) {
    std::string columns;
    for (Query row(database, fmt::format("SELECT name FROM pragma_table_info('{0}') WHERE name IN "
                                         "(SELECT name FROM pragma_table_info('{0}', 'recorded'))",
                                         table)
                                 .c_str());
         row.step();)
        columns += (columns.empty() ? "" : ", ") + row.text();
    return columns;
}

void take_rows(SQLite::Database& database, const std::string& table, const std::string& condition) {
    const std::string columns = common_columns(database, table);
    database.exec(fmt::format("DELETE FROM main.{0} WHERE {2}; INSERT INTO main.{0} ({1}) SELECT {1} FROM "
                              "recorded.{0} WHERE {2}",
                              table, columns, condition));
}

void take_all(SQLite::Database& database, const SQLite::Database& recorded,
              const std::optional<RecordCut>& cut) {
    for (const ComparedTable& table : tables_to_compare(recorded, database)) {
        std::string same_row;
        for (const std::string& key : table.keys)
            same_row += fmt::format("{0}r.{1} = {2}.{1}", same_row.empty() ? "" : " AND ", key, table.name);
        for (const CircumstanceColumn& of : circumstance_columns)
            if (of.table == table.name && table.column_called(of.column) >= 0)
                database.exec(
                    fmt::format("UPDATE main.{0} SET {1} = (SELECT {1} FROM recorded.{0} AS r WHERE {2})",
                                table.name, of.column, same_row));
        // What one file does not know of frames is not told of in the exports of the other.
        if (const int hash = table.column_called("frames_sha256"); table.name == "stimulus" && hash >= 0) {
            Query known(recorded, "SELECT count(*) FROM stimulus WHERE frames_sha256 <> ''");
            if (!has_column(recorded, "stimulus", "made_from_sha256") ||
                (known.step() && known.integer() == 0))
                database.exec("UPDATE main.stimulus SET frames_sha256 = '', drawn_by = ''");
        }
        if (cut && table.name == "sitting")
            database.exec("UPDATE main.sitting SET closed = (SELECT closed FROM recorded.sitting AS r "
                          "WHERE r.sitting = sitting.sitting)");
        if (cut && table.growth == SealedTable::Growth::by_trial)
            take_rows(database, table.name, fmt::format("trial_id >= {}", cut->attempt));
        if ((cut && table.growth == SealedTable::Growth::by_id) || table.name == "event")
            take_rows(database, table.name, "1");
        if (cut && table.name == "map")
            take_rows(database, table.name, "1");
    }
}

/// Runs `take` on the file with the recorded one attached to it as "recorded".
template <class Take>
void take_from(const std::filesystem::path& recorded, const std::filesystem::path& into, const Take& take) {
    const SQLite::Database from = open_session_file(recorded, SessionFileUse::read);
    SQLite::Database database = open_session_file(into, SessionFileUse::write);
    try {
        SQLite::Statement attach(database, "ATTACH ? AS recorded");
        attach.bind(1, recorded.string());
        attach.exec();
        {
            SQLite::Transaction transaction(database);
            database.exec("PRAGMA defer_foreign_keys = ON");
            take(database, from);
            transaction.commit();
        }
        attach.reset();
        database.exec("DETACH recorded");
        static_cast<void>(fold_log(database));
    } catch (const SQLite::Exception& reason) {
        throw_record_error(into, "taking rows of the record", reason);
    }
}

} // namespace

void take_circumstances(const std::filesystem::path& recorded, const std::filesystem::path& replayed,
                        const std::optional<RecordCut>& cut) {
    take_from(recorded, replayed, [&](SQLite::Database& database, const SQLite::Database& from) {
        take_all(database, from, cut);
    });
}

void take_what_happened(const std::filesystem::path& recorded, const std::filesystem::path& into,
                        bool with_frames) {
    take_from(recorded, into, [&](SQLite::Database& database, const SQLite::Database& from) {
        for (const ComparedTable& table : tables_to_compare(from, database)) {
            const bool is_header =
                is_list(table.name) || std::find(std::begin(header_table_names), std::end(header_table_names),
                                                 table.name) != std::end(header_table_names);
            if (!is_header || (with_frames && table.name == "stimulus"))
                take_rows(database, table.name, "1");
        }
    });
}

} // namespace overt
