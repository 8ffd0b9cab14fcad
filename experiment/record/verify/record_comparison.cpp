#include "experiment/record/verify/record_comparison.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include <fmt/format.h>

#include "experiment/ports/event_kinds.h"
#include "experiment/record/session_file.h"
#include "experiment/record/sql.h"
#include "experiment/record/verify/compared_rows.h"

namespace overt {
namespace {

/// What is fixed about an attempt from its begin.
constexpr std::string_view begun_columns[] = {"trial_id", "sitting", "trial",
                                              "attempt",  "task",    "started_ns"};

/// What is filled in when an attempt ends, in rows that are there from its begin or that tell of its course.
constexpr std::pair<std::string_view, std::string_view> ended_columns[] = {{"presentation", "first_refresh"},
                                                                           {"presentation", "last_refresh"},
                                                                           {"step", "begin_ns"},
                                                                           {"step", "end_ns"},
                                                                           {"step", "ended_by"},
                                                                           {"step", "gaze_onset_us"},
                                                                           {"step", "gaze_detected_us"}};

/// Whether the value stands fixed from an attempt's begin: of an attempt that was cut off, nothing else need
/// be the same.
bool is_of_begin(std::string_view table, std::string_view column) {
    if (table != "trial")
        return std::ranges::find(ended_columns, std::pair(table, column)) == std::end(ended_columns);
    return std::ranges::find(begun_columns, column) != std::end(begun_columns) ||
           std::ranges::find(stimulus_lists, column, &StimulusList::name) != stimulus_lists.end();
}

/// Enough to see what a value is.
constexpr std::size_t longest_value = 120;

struct AttemptOf {
    int trial = -1, attempt = 1;
    std::int64_t started_ns = 0;
};
using Attempts = std::map<std::int64_t, AttemptOf>;

Attempts attempts_of(const SQLite::Database& database) {
    Attempts attempts;
    for (Query row(database, "SELECT trial_id, trial, attempt, started_ns FROM trial"); row.step();) {
        const std::int64_t id = row.integer();
        const int trial = row.small(), attempt = row.small();
        attempts[id] = {trial, attempt, row.integer()};
    }
    return attempts;
}

std::string shortened(std::string text) {
    if (text.size() > longest_value)
        text = text.substr(0, longest_value) + " …";
    return text;
}

/// The first line in which two texts differ, from 1, and what stands there.
struct DifferingLine {
    std::size_t number = 1;
    std::string recorded, replayed;
    bool is_one_of_many = false;
};

DifferingLine differing_line(const std::string& recorded, const std::string& replayed) {
    const auto first = std::mismatch(recorded.begin(), recorded.end(), replayed.begin(), replayed.end());
    const std::size_t at = static_cast<std::size_t>(first.first - recorded.begin());
    const std::size_t begin = at == 0 ? 0 : recorded.rfind('\n', at - 1) + 1; // npos + 1 is 0
    const auto line_of = [&](const std::string& text) {
        return text.substr(begin, text.find('\n', begin) - begin);
    };
    DifferingLine line;
    line.number += static_cast<std::size_t>(
        std::count(recorded.begin(), recorded.begin() + static_cast<std::ptrdiff_t>(begin), '\n'));
    line.recorded = line_of(recorded);
    line.replayed = line_of(replayed);
    line.is_one_of_many =
        recorded.find('\n') != std::string::npos || replayed.find('\n') != std::string::npos;
    return line;
}

/// Where a difference stands in the course of the session.
struct Ranked {
    std::int64_t attempt; ///< 0: before the first
    std::int64_t at_ns;
    RecordDifference difference;
};

/// Walks through the rows of one table in both files up to the first difference.
class TableComparison {
  public:
    TableComparison(const ComparedTable& table, const SQLite::Database& recorded,
                    const SQLite::Database& replayed, const Attempts& attempts,
                    const std::optional<RecordCut>& cut)
        : table_(table), recorded_(recorded, table.select()), replayed_(replayed, table.select()),
          attempts_(attempts), cut_(cut) {
        for (const std::string& key : table.keys)
            keys_.push_back(table.column_called(key));
        for (std::size_t i = 0; i < table.columns.size(); ++i)
            if (!is_circumstance(table.name, table.columns[i]) &&
                !(cut && table.name == "sitting" && table.columns[i] == "closed"))
                compared_.push_back(static_cast<int>(i));
    }

