/// Places that were pointed at, as the page has them.
#pragma once

#include "experiment/report/report_json.h"

namespace overt {

/// Spreads, shares on areas and distances of answers, and of each object a picture: places of its surface
/// that can be seen and the places that were answered, as they lie in the image from the front. Null without
/// such answers.
Json report_points(const StudyResults& results);

} // namespace overt
