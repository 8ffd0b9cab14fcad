#include "experiment/protocol/trial_table.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "experiment/base/counted.h"
#include "experiment/protocol/entry_ids.h"
#include "experiment/protocol/protocol.h"

namespace overt {

namespace {

constexpr int most_repeats = 1000;

/// What a column says.
struct TrialColumn {
    enum class Kind : std::uint8_t { stimulus, correct, block, repeat, factor, unknown };
    Kind kind = Kind::factor;
    int slot = -1;            ///< place among the task's; -1: all of them
    int list = -1;            ///< -1: of all lists, as "vase/gloss-0.1"
    bool is_duration = false; ///< of a step, in seconds
};

bool is_factor_name(std::string_view name) {
    return std::ranges::all_of(
        name, [](unsigned char letter) { return std::isalnum(letter) || letter == '_' || letter == '-'; });
}

class TrialTableMaker {
  public:
    TrialTableMaker(const DelimitedText& text, const Protocol& protocol, int task, const std::string& file,
                    Diagnostics& diagnostics)
        : text_(text), protocol_(protocol), task_(protocol.tasks[static_cast<std::size_t>(task)]),
          slots_(slots_of_task(protocol, task)), file_(file), diagnostics_(diagnostics) {}

    TrialTable make() {
        for (const StimulusList& list : stimulus_lists)
            lists_.push_back(list.name);
        for (const int slot : slots_)
            slot_ids_.push_back(protocol_.slots[static_cast<std::size_t>(slot)].id);
        TrialTable table{file_, {}, {}};
        for (const TextCell& cell : text_.header) {
            columns_.push_back(column_called(cell));
            if (columns_.back().kind == TrialColumn::Kind::factor)
                table.factors.push_back(cell.text);
        }
        for (const std::vector<TextCell>& row : text_.rows)
            table.rows.push_back(row_of(row));
        return table;
    }

  private:
    using Kind = TrialColumn::Kind;

    void error(Place place, std::string message, std::string hint = {}) {
        diagnostics_.error(file_, place, std::move(message), std::move(hint));
    }

    TrialColumn column_called(const TextCell& cell) {
        const std::string& name = cell.text;
        if (name == "correct")
            return {Kind::correct};
        if (name == "block")
            return {Kind::block};
        if (name == "repeat")
            return {Kind::repeat};
        if (const int list = index_in(lists_, name); list >= 0)
            return {Kind::stimulus, -1, list};
        if (const int slot = index_in(slot_ids_, name); slot >= 0)
            return {Kind::stimulus, slot, -1};
        if (const std::size_t point = name.find('.'); point != std::string::npos) {
            const int slot = index_in(slot_ids_, name.substr(0, point));
            const int list = index_in(lists_, name.substr(point + 1));
            if (slot >= 0 && list >= 0)
                return {Kind::stimulus, slot, list};
            if (slot < 0)
                error(cell.place, fmt::format("the task has no slot \"{}\"", name.substr(0, point)),
                      suggest_name(name.substr(0, point), views_of(slot_ids_)));
            if (list < 0)
                error(cell.place, fmt::format("there is no list \"{}\"", name.substr(point + 1)),
                      suggest_name(name.substr(point + 1), lists_));
            return {Kind::unknown};
        }
        return factor_called(cell);
    }

    TrialColumn factor_called(const TextCell& cell) {
        std::vector<std::string_view> known = lists_;
        for (const std::string& slot : slot_ids_)
            known.push_back(slot);
        known.insert(known.end(), {"correct", "block", "repeat"});
        if (!is_factor_name(cell.text))
            error(cell.place, fmt::format("a factor cannot be called \"{}\"", cell.text),
                  "letters, digits, - and _ make a name");
        else if (is_name_of_factor(cell.text) || cell.text == "seen" || cell.text == "catch")
            error(cell.place, fmt::format("\"{}\" is the name of a factor that every trial has", cell.text),
                  "call the column otherwise");
        else if (const auto near = nearest_name(cell.text, known))
            error(cell.place, fmt::format("unknown column \"{}\"", cell.text),
                  fmt::format("did you mean \"{}\"? A factor of your own needs a name less like it", *near));
        else if (const std::string list = list_with_column(cell.text); !list.empty())
            error(cell.place,
                  fmt::format("\"{}\" is a column of the entries of [[{}]] already", cell.text, list),
                  "call the one or the other otherwise");
        else
            return {Kind::factor, -1, -1, is_duration(cell)};
        return {Kind::unknown};
    }