    /// Nothing: all that is compared is the same.
    std::optional<Ranked> run() {
        while (recorded_.is_there() || replayed_.is_there()) {
            if (recorded_.is_there() && is_beyond_cut(recorded_))
                return std::nullopt;
            const int order = order_of_rows();
            if (order > 0) { // only the replay has this row
                if (!may_be_more())
                    return missing(replayed_, "", "a row");
                replayed_.step();
                continue;
            }
            if (order < 0) {
                if (!is_left_out(recorded_))
                    return missing(recorded_, "a row", "");
                recorded_.step();
                continue;
            }
            if (std::optional<Ranked> found = compare_values())
                return found;
            ++rows_;
            recorded_.step();
            replayed_.step();
        }
        return std::nullopt;
    }

    std::int64_t rows() const { return rows_; }
    /// Values that one of the files does not know.
    std::int64_t unknown() const { return unknown_; }

  private:
    std::optional<std::int64_t> value(const RowCursor& row, std::string_view column) const {
        const int index = table_.column_called(column);
        if (index < 0 || row.text(index) == "nothing")
            return std::nullopt;
        return row.integer(index);
    }

    bool is_in_cut_attempt(const RowCursor& row) const {
        return cut_ && table_.growth == SealedTable::Growth::by_trial &&
               value(row, "trial_id").value_or(0) >= cut_->attempt;
    }

    /// Of an attempt that was ended from outside, events and answers were closed early.
    bool is_left_out(const RowCursor& row) const {
        return cut_ && cut_->from && is_in_cut_attempt(row) &&
               (table_.name == "gaze_event" || table_.name == "missed_refresh" ||
                table_.name == "answer_recording");
    }

    bool is_beyond_cut(const RowCursor& row) const {
        return cut_ && cut_->from && table_.growth == SealedTable::Growth::by_id &&
               table_.time_column() >= 0 &&
               row.integer(table_.time_column()) >= cut_->from->time_since_epoch().count();
    }

    /// Whether the replay may have the row that it is at, though the record has not.
    bool may_be_more() const {
        if (!cut_)
            return false;
        if (table_.growth == SealedTable::Growth::by_trial)
            return is_in_cut_attempt(replayed_);
        return !recorded_.is_there() || table_.name == "map";
    }

    /// Below 0: the replay lacks the record's row; above 0: the record lacks the replay's.
    int order_of_rows() const {
        if (!recorded_.is_there())
            return 1;
        if (!replayed_.is_there())
            return -1;
        for (const int key : keys_)
            if (const int order = recorded_.compare(key, replayed_))
                return order;
        return 0;
    }

    std::optional<Ranked> compare_values() {
        if (is_left_out(recorded_))
            return std::nullopt;
        const bool is_begun_only = is_in_cut_attempt(recorded_);
        for (const int column : compared_) {
            const std::string& name = table_.columns[static_cast<std::size_t>(column)];
            if (is_begun_only && !is_of_begin(table_.name, name))
                continue;
            if (recorded_.is_same(column, replayed_))
                continue;
            if (may_be_unknown(table_.name, name) &&
                (table_.column_called("made_from_sha256") < 0 || recorded_.text(column).empty() ||
                 replayed_.text(column).empty())) {
                ++unknown_;
                continue;
            }
            Ranked ranked = missing(recorded_, recorded_.text(column), replayed_.text(column));
            const DifferingLine line = differing_line(ranked.difference.recorded, ranked.difference.replayed);
            ranked.difference.column =
                line.is_one_of_many ? fmt::format("{}, line {}", name, line.number) : name;
            ranked.difference.recorded = shortened(line.recorded);
            ranked.difference.replayed = shortened(line.replayed);
            return ranked;
        }
        return std::nullopt;
    }

    /// A difference of a whole row, or what is common to those of values.
    Ranked missing(const RowCursor& row, std::string recorded, std::string replayed) const {
        Ranked ranked{place_of(row), 0, {}};
        if (const int time = table_.time_column(); time >= 0)
            ranked.at_ns = row.integer(time);
        RecordDifference& difference = ranked.difference;
        difference.table = table_.name;
        difference.recorded = std::move(recorded);
        difference.replayed = std::move(replayed);
        if (const auto found = attempts_.find(value(row, "trial_id").value_or(0)); found != attempts_.end()) {
            difference.trial = found->second.trial;
            difference.attempt = found->second.attempt;
        } else if (const auto trial = value(row, "trial")) {
            difference.trial = static_cast<int>(*trial);
        }
        difference.row = name_of_row(row);
        return ranked;
    }

    std::string name_of_row(const RowCursor& row) const {
        std::string name;
        const auto add = [&](const std::string& word, const std::string& text) {
            name += fmt::format("{}{} {}", name.empty() ? "" : ", ", word, text);
        };
        for (const int key : keys_)
            if (const std::string& word = table_.columns[static_cast<std::size_t>(key)];
                word != "trial_id" && word != "trial" && table_.name != "session")
                add(word, row.text(key));
        if (!keys_.empty())
            return name;
        add("row", std::to_string(rows_ + 1));
        if (const int kind = table_.column_called("kind"); kind >= 0)
            add("kind", fmt::format("\"{}\"", row.text(kind)));
        return name;
    }

