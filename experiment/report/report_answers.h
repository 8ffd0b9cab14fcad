/// What was answered, as the page has it.
#pragma once

#include "experiment/report/report_json.h"

namespace overt {

/// Results of answers by observer and over all, functions with the answers they were fitted to, tracks,
/// response times, and how gaze goes with answers. Null without answers.
Json report_answers(const StudyResults& results);

} // namespace overt