    bool is_duration(const TextCell& cell) {
        const auto steps = std::ranges::count(task_.steps, cell.text, seconds_column);
        if (steps > 1)
            error(cell.place, fmt::format("{} steps of the task are meant by \"{}\"", steps, cell.text),
                  "give them ids, by which columns can tell them apart");
        return steps > 0;
    }

    std::string list_with_column(std::string_view name) const {
        for (std::size_t list = 0; list < stimulus_lists.size(); ++list)
            for (const ListEntry* entry : entries_of(protocol_, list))
                if (std::ranges::find(entry->columns, name, &NamedWord::name) != entry->columns.end())
                    return std::string(stimulus_lists[list].name);
        return {};
    }

    TrialTableRow row_of(const std::vector<TextCell>& cells) {
        TrialTableRow row;
        std::vector<std::array<int, stimulus_lists.size()>> chosen(slots_.size());
        std::vector<bool> is_spoken_of(slots_.size()), is_filled(slots_.size());
        for (auto& slot : chosen)
            slot.fill(-1);
        bool is_sound = true;
        for (std::size_t i = 0; i < cells.size(); ++i) {
            const TrialColumn& column = columns_[i];
            const TextCell& cell = cells[i];
            switch (column.kind) {
            case Kind::stimulus:
                for (std::size_t slot = 0; slot < slots_.size(); ++slot) {
                    if (column.slot >= 0 && column.slot != static_cast<int>(slot))
                        continue;
                    is_spoken_of[slot] = is_spoken_of[slot] || column.slot >= 0;
                    if (cell.text.empty())
                        continue;
                    is_filled[slot] = is_filled[slot] || column.slot >= 0;
                    // Of a column for all slots, once.
                    const bool is_first = column.slot >= 0 || slot == 0;
                    is_sound = choose(column, cell, is_first, chosen[slot]) && is_sound;
                }
                break;
            case Kind::correct:
                row.correct = cell.text;
                break;
            case Kind::block:
                row.block = block_called(cell);
                break;
            case Kind::repeat:
                row.repeat = repeats_in(cell);
                break;
            case Kind::factor:
                add_level(row, text_.header[i].text, column, cell);
                break;
            case Kind::unknown:
                break;
            }
        }
        if (is_sound)
            fill(row, cells, chosen, is_spoken_of, is_filled);
        return row;
    }

    void add_level(TrialTableRow& row, const std::string& factor, const TrialColumn& column,
                   const TextCell& cell) {
        const std::optional<double> number = number_in_cell(text_, cell);
        std::string level = cell.text;
        if (number)
            std::ranges::replace(level, ',', '.'); // as tables write it
        if (column.is_duration && !level.empty() && !(number && *number > 0.0 && *number <= longest_step_s))
            error(cell.place, fmt::format("\"{}\" is no duration of a step", cell.text),
                  fmt::format("seconds, above 0 and up to {}", longest_step_s));
        else if (level.empty() && !column.is_duration)
            error(cell.place, fmt::format("the factor \"{}\" has no level in this row", factor),
                  "write one in every row, such as \"none\"");
        if (!level.empty())
            row.levels.push_back({factor, std::move(level)});
    }

    /// Puts what a cell names into the stimulus of a slot.
    bool choose(const TrialColumn& column, const TextCell& cell, bool reports,
                std::array<int, stimulus_lists.size()>& chosen) {
        std::size_t list = column.list >= 0 ? static_cast<std::size_t>(column.list) : 0;
        std::string_view rest = cell.text;
        bool is_sound = true;
        while (true) {
            const std::size_t end = column.list >= 0 ? std::string_view::npos : rest.find('/');
            const std::string_view id = rest.substr(0, end);
            if (list == stimulus_lists.size()) {
                if (reports)
                    error(cell.place, fmt::format("\"{}\" names more than the {} lists of a stimulus",
                                                  cell.text, stimulus_lists.size()));
                return false;
            }
            const std::vector<std::string> ids = ids_in(list);
            const int index = index_in(ids, id);
            if (index < 0 && reports)
                error(cell.place, fmt::format("there is no {} \"{}\"", stimulus_lists[list].name, id),
                      suggest_name(id, views_of(ids)));
            if (index >= 0 && chosen[list] >= 0 && chosen[list] != index && reports)
                error(cell.place,
                      fmt::format("another column says {} \"{}\" for the same slot",
                                  stimulus_lists[list].name, ids[static_cast<std::size_t>(chosen[list])]));
            is_sound = is_sound && index >= 0;
            chosen[list] = index;
            if (end == std::string_view::npos)
                return is_sound;
            rest.remove_prefix(end + 1);
            ++list;
        }
    }

