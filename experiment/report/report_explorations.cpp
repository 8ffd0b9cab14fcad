#include "experiment/report/report_explorations.h"

namespace overt {

Json report_explorations(const StudyExplorations& explorations) {
    Json rows = Json::array();
    for (const ExplorationSummaryRow& row : explorations.summaries)
        rows.push_back({{"of", row.observer},
                        {"column", row.column},
                        {"level", row.level},
                        {"shows", row.shows},
                        {"observers", row.observers},
                        {"path_deg", json_of(row.path_deg)},
                        {"turned_share", json_of(row.turned_share)},
                        {"speed_deg_s", json_of(row.speed_deg_s)},
                        {"reversals", json_of(row.reversals)},
                        {"poses", json_of(row.poses)}});
    return rows;
}

} // namespace overt
