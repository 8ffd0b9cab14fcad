/// Which trials belong together, and whose they are.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "experiment/study/results/study_results.h"

namespace overt {

/// The values of columns in an order that a reader expects: those of a list as the protocol has them.
using LevelLists = std::map<std::string, std::vector<std::string>>;

/// The values that a column has in trials that are not excluded, each once: as `order` has them; others
/// after these, as numbers if they all are, else by the alphabet.
std::vector<std::string> levels_of(const StudyResults& results, const std::string& column,
                                   const LevelLists& order);

/// Throws InputError for a factor of the protocol that has one level only, by its name, with those that have
/// several.
void check_asked_factors(const std::vector<std::string>& by, const LevelLists& levels);

/// Groups of trials with the same values in these columns, in the order of their levels, the last column's
/// fastest. Without columns one group has them all. Throws InputError, which lists the columns, if no trial
/// has such a column.
std::vector<StudyGroup> make_groups(const StudyResults& results, const std::vector<std::string>& by,
                                    const LevelLists& order);

/// All trials in one group, then those of each level of each of these columns, but for observers.
std::vector<StudyGroup> all_and_levels(const StudyResults& results, const std::vector<std::string>& by,
                                       const LevelLists& order);

/// The observer's label of a trial.
const std::string& observer_of(const StudyResults& results, int trial);

/// Trials by observer, in the order of the sessions.
std::vector<std::pair<std::string, std::vector<int>>> by_observer(const StudyResults& results,
                                                                  const std::vector<int>& trials);

/// The counted fixations of a trial, in their order.
template <class Visit> void for_each_counted(const StudyResults& results, int trial, const Visit& visit) {
    const StudyTrial& of = results.trials[static_cast<std::size_t>(trial)];
    for (std::size_t i = of.first_fixation; i < of.first_fixation + of.fixations; ++i) {
        if (results.fixations[i].counted())
            visit(results.fixations[i]);
    }
}

/// The counted fixations on an object, of all trials in their order.
template <class Visit> void for_each_counted_on(const StudyResults& results, int object, const Visit& visit) {
    for (std::size_t trial = 0; trial < results.trials.size(); ++trial) {
        if (results.trials[trial].object == object)
            for_each_counted(results, static_cast<int>(trial), visit);
    }
}

} // namespace overt