    void fill(TrialTableRow& row, const std::vector<TextCell>& cells,
              const std::vector<std::array<int, stimulus_lists.size()>>& chosen,
              const std::vector<bool>& is_spoken_of, const std::vector<bool>& is_filled) {
        for (std::size_t slot = 0; slot < slots_.size(); ++slot) {
            if (is_spoken_of[slot] && !is_filled[slot])
                continue; // it stays empty
            Stimulus stimulus;
            for (std::size_t list = 0; list < stimulus_lists.size(); ++list) {
                const std::size_t entries = entries_of(protocol_, list).size();
                if (chosen[slot][list] < 0 && entries > 1 && missing_.insert({slot, list}).second)
                    error(cells.front().place,
                          fmt::format("nothing says which {} slot \"{}\" shows, of {}",
                                      stimulus_lists[list].name, slot_ids_[slot], entries),
                          fmt::format("add a column \"{}\", or \"{}.{}\"", stimulus_lists[list].name,
                                      slot_ids_[slot], stimulus_lists[list].name));
                stimulus.*stimulus_lists[list].index = std::max(0, chosen[slot][list]);
            }
            row.shown.push_back({stimulus, slots_[slot]});
        }
        if (row.shown.empty())
            error(cells.front().place, "all slots stay empty in this row", "a trial shows something");
    }

    int block_called(const TextCell& cell) {
        if (cell.text.empty())
            return -1;
        const std::vector<std::string> ids = ids_of(protocol_.blocks);
        const int block = index_in(ids, cell.text);
        if (block < 0)
            error(cell.place, fmt::format("there is no block \"{}\"", cell.text),
                  ids.empty() ? "the protocol has no [[block]]" : suggest_name(cell.text, views_of(ids)));
        return block;
    }

    int repeats_in(const TextCell& cell) {
        if (cell.text.empty())
            return 1;
        const std::optional<double> number = number_in_cell(text_, cell);
        if (number && *number >= 0 && *number <= most_repeats && *number == std::floor(*number))
            return static_cast<int>(*number);
        error(cell.place, fmt::format("\"{}\" is no number of repeats", cell.text),
              fmt::format("a whole number, 0 … {}", most_repeats));
        return 1;
    }

    std::vector<std::string> ids_in(std::size_t list) const {
        std::vector<std::string> ids;
        for (const ListEntry* entry : entries_of(protocol_, list))
            ids.push_back(entry->id);
        return ids;
    }
    static std::vector<std::string_view> views_of(const std::vector<std::string>& texts) {
        return {texts.begin(), texts.end()};
    }
    static int index_in(const auto& names, std::string_view name) {
        const auto found = std::ranges::find(names, name);
        return found == names.end() ? -1 : static_cast<int>(found - names.begin());
    }

    const DelimitedText& text_;
    const Protocol& protocol_;
    const Task& task_;
    std::vector<int> slots_;
    const std::string& file_;
    Diagnostics& diagnostics_;
    std::vector<std::string_view> lists_;
    std::vector<std::string> slot_ids_;
    std::vector<TrialColumn> columns_;
    std::set<std::pair<std::size_t, std::size_t>> missing_; ///< slots and lists that were reported
};

} // namespace

std::string_view level_in(const TrialTableRow& row, std::string_view factor) {
    const auto found = std::ranges::find(row.levels, factor, &TrialLevel::factor);
    return found == row.levels.end() ? std::string_view() : found->level;
}

TrialTable trial_table_of(const DelimitedText& text, const Protocol& protocol, int task,
                          const std::string& file, Diagnostics& diagnostics) {
    return TrialTableMaker(text, protocol, task, file, diagnostics).make();
}

} // namespace overt
