/// Values of a study as the page's JSON.
#pragma once

#include <optional>
#include <vector>

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

#include "experiment/study/results/study_results.h"

namespace overt {

using Json = nlohmann::ordered_json;

/// To so many significant digits as a reader may want; null if it is not finite, which JSON has no number
/// for.
Json number(double value, int digits = 6);
Json number(const std::optional<double>& value, int digits = 6);

/// "v", with its interval "lo" and "hi" where there is one, and "absent", why there is no value.
Json json_of(const Estimate& estimate);
/// An array of pairs of a column and its level.
Json json_of(const std::vector<StudyKey>& keys);
/// Its value, those of two observers of the "other" and the "same" level and their "effect", the "null" and
/// p.
Json json_of(const SimilarityEstimate& similarity);
/// The "effect" size, Bayes' factor "bf" and the p of equivalence, "eq".
Json json_of(const PairedEvidence& evidence);
/// An array of three.
Json json_of(const glm::dvec3& v);

} // namespace overt
