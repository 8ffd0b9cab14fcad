#include "experiment/report/report_areas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace overt {

namespace {

Json json_of_area(const ScreenArea& area) {
    constexpr std::array shapes{"rectangle", "ellipse", "polygon"};
    Json points = Json::array();
    for (const ScreenPoint& point : area.points)
        points.push_back({number(point.x_px, 6), number(point.y_px, 6)});
    return {{"name", area.name},
            {"shape", shapes[static_cast<std::size_t>(area.shape)]},
            {"points", std::move(points)},
            {"from", number(area.from_s, 7)},
            {"until", number(area.until_s, 7)}};
}

} // namespace

void add_area_tables(Json& tables, const StudyResults& results) {
    Json areas = Json::array(), ways = Json::array();
    for (const ScreenAreaRow& row : results.screen_area_groups)
        areas.push_back({{"keys", json_of(row.keys)},
                         {"area", row.area},
                         {"chance", number(row.share_by_chance)},
                         {"share", json_of(row.dwell_share)},
                         {"visits", json_of(row.visits)},
                         {"reached", json_of(row.reached)},
                         {"arrival", json_of(row.first_arrival_s)},
                         {"observers", row.observers},
                         {"trials", row.trials},
                         {"fixations", row.fixations}});
    std::map<std::pair<std::string, std::string>, std::pair<int, int>> counts;
    for (const AreaTransitionRow& row : results.area_transitions) {
        auto& [times, trials] = counts[{row.from, row.to}];
        times += row.count;
        ++trials;
    }
    for (const auto& [way, count] : counts)
        ways.push_back(
            {{"from", way.first}, {"to", way.second}, {"count", count.first}, {"trials", count.second}});
    tables["areas"] = std::move(areas);
    tables["transitions"] = std::move(ways);
}

Json report_area_sets(const StudyResults& results, Json& trials) {
    std::vector<const std::vector<ScreenArea>*> sets;
    for (std::size_t trial = 0; trial < results.screen_areas.size(); ++trial) {
        const std::vector<ScreenArea>& own = results.screen_areas[trial];
        if (own.empty())
            continue;
        const auto found = std::ranges::find_if(sets, [&](const auto* set) { return *set == own; });
        trials[trial]["areas"] = found - sets.begin();
        if (found == sets.end())
            sets.push_back(&own);
    }
    Json json = Json::array();
    for (const std::vector<ScreenArea>* set : sets) {
        json.push_back(Json::array());
        for (const ScreenArea& area : *set)
            json.back().push_back(json_of_area(area));
    }
    return json;
}

} // namespace overt
