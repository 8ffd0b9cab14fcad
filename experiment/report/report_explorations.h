/// How objects were turned, as the page has it.
#pragma once

#include "experiment/report/report_json.h"

namespace overt {

/// A row for each level by observer (`of`; empty: all). Empty where nobody turned anything.
Json report_explorations(const StudyExplorations& explorations);

} // namespace overt
