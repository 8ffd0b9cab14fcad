/// What differs between trials: the lists that stimuli are made of, the columns of their entries, task,
/// block. Orders, checks, tables and commands ask here, and know no factor by itself.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiment/list_entry.h"
#include "experiment/stimulus_lists.h"
#include "experiment/trial.h"

namespace overt {

/// What stands in tables where an entry has nothing in a column.
inline constexpr std::string_view no_level = "n/a";

struct FactorLevel {
    std::string name; ///< an id or a word; of a number: as it is written in tables
    std::optional<double> number = {};
    bool operator==(const FactorLevel&) const = default;
};

struct Factor {
    enum class Source : std::uint8_t {
        task,
        list,     ///< the entry itself
        column,   ///< of the entries of a list
        stimulus, ///< all lists at once
        block,
        own ///< of the trial itself: a column of its table, its side, its correct answer
    };
    std::string name;
    Source source = Source::task;
    std::size_t list = 0; ///< of list and column: row of stimulus_lists
    /// Ids in the order of the file; words in the order in which they come up, numbers in rising order. Of
    /// stimuli: none, they are numbered only.
    std::vector<FactorLevel> levels;
    std::vector<int> level_of_entry; ///< of list and column: by index of the entry

    bool is_of_list(std::size_t row) const {
        return list == row && (source == Source::list || source == Source::column);
    }
};

/// What factors are made of.
struct FactorSources {
    std::vector<std::string> tasks, blocks; ///< ids
    std::array<std::vector<ListEntry>, stimulus_lists.size()> lists;
    std::vector<NamedWord> own; ///< each level of each factor that trials have of their own
};

/// The name of the factor whose level is a trial's correct answer.
inline constexpr std::string_view correct_answer = "correct";

/// The level of a factor that a trial has of its own; empty where it has none.
std::string_view own_level(const Trial& trial, std::string_view factor);

/// Levels of factors that trials have of their own, each once, in the order in which they come up.
class OwnLevels {
  public:
    /// Does nothing where there is no level.
    void add(std::string_view factor, std::string_view level);
    const std::vector<NamedWord>& levels() const { return levels_; }

  private:
    std::set<std::pair<std::string, std::string>> known_;
    std::vector<NamedWord> levels_;
};

/// What planned trials have of their own, for FactorSources: each level once.
std::vector<NamedWord> own_levels_of(const std::vector<Trial>& trials);

/// All factors of an experiment.
class Factors {
  public:
    Factors() = default;
    explicit Factors(const FactorSources& sources);

    /// task, the lists, stimulus, block (where there are any), then columns, list by list, then the trials'
    /// own. The last level of an own factor is that of trials without one.
    const std::vector<Factor>& all() const { return all_; }

    /// Null if there is none of this name.
    const Factor* find(std::string_view name) const;
    /// It must be there.
    const Factor& at(std::string_view name) const;

    /// All names, for hints.
    std::vector<std::string_view> names() const;

    /// An index into the factor's levels. Stimuli are numbered with the last list running fastest.
    int level_of(const Factor& factor, const Trial& trial) const;
    int level_of(const Factor& factor, const Trial& trial, const Stimulus& stimulus) const;

    /// Stimuli that the lists make in all.
    std::size_t stimulus_count() const;
    /// The one of a number.
    Stimulus stimulus_at(int number) const;

  private:
    std::vector<Factor> all_;
    std::array<std::size_t, stimulus_lists.size()> entries_{}; ///< of each list
};

/// Whether a column may not be called so, since a factor or a column of every table is.
bool is_name_of_factor(std::string_view name);

} // namespace overt
