/// Areas of the screen, as the page has them.
#pragma once

#include "experiment/report/report_json.h"

namespace overt {

/// Over groups, and the ways from one to another over all trials: adds "areas" and "transitions".
void add_area_tables(Json& tables, const StudyResults& results);

/// The different sets of areas that trials have; each of `trials`, in the order of the results, gets the
/// index of its own as "areas", if it has any.
Json report_area_sets(const StudyResults& results, Json& trials);

} // namespace overt