    /// The attempt in which a row came about.
    std::int64_t place_of(const RowCursor& row) const {
        if (table_.growth == SealedTable::Growth::by_trial)
            return value(row, "trial_id").value_or(0);
        std::int64_t place = 0;
        if (const int time = table_.time_column(); time >= 0)
            for (const auto& [id, attempt] : attempts_)
                if (attempt.started_ns <= row.integer(time))
                    place = std::max(place, id);
        return place;
    }

    const ComparedTable& table_;
    RowCursor recorded_, replayed_;
    const Attempts& attempts_;
    const std::optional<RecordCut>& cut_;
    std::vector<int> keys_, compared_;
    std::int64_t rows_ = 0, unknown_ = 0;
};

/// What stands fixed before the first trial comes first, the session itself before the rest.
auto place_in_session(const Ranked& ranked) {
    const std::string& table = ranked.difference.table;
    return std::tuple(ranked.attempt, table != "session", table != "schedule", ranked.at_ns);
}

/// Earlier programs wrote the hash of what frames are made from where that of their pixels stands now.
void compare_what_frames_are_made_from(const SQLite::Database& recorded, const SQLite::Database& replayed,
                                       std::vector<Ranked>& found) {
    constexpr const char* made_from = "made_from_sha256";
    if (has_column(recorded, "stimulus", made_from) || !has_column(replayed, "stimulus", made_from) ||
        !has_table(recorded, "stimulus"))
        return;
    // Both are kept in the order of their indices.
    Query before(recorded, "SELECT frames_sha256 FROM stimulus");
    Query now(replayed, "SELECT made_from_sha256 FROM stimulus");
    for (int row = 1; before.step() && now.step(); ++row) {
        const std::string a = before.text(), b = now.text();
        if (a == b)
            continue;
        RecordDifference difference;
        difference.table = "stimulus";
        difference.row = fmt::format("row {}", row);
        difference.column = made_from;
        difference.recorded = a;
        difference.replayed = b;
        found.push_back({0, 0, std::move(difference)});
        return;
    }
}

RecordComparison compare(const SQLite::Database& recorded, const SQLite::Database& replayed,
                         const std::optional<RecordCut>& cut) {
    const Attempts attempts = attempts_of(recorded);
    RecordComparison comparison;
    comparison.attempts = static_cast<int>(attempts.size());
    std::vector<Ranked> found;
    for (const ComparedTable& table : tables_to_compare(recorded, replayed)) {
        TableComparison walk(table, recorded, replayed, attempts, cut);
        if (std::optional<Ranked> difference = walk.run())
            found.push_back(*std::move(difference));
        comparison.rows += walk.rows();
        comparison.unknown_frames += walk.unknown();
        if (table.name == "flip")
            comparison.flips = walk.rows();
        if (table.name == "sample")
            comparison.samples = walk.rows();
    }
    compare_what_frames_are_made_from(recorded, replayed, found);
    std::stable_sort(found.begin(), found.end(), [](const Ranked& a, const Ranked& b) {
        return place_in_session(a) < place_in_session(b);
    });
    for (Ranked& ranked : found)
        comparison.differences.push_back(std::move(ranked.difference));
    return comparison;
}

} // namespace

std::string to_text(const RecordDifference& difference) {
    std::string place = "table " + difference.table;
    if (difference.trial)
        place += fmt::format(", trial {}", *difference.trial + 1);
    if (difference.attempt && *difference.attempt > 1)
        place += fmt::format(", attempt {}", *difference.attempt);
    if (!difference.row.empty())
        place += ", " + difference.row;
    if (difference.column.empty())
        return fmt::format("{}: the row is only in the {}", place,
                           difference.recorded.empty() ? "replay" : "record");
    return fmt::format("{}, {}: recorded {}, replayed {}", place, difference.column, difference.recorded,
                       difference.replayed);
}

std::string not_compared() {
    return "the dates, the program's build, what OpenGL says of itself, and how the machine scheduled the "
           "program's threads";
}

RecordComparison compare_records(const std::filesystem::path& recorded, const std::filesystem::path& replayed,
                                 const std::optional<RecordCut>& cut) {
    const SQLite::Database a = open_session_file(recorded, SessionFileUse::read);
    const SQLite::Database b = open_session_file(replayed, SessionFileUse::read);
    return reading_session(recorded, [&] { return compare(a, b, cut); });
}

} // namespace overt
