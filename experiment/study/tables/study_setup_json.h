/// How a study's sessions were set up and what holds of its trials, for study.json.
#pragma once

#include <nlohmann/json.hpp>

#include "experiment/study/results/study_results.h"

namespace overt {

/// Members for study.json: "setup", "trial_measures", "refreshes", "exclusions", "observer_form" and what
/// else the sentences on methods are made of (methods/study_facts.h). What is not known is left out.
nlohmann::ordered_json study_facts_json(const StudyResults& results);

} // namespace overt
