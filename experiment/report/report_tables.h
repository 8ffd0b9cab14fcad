/// The tables of a study as the page's JSON.
#pragma once

#include "experiment/report/report_json.h"

namespace overt {

/// An array of rows for each table, by its short name.
Json report_tables(const StudyResults& results);

} // namespace overt
