#include "experiment/report/report_json.h"

#include <cmath>

namespace overt {

Json number(double value, int digits) {
    if (!std::isfinite(value))
        return nullptr;
    if (value == 0.0)
        return 0;
    const double scale = std::pow(10.0, digits - 1 - std::floor(std::log10(std::abs(value))));
    const double rounded = std::round(value * scale) / scale;
    return std::isfinite(rounded) ? Json(rounded) : Json(value);
}
Json number(const std::optional<double>& value, int digits) {
    return value ? number(*value, digits) : Json(nullptr);
}

Json json_of(const Estimate& estimate) {
    Json json{{"v", number(estimate.value)}};
    if (estimate.interval) {
        json["lo"] = number(estimate.interval->low);
        json["hi"] = number(estimate.interval->high);
    }
    if (!estimate.absent.empty())
        json["absent"] = estimate.absent;
    return json;
}

Json json_of(const std::vector<StudyKey>& keys) {
    Json json = Json::array();
    for (const StudyKey& key : keys)
        json.push_back({key.column, key.value});
    return json;
}

Json json_of(const SimilarityEstimate& similarity) {
    return {{"value", json_of(similarity.value)},     {"other", json_of(similarity.other_level)},
            {"same", json_of(similarity.same_level)}, {"effect", json_of(similarity.level_effect)},
            {"null", json_of(similarity.null)},       {"p", number(similarity.p)}};
}

Json json_of(const PairedEvidence& evidence) {
    return {{"effect", json_of(evidence.effect_size)},
            {"bf", number(evidence.bayes_factor, 3)},
            {"eq", number(evidence.equivalence_p)}};
}

Json json_of(const glm::dvec3& v) { return {number(v.x, 8), number(v.y, 8), number(v.z, 8)}; }

} // namespace overt
