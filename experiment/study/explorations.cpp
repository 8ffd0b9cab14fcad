#include "experiment/study/explorations.h"

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <set>

namespace overt {

namespace {

using Shows = std::vector<const ExplorationRow*>;

double mean_of(const Shows& shows, const std::function<double(const ExplorationRow&)>& value) {
    double sum = 0.0;
    for (const ExplorationRow* show : shows)
        sum += value(*show);
    return sum / static_cast<double>(shows.size());
}

/// The measures of some shows together; nothing where there is no such number.
struct Measures {
    double path_deg = 0.0, reversals = 0.0, poses = 0.0;
    std::optional<double> turned_share, speed_deg_s;
};

Measures measures_of(const Shows& shows) {
    const double seconds = mean_of(shows, [](const ExplorationRow&show) { return show.seconds; }),
                 turning_s = mean_of(shows, [](const ExplorationRow&show) { return show.turning_s; });
    Measures measures;
    measures.path_deg = mean_of(shows, [](const ExplorationRow& show) { return show.path_deg; });
    measures.reversals = mean_of(shows, [](const ExplorationRow& show) { return show.reversals; });
    measures.poses = mean_of(shows, [](const ExplorationRow& show) { return show.poses; });
    if (seconds > 0.0)
        measures.turned_share = turning_s / seconds;
    if (turning_s > 0.0)
        measures.speed_deg_s = measures.path_deg / turning_s;
    return measures;
}

void estimate(ExplorationSummaryRow& row, const std::vector<Measures>& each,
              const BootstrapSettings& bootstrap) {
    const auto over = [&](const auto& value, const char* reason, Interval range = from_zero_on) {
        std::vector<double> values;
        for (const Measures& measures : each)
            if (const std::optional<double> one = value(measures))
                values.push_back(*one);
        return estimated_mean(values, bootstrap, reason, range);
    };
    row.path_deg = over([](const Measures& of) { return std::optional(of.path_deg); }, "no show");
    row.reversals = over([](const Measures& of) { return std::optional(of.reversals); }, "no show");
    row.poses = over([](const Measures& of) { return std::optional(of.poses); }, "no show");
    row.turned_share =
        over([](const Measures& of) { return of.turned_share; }, "shown for no time", zero_to_one);
    row.speed_deg_s = over([](const Measures& of) { return of.speed_deg_s; }, "never turned");
}

void add_rows(StudyExplorations& to, const Shows& shows, const std::string& column, const std::string& level,
              const BootstrapSettings& bootstrap) {
    std::map<std::string, Shows> by_observer;
    for (const ExplorationRow* show : shows)
        by_observer[show->observer].push_back(show);
    std::vector<Measures> of_observers;
    std::vector<ExplorationSummaryRow> single;
    for (const auto& [observer, own] : by_observer) {
        of_observers.push_back(measures_of(own));
        ExplorationSummaryRow& row = single.emplace_back();
        row = {observer, column, level, static_cast<int>(own.size()), 1, {}, {}, {}, {}, {}};
        std::vector<Measures> of_shows;
        for (const ExplorationRow* show : own)
            of_shows.push_back(measures_of({show}));
        estimate(row, of_shows, bootstrap);
    }
    ExplorationSummaryRow& all = to.summaries.emplace_back();
    all = {"", column, level, static_cast<int>(shows.size()), static_cast<int>(by_observer.size()), {}, {},
           {}, {},     {}};
    estimate(all, of_observers, bootstrap);
    to.summaries.insert(to.summaries.end(), single.begin(), single.end());
}

std::string level_in(const ExplorationRow& show, const std::string& column) {
    const auto found = std::ranges::find(show.levels, column, &std::pair<std::string, std::string>::first);
    return found == show.levels.end() ? std::string() : found->second;
}

} // namespace

void reckon_explorations(StudyExplorations& explorations, const BootstrapSettings& bootstrap) {
    explorations.summaries.clear();
    if (explorations.shows.empty())
        return;
    Shows all;
    std::vector<std::string> columns;
    for (const ExplorationRow& show : explorations.shows) {
        all.push_back(&show);
        for (const auto& [column, level] : show.levels)
            if (std::ranges::find(columns, column) == columns.end())
                columns.push_back(column);
    }
    add_rows(explorations, all, "", "", bootstrap);
    for (const std::string& column : columns) {
        std::set<std::string> levels;
        for (const ExplorationRow& show : explorations.shows)
            levels.insert(level_in(show, column));
        levels.erase("");
        if (levels.size() < 2)
            continue;
        for (const std::string& level : levels) {
            Shows of_level;
            for (const ExplorationRow* show : all)
                if (level_in(*show, column) == level)
                    of_level.push_back(show);
            add_rows(explorations, of_level, column, level, bootstrap);
        }
    }
}

} // namespace overt
