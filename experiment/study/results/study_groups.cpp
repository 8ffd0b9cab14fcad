#include "experiment/study/results/study_groups.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/error.h"

namespace overt {

namespace {

std::optional<double> number_in(const std::string& text) {
    double number = 0.0;
    const auto end = text.data() + text.size();
    const auto result = std::from_chars(text.data(), end, number);
    return result.ec == std::errc() && result.ptr == end ? std::optional(number) : std::nullopt;
}

void check_column(const StudyResults& results, const std::string& column) {
    std::vector<std::string> known;
    for (const StudyTrial& trial : results.trials) {
        for (const StudyKey& key : trial.keys) {
            if (key.column == column)
                return;
            if (std::find(known.begin(), known.end(), key.column) == known.end())
                known.push_back(key.column);
        }
    }
    if (!results.trials.empty())
        throw InputError(fmt::format("--by {}: no trial has such a column; there are {}.", column,
                                     fmt::join(known, ", ")));
}

} // namespace

std::vector<std::string> levels_of(const StudyResults& results, const std::string& column,
                                   const LevelLists& order) {
    std::set<std::string> found;
    for (const StudyTrial& trial : results.trials) {
        if (!trial.excluded)
            found.insert(trial.key(column));
    }
    std::vector<std::string> levels;
    if (const auto listed = order.find(column); listed != order.end()) {
        for (const std::string& level : listed->second) {
            if (found.erase(level) > 0)
                levels.push_back(level);
        }
    }
    std::vector<std::string> others(found.begin(), found.end());
    if (std::all_of(others.begin(), others.end(), [](auto& text) { return number_in(text).has_value(); }))
        std::stable_sort(others.begin(), others.end(),
                         [](auto& a, auto& b) { return *number_in(a) < *number_in(b); });
    levels.insert(levels.end(), others.begin(), others.end());
    return levels;
}

void check_asked_factors(const std::vector<std::string>& by, const LevelLists& levels) {
    for (const std::string& column : by) {
        const auto factor = levels.find(column);
        if (factor == levels.end() || factor->second.size() != 1)
            continue;
        std::vector<std::string> several;
        for (const auto& [other, of_other] : levels)
            if (of_other.size() > 1)
                several.push_back(other);
        throw InputError(fmt::format("--by {}: this factor has one level, \"{}\", and makes no groups; {}.",
                                     column, factor->second.front(),
                                     several.empty()
                                         ? "no factor has several"
                                         : fmt::format("several have {}", fmt::join(several, ", "))));
    }
}

std::vector<StudyGroup> make_groups(const StudyResults& results, const std::vector<std::string>& by,
                                    const LevelLists& order) {
    std::map<std::vector<std::size_t>, StudyGroup> groups;
    std::vector<std::vector<std::string>> levels;
    for (const std::string& column : by) {
        check_column(results, column);
        levels.push_back(levels_of(results, column, order));
    }
    for (int t = 0; t < static_cast<int>(results.trials.size()); ++t) {
        const StudyTrial& trial = results.trials[static_cast<std::size_t>(t)];
        if (trial.excluded)
            continue;
        std::vector<std::size_t> place;
        std::vector<StudyKey> keys;
        for (std::size_t i = 0; i < by.size(); ++i) {
            keys.push_back({by[i], trial.key(by[i])});
            place.push_back(static_cast<std::size_t>(
                std::find(levels[i].begin(), levels[i].end(), keys.back().value) - levels[i].begin()));
        }
        StudyGroup& group = groups[place];
        group.keys = std::move(keys);
        group.trials.push_back(t);
    }
    std::vector<StudyGroup> made;
    for (auto& [place, group] : groups) {
        group.observers = static_cast<int>(by_observer(results, group.trials).size());
        for (const int trial : group.trials)
            for_each_counted(results, trial, [&group = group](const StudyFixation&) { ++group.fixations; });
        made.push_back(std::move(group));
    }
    return made;
}

std::vector<StudyGroup> all_and_levels(const StudyResults& results, const std::vector<std::string>& by,
                                       const LevelLists& order) {
    std::vector<StudyGroup> groups = make_groups(results, {}, order);
    for (const std::string& column : by) {
        if (column != "observer")
            std::ranges::move(make_groups(results, {column}, order), std::back_inserter(groups));
    }
    return groups;
}

const std::string& observer_of(const StudyResults& results, int trial) {
    const int session = results.trials[static_cast<std::size_t>(trial)].session;
    return results.sessions[static_cast<std::size_t>(session)].observer;
}

std::vector<std::pair<std::string, std::vector<int>>> by_observer(const StudyResults& results,
                                                                  const std::vector<int>& trials) {
    std::vector<std::pair<std::string, std::vector<int>>> observers;
    for (const int trial : trials) {
        const std::string& label = observer_of(results, trial);
        auto found = std::find_if(observers.begin(), observers.end(),
                                  [&](const auto& observer) { return observer.first == label; });
        if (found == observers.end())
            found = observers.insert(observers.end(), {label, {}});
        found->second.push_back(trial);
    }
    return observers;
}

} // namespace overt
