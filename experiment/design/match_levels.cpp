#include "experiment/design/match_levels.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/answers/answer_kinds.h"

namespace overt {

namespace {

const NamedWord* number_of(const ListEntry& entry, std::string_view column) {
    const auto found = std::ranges::find(entry.columns, column, &NamedWord::name);
    return found == entry.columns.end() || !found->number ? nullptr : &*found;
}

/// The list of which some entry has a number in this column; nothing: none has.
std::optional<std::size_t> list_with_numbers(const Protocol& protocol, std::string_view column) {
    for (std::size_t list = 0; list < stimulus_lists.size(); ++list)
        for (const ListEntry* entry : entries_of(protocol, list))
            if (number_of(*entry, column))
                return list;
    return std::nullopt;
}

/// Whether two entries are alike in all columns that nothing is set along.
bool are_alike(const ListEntry& one, const ListEntry& other, const std::vector<std::string>& along) {
    const auto has_all_of = [&](const ListEntry& these, const ListEntry& those) {
        return std::ranges::all_of(these.columns, [&](const NamedWord& column) {
            if (std::ranges::find(along, column.name) != along.end())
                return true;
            const auto found = std::ranges::find(those.columns, column.name, &NamedWord::name);
            return found != those.columns.end() && found->text == column.text;
        });
    };
    return has_all_of(one, other) && has_all_of(other, one);
}

/// The columns of one list, and the entries among which a level is chosen.
struct ColumnsOfList {
    std::size_t list = 0;
    std::vector<std::size_t> axes; ///< indices into the answer's columns
    std::vector<int> entries;
};

} // namespace

std::optional<int> level_at(const std::vector<double>& values, double value) {
    const double grain = 1e-9 * std::max(1.0, std::abs(value));
    const auto found =
        std::ranges::find_if(values, [&](double one) { return std::abs(one - value) <= grain; });
    return found == values.end() ? std::nullopt : std::optional(static_cast<int>(found - values.begin()));
}

bool is_match(const TaskAnswer& answer) { return row_of(answer.kind).make == match_answering; }

MatchLevels match_levels_of(const Protocol& protocol, const TaskAnswer& answer, const Stimulus& stimulus,
                            MatchProblem& problem) {
    const auto none = [&](std::string message, std::string hint) {
        problem = {std::move(message), std::move(hint)};
        return MatchLevels{};
    };
    MatchLevels levels;
    std::vector<ColumnsOfList> lists;
    for (std::size_t axis = 0; axis < answer.along.size(); ++axis) {
        const std::string& column = answer.along[axis];
        const std::optional<std::size_t> list = list_with_numbers(protocol, column);
        if (!list)
            return none(fmt::format("no entry has a number in a column \"{}\"", column),
                        "columns come of series = { … } or columns = { … } of materials and lights");
        if (stimulus_lists[*list].decides_map)
            return none(
                fmt::format("\"{}\" is a column of {}: what is set has to keep its shape and its place",
                            column, stimulus_lists[*list].plural),
                "set along a column of materials or lights");
        auto of_list = std::ranges::find(lists, *list, &ColumnsOfList::list);
        if (of_list == lists.end())
            of_list = lists.insert(lists.end(), {*list, {}, {}});
        of_list->axes.push_back(axis);
        levels.axes.push_back({.along = column, .values = {}});
    }
    for (ColumnsOfList& of : lists) {
        const std::vector<const ListEntry*> entries = entries_of(protocol, of.list);
        const ListEntry& base = *entries[static_cast<std::size_t>(stimulus.*stimulus_lists[of.list].index)];
        for (std::size_t i = 0; i < entries.size(); ++i) {
            const bool has_numbers = std::ranges::all_of(
                of.axes, [&](std::size_t axis) { return number_of(*entries[i], answer.along[axis]); });
            if (!has_numbers || !are_alike(*entries[i], base, answer.along))
                continue;
            of.entries.push_back(static_cast<int>(i));
            for (const std::size_t axis : of.axes)
                levels.axes[axis].values.push_back(*number_of(*entries[i], answer.along[axis])->number);
        }
        if (of.entries.empty())
            return none(fmt::format("no {} with numbers in {} is like \"{}\" in its other columns",
                                    stimulus_lists[of.list].name, fmt::join(answer.along, " and "), base.id),
                        "give those that belong together the same columns, or name one of them in shows = "
                        "{ … }");
    }
    for (MatchLevels::Axis& axis : levels.axes) {
        std::ranges::sort(axis.values);
        axis.values.erase(std::unique(axis.values.begin(), axis.values.end()), axis.values.end());
        if (axis.values.size() < 2)
            return none(
                fmt::format("there is one level of \"{}\" only, {:g}", axis.along, axis.values.front()),
                "a match is set from level to level: give the series more values");
    }
    std::vector<std::size_t> at(levels.axes.size());
    const std::size_t across = levels.axes.size() > 1 ? levels.axes[1].values.size() : 1;
    for (std::size_t level = 0; level < levels.axes[0].values.size() * across; ++level) {
        at[0] = level / across;
        if (at.size() > 1)
            at[1] = level % across;
        Stimulus& shown = levels.stimuli.emplace_back(stimulus);
        for (const ColumnsOfList& of : lists) {
            const std::vector<const ListEntry*> entries = entries_of(protocol, of.list);
            std::vector<int> fitting;
            for (const int entry : of.entries)
                if (std::ranges::all_of(of.axes, [&](std::size_t axis) {
                        return *number_of(*entries[static_cast<std::size_t>(entry)], answer.along[axis])
                                    ->number == levels.axes[axis].values[at[axis]];
                    }))
                    fitting.push_back(entry);
            std::vector<std::string> wanted;
            for (const std::size_t axis : of.axes)
                wanted.push_back(
                    fmt::format("{} {:g}", answer.along[axis], levels.axes[axis].values[at[axis]]));
            if (fitting.empty())
                return none(fmt::format("there is no {} with {}", stimulus_lists[of.list].name,
                                        fmt::join(wanted, " and ")),
                            "along two columns each value of the one needs an entry with each of the other");
            if (fitting.size() > 1)
                return none(fmt::format("{} {} have {}: which is meant nobody can tell", fitting.size(),
                                        stimulus_lists[of.list].plural, fmt::join(wanted, " and ")),
                            "give them columns in which they differ: columns = { base = \"red\" }");
            shown.*stimulus_lists[of.list].index = fitting.front();
        }
    }
    return levels;
}

MatchLevels match_levels(const Protocol& protocol, const TaskAnswer& answer, const Trial& trial) {
    const std::vector<int> slots = slots_named(protocol, {answer.slot});
    std::optional<std::size_t> place;
    for (std::size_t i = 0; i < trial.shown_count() && !slots.empty() && !place; ++i)
        if (trial.shown(i).slot == slots.front())
            place = i;
    if (!place)
        return {};
    MatchProblem problem;
    MatchLevels levels = match_levels_of(protocol, answer, trial.shown(*place).stimulus, problem);
    levels.place = static_cast<int>(*place);
    levels.slot = trial.shown(*place).slot;
    for (MatchLevels::Axis& axis : levels.axes) {
        const std::size_t list = *list_with_numbers(protocol, axis.along);
        const std::vector<const ListEntry*> entries = entries_of(protocol, list);
        for (std::size_t i = 0; i < trial.shown_count() && !axis.reference; ++i) {
            const int entry = trial.shown(i).stimulus.*stimulus_lists[list].index;
            if (i != *place)
                if (const NamedWord* number =
                        number_of(*entries[static_cast<std::size_t>(entry)], axis.along))
                    axis.reference = number->number;
        }
    }
    return levels;
}

void fill_matched_slots(const Protocol& protocol, Trial& trial) {
    for (const TaskAnswer& answer : protocol.tasks[static_cast<std::size_t>(trial.task)].answers) {
        const std::vector<int> slots = slots_named(protocol, {answer.slot});
        if (!is_match(answer) || slots.empty())
            continue;
        PlacedStimulus wanted{trial.stimulus, slots.front()};
        PlacedStimulus* there = nullptr;
        for (PlacedStimulus& beside : trial.beside)
            if (beside.slot == wanted.slot)
                there = &beside;
        if (there)
            wanted.stimulus = there->stimulus;
        for (std::size_t list = 0; list < stimulus_lists.size(); ++list) {
            const auto said = std::ranges::find(answer.shows, stimulus_lists[list].name, &NamedWord::name);
            const std::vector<std::string_view> ids = ids_in_list(protocol, list);
            if (said == answer.shows.end())
                continue;
            if (const auto entry = std::ranges::find(ids, said->text); entry != ids.end())
                wanted.stimulus.*stimulus_lists[list].index = static_cast<int>(entry - ids.begin());
        }
        MatchProblem problem;
        const MatchLevels levels = match_levels_of(protocol, answer, wanted.stimulus, problem);
        if (!levels.stimuli.empty())
            wanted.stimulus = levels.stimuli.front();
        if (trial.slot == wanted.slot)
            trial.stimulus = wanted.stimulus;
        else if (there)
            *there = wanted;
        else
            trial.beside.push_back(wanted);
    }
}

std::vector<PlacedStimulus> loaded_for(const Protocol& protocol, const Trial& trial,
                                       std::vector<std::size_t>* first_levels) {
    std::vector<PlacedStimulus> loaded = trial.all_shown();
    for (const TaskAnswer& answer : protocol.tasks[static_cast<std::size_t>(trial.task)].answers) {
        if (!is_match(answer))
            continue;
        if (first_levels)
            first_levels->push_back(loaded.size());
        const MatchLevels levels = match_levels(protocol, answer, trial);
        for (const Stimulus& stimulus : levels.stimuli)
            loaded.push_back({stimulus, levels.slot});
    }
    return loaded;
}

} // namespace overt
