#include "experiment/factors.h"

#include <algorithm>

#include "experiment/base/error.h"
#include "experiment/base/text_number.h"

namespace overt {

namespace {

Factor factor_of_ids(std::string name, Factor::Source source, const std::vector<std::string>& ids) {
    Factor factor{std::move(name), source, 0, {}, {}};
    for (const std::string& id : ids)
        factor.levels.push_back({id});
    return factor;
}

Factor factor_of_list(std::size_t list, const std::vector<ListEntry>& entries) {
    Factor factor{std::string(stimulus_lists[list].name), Factor::Source::list, list, {}, {}};
    for (const ListEntry& entry : entries) {
        factor.level_of_entry.push_back(static_cast<int>(factor.levels.size()));
        factor.levels.push_back({entry.id});
    }
    return factor;
}

const NamedWord* column_of(const ListEntry& entry, std::string_view name) {
    const auto found = std::ranges::find(entry.columns, name, &NamedWord::name);
    return found == entry.columns.end() ? nullptr : &*found;
}

Factor factor_of_column(std::string_view name, std::size_t list, const std::vector<ListEntry>& entries) {
    Factor factor{std::string(name), Factor::Source::column, list, {}, {}};
    const auto level_of = [&](const ListEntry& entry) {
        const NamedWord* column = column_of(entry, name);
        return column ? FactorLevel{column->text, column->number} : FactorLevel{std::string(no_level)};
    };
    for (const ListEntry& entry : entries)
        if (std::ranges::find(factor.levels, level_of(entry)) == factor.levels.end())
            factor.levels.push_back(level_of(entry));
    // Words keep the order of the file, and come behind the numbers.
    std::ranges::stable_sort(factor.levels, [](const FactorLevel& one, const FactorLevel& other) {
        return one.number && (!other.number || *one.number < *other.number);
    });
    for (const ListEntry& entry : entries)
        factor.level_of_entry.push_back(
            static_cast<int>(std::ranges::find(factor.levels, level_of(entry)) - factor.levels.begin()));
    return factor;
}

Factor factor_of_own(std::string_view name, const std::vector<NamedWord>& own) {
    Factor factor{std::string(name), Factor::Source::own, 0, {}, {}};
    for (const NamedWord& level : own)
        if (level.name == name)
            factor.levels.push_back({level.text, level.number});
    std::ranges::stable_sort(factor.levels, [](const FactorLevel& one, const FactorLevel& other) {
        return one.number && (!other.number || *one.number < *other.number);
    });
    factor.levels.push_back({std::string(no_level)});
    return factor;
}

} // namespace

std::string_view own_level(const Trial& trial, std::string_view factor) {
    if (factor == correct_answer)
        return trial.correct;
    const auto found = std::ranges::find(trial.levels, factor, &TrialLevel::factor);
    return found == trial.levels.end() ? std::string_view() : found->level;
}

void OwnLevels::add(std::string_view factor, std::string_view level) {
    if (!level.empty() && known_.emplace(factor, level).second)
        levels_.push_back({std::string(factor), std::string(level), number_in<double>(level)});
}

std::vector<NamedWord> own_levels_of(const std::vector<Trial>& trials) {
    OwnLevels own;
    for (const Trial& trial : trials) {
        for (const TrialLevel& of : trial.levels)
            own.add(of.factor, of.level);
        own.add(correct_answer, trial.correct);
    }
    return own.levels();
}

Factors::Factors(const FactorSources& sources) {
    all_.push_back(factor_of_ids("task", Factor::Source::task, sources.tasks));
    for (std::size_t list = 0; list < stimulus_lists.size(); ++list) {
        entries_[list] = sources.lists[list].size();
        all_.push_back(factor_of_list(list, sources.lists[list]));
    }
    all_.push_back(factor_of_ids("stimulus", Factor::Source::stimulus, {}));
    if (!sources.blocks.empty())
        all_.push_back(factor_of_ids("block", Factor::Source::block, sources.blocks));
    for (std::size_t list = 0; list < stimulus_lists.size(); ++list)
        for (const ListEntry& entry : sources.lists[list])
            for (const NamedWord& column : entry.columns)
                if (!find(column.name))
                    all_.push_back(factor_of_column(column.name, list, sources.lists[list]));
    for (const NamedWord& level : sources.own)
        if (!find(level.name))
            all_.push_back(factor_of_own(level.name, sources.own));
}

const Factor* Factors::find(std::string_view name) const {
    const auto found = std::ranges::find(all_, name, &Factor::name);
    return found == all_.end() ? nullptr : &*found;
}

const Factor& Factors::at(std::string_view name) const {
    const Factor* factor = find(name);
    OVERT_EXPECTS(factor != nullptr);
    return *factor;
}

std::vector<std::string_view> Factors::names() const {
    std::vector<std::string_view> names;
    for (const Factor& factor : all_)
        names.push_back(factor.name);
    return names;
}

int Factors::level_of(const Factor& factor, const Trial& trial) const {
    return level_of(factor, trial, trial.stimulus);
}

int Factors::level_of(const Factor& factor, const Trial& trial, const Stimulus& stimulus) const {
    int number = 0;
    switch (factor.source) {
    case Factor::Source::task:
        return trial.task;
    case Factor::Source::block:
        return trial.block;
    case Factor::Source::list:
    case Factor::Source::column:
        return factor.level_of_entry.at(
            static_cast<std::size_t>(stimulus.*stimulus_lists[factor.list].index));
    case Factor::Source::own: {
        const auto level =
            std::ranges::find(factor.levels, own_level(trial, factor.name), &FactorLevel::name);
        return static_cast<int>(
            std::min(level - factor.levels.begin(), static_cast<std::ptrdiff_t>(factor.levels.size()) - 1));
    }
    case Factor::Source::stimulus:
        break;
    }
    for (std::size_t list = 0; list < stimulus_lists.size(); ++list)
        number = number * static_cast<int>(entries_[list]) + stimulus.*stimulus_lists[list].index;
    return number;
}

std::size_t Factors::stimulus_count() const {
    std::size_t count = 1;
    for (const std::size_t entries : entries_)
        count *= entries;
    return count;
}

Stimulus Factors::stimulus_at(int number) const {
    Stimulus stimulus;
    for (std::size_t list = stimulus_lists.size(); list-- > 0;) {
        stimulus.*stimulus_lists[list].index = number % static_cast<int>(entries_[list]);
        number /= static_cast<int>(entries_[list]);
    }
    return stimulus;
}

bool is_name_of_factor(std::string_view name) {
    // Columns that tables of trials, samples, events and studies have besides.
    constexpr std::string_view others[] = {
        "task",        "stimulus",   "block",    "trial",   "attempt",    "observer", "group",  "session",
        "sitting",     "day",        "slot",     "step",    "side",       "correct",  "phase",  "onset",
        "duration",    "status",     "counts",   "failure", "timing",     "eye",      "source", "question",
        "answer",      "frames",     "frame",    "value",   "device",     "samples",  "part",   "area",
        "depth",       "kind",       "pose",     "n",       "duration_s", "x_px",     "y_px",   "angle_deg",
        "comes_again", "trial_type", "stim_file"};
    return std::ranges::find(others, name) != std::end(others) ||
           std::ranges::find(stimulus_lists, name, &StimulusList::name) != stimulus_lists.end();
}

} // namespace overt
