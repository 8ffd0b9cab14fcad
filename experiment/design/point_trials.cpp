#include "experiment/design/point_trials.h"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "experiment/base/random.h"
#include "experiment/design/block_plan.h"
#include "experiment/design/rules/trial_rules.h"
#include "experiment/factors.h"

namespace overt {

namespace {

/// Probes that share a list.
struct ProbesOfList {
    const PointListSettings* list;
    std::vector<std::size_t> probes; ///< indices into the task's
};

std::vector<ProbesOfList> probes_by_list(const Protocol& protocol, const Task& task,
                                         const std::vector<std::string>& said) {
    std::vector<ProbesOfList> lists;
    for (std::size_t i = 0; i < task.probes.size(); ++i) {
        const PointListSettings* const list = point_list(protocol, task.probes[i].points);
        if (!list || std::ranges::find(said, task.probes[i].id) != said.end())
            continue;
        const auto known = std::ranges::find(lists, list, &ProbesOfList::list);
        if (known == lists.end())
            lists.push_back({list, {i}});
        else
            known->probes.push_back(i);
    }
    return lists;
}

/// An index of a place for each probe; -1 of those that have none here.
using ProbePlaces = std::vector<int>;

/// All rising choices of `probes.size()` of the list's places, put behind each of `so_far`.
std::vector<ProbePlaces> crossed_with(const std::vector<ProbePlaces>& so_far, const ProbesOfList& of) {
    const int places = of.list->count(), chosen = static_cast<int>(of.probes.size());
    std::vector<ProbePlaces> all;
    if (chosen > places)
        return all;
    std::vector<int> rising(of.probes.size());
    std::iota(rising.begin(), rising.end(), 0);
    while (true) {
        for (ProbePlaces combination : so_far) {
            for (std::size_t i = 0; i < rising.size(); ++i)
                combination[of.probes[i]] = rising[i];
            all.push_back(std::move(combination));
        }
        int at = chosen - 1;
        while (at >= 0 && rising[static_cast<std::size_t>(at)] == places - chosen + at)
            --at;
        if (at < 0)
            return all;
        ++rising[static_cast<std::size_t>(at)];
        for (int next = at + 1; next < chosen; ++next)
            rising[static_cast<std::size_t>(next)] = rising[static_cast<std::size_t>(next) - 1] + 1;
    }
}

std::vector<ProbePlaces> combinations_for(const Task& task, const std::vector<ProbesOfList>& lists,
                                          RandomStream random) {
    std::vector<ProbePlaces> all{ProbePlaces(task.probes.size(), -1)};
    for (const ProbesOfList& of : lists)
        all = crossed_with(all, of);
    if (task.draw_points && static_cast<std::size_t>(*task.draw_points) < all.size()) {
        std::vector<std::size_t> order(all.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        random.shuffle(std::span(order));
        order.resize(static_cast<std::size_t>(*task.draw_points));
        std::ranges::sort(order);
        std::vector<ProbePlaces> drawn;
        for (const std::size_t i : order)
            drawn.push_back(all[i]);
        all = std::move(drawn);
    }
    // Which of two places has which mark says nothing of the places.
    for (ProbePlaces& combination : all)
        for (const ProbesOfList& of : lists) {
            std::vector<int> places;
            for (const std::size_t probe : of.probes)
                places.push_back(combination[probe]);
            random.shuffle(std::span(places));
            for (std::size_t i = 0; i < of.probes.size(); ++i)
                combination[of.probes[i]] = places[i];
        }
    return all;
}

void add_places(Trial& trial, const Protocol& protocol, const Task& task, const ProbePlaces& places) {
    for (std::size_t i = 0; i < places.size(); ++i)
        if (places[i] >= 0)
            trial.levels.push_back(
                {task.probes[i].id, point_list(protocol, task.probes[i].points)->name_of(places[i])});
}

/// The probes whose places a table says, by their ids.
std::vector<std::string> probes_of_table(const Protocol& protocol, const Task& task) {
    std::vector<std::string> said;
    if (task.trials.table >= 0)
        said = protocol.trial_tables.at(static_cast<std::size_t>(task.trials.table)).factors;
    return said;
}

} // namespace

const PointListSettings* point_list(const Protocol& protocol, std::string_view id) {
    const auto found = std::ranges::find(protocol.point_lists, id, &PointListSettings::id);
    return found == protocol.point_lists.end() ? nullptr : &*found;
}

std::size_t point_combinations(const Protocol& protocol, const Task& task, std::size_t at_most) {
    std::size_t count = 1;
    for (const ProbesOfList& of : probes_by_list(protocol, task, probes_of_table(protocol, task))) {
        // n over k, factor by factor, each quotient whole.
        const auto places = static_cast<std::size_t>(of.list->count());
        std::size_t ways = 1;
        for (std::size_t i = 0; i < of.probes.size() && ways < at_most; ++i)
            ways = i < places ? ways * (places - i) / (i + 1) : 0;
        count = ways > at_most / std::max<std::size_t>(count, 1) ? at_most : count * ways;
    }
    return count;
}

std::vector<Trial> with_points(const Protocol& protocol, std::vector<Trial> trials, int task, int block,
                               int observer_number, std::uint64_t seed) {
    const Task& settings = protocol.tasks.at(static_cast<std::size_t>(task));
    const std::vector<ProbesOfList> lists =
        probes_by_list(protocol, settings, probes_of_table(protocol, settings));
    if (lists.empty() || trials.empty())
        return trials;
    const std::vector<ProbePlaces> combinations = combinations_for(
        settings, lists,
        RandomStream(seed,
                     fmt::format("points of task {} in block {}", settings.id, block_at(protocol, block).id),
                     static_cast<std::uint64_t>(observer_number)));
    if (combinations.empty())
        return trials;
    const bool has_place_each = settings.trials.rule && (row_of(*settings.trials.rule).keeps_order ||
                                                         !settings.trials.procedures.empty());
    std::vector<Trial> all;
    for (std::size_t i = 0; i < trials.size(); ++i) {
        for (std::size_t k = 0; k < combinations.size(); ++k) {
            if (has_place_each && k != i % combinations.size())
                continue;
            all.push_back(trials[i]);
            add_places(all.back(), protocol, settings, combinations[k]);
        }
    }
    return all;
}

std::vector<TrialLevel> first_points(const Protocol& protocol, int task) {
    const Task& settings = protocol.tasks.at(static_cast<std::size_t>(task));
    Trial trial;
    ProbePlaces places(settings.probes.size(), -1);
    for (const ProbesOfList& of : probes_by_list(protocol, settings, {}))
        for (std::size_t i = 0; i < of.probes.size(); ++i)
            places[of.probes[i]] = std::min(static_cast<int>(i), of.list->count() - 1);
    add_places(trial, protocol, settings, places);
    return trial.levels;
}

} // namespace overt
