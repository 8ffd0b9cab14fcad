#include "experiment/study/map_reliability.h"

#include <algorithm>
#include <iterator>

#include "experiment/base/parallel.h"
#include "experiment/statistics/map_agreement.h"
#include "experiment/study/study_maps.h"

namespace overt {

std::vector<MapReliabilityRow> map_reliabilities(const StudyResults& results, const ObjectFixationMaps& maps,
                                                 const LevelLists& levels, const StudyOptions& options) {
    std::vector<StudyGroup> groups = results.groups;
    std::vector<std::string> columns;
    for (const std::string& column : options.by) {
        if (column != "object")
            columns.push_back(column);
    }
    if (columns.size() > 1) {
        for (const std::string& column : columns)
            std::ranges::copy(make_groups(results, {column}, levels), std::back_inserter(groups));
    }
    if (!columns.empty())
        std::ranges::copy(make_groups(results, {}, levels), std::back_inserter(groups));

    std::vector<MapReliabilityRow> rows;
    std::vector<const StudyGroup*> group_of_row;
    for (const StudyGroup& group : groups) {
        for (const int object : objects_of(results, group)) {
            if (!maps[static_cast<std::size_t>(object)])
                continue;
            MapReliabilityRow& row = rows.emplace_back();
            row.keys = group.keys;
            row.object = object;
            group_of_row.push_back(&group);
        }
    }
    parallel_for(static_cast<int>(rows.size()), [&](int i) {
        MapReliabilityRow& row = rows[static_cast<std::size_t>(i)];
        const FixationMaps& own = *maps[static_cast<std::size_t>(row.object)];
        std::vector<std::vector<double>> of_observers;
        for (const auto& [observer, trials] :
             by_observer(results, group_of_row[static_cast<std::size_t>(i)]->trials)) {
            const Fixations fixations = fixations_on(results, trials, row.object);
            if (fixations.empty())
                continue;
            row.fixations += static_cast<int>(fixations.size());
            of_observers.push_back(own.sum_of(fixations));
        }
        row.observers = static_cast<int>(of_observers.size());
        const MapAgreement agreement = map_agreement(of_observers, own.visible_areas(), options.confidence);
        row.split_half_cc = agreement.of_halves;
        row.reliability = agreement.reliability;
    });
    return rows;
}

} // namespace overt
