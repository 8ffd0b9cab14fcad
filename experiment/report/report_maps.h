/// Objects and the maps on them as the page's JSON.
#pragma once

#include "experiment/report/report_json.h"

namespace overt {

/// Arrays, each entry with its values at the vertices of the mesh that is shown.
struct ReportMaps {
    Json objects, maps, differences, answer_maps;
};

/// Meshes are made coarser where all maps together would take more than 10 MB, and beyond
/// most_report_vertices.
ReportMaps report_maps(const StudyResults& results);

} // namespace overt
