/// What was answered, as study.json has it.
#pragma once

#include <nlohmann/json.hpp>

#include "experiment/study/results/study_results.h"

namespace overt {

/// The headline, and of answers their number and the results over all observers: every number that sentences
/// on them name. Null without answers.
nlohmann::ordered_json answers_json(const StudyResults& results);
nlohmann::ordered_json headline_json(const StudyHeadline& headline);

} // namespace overt
