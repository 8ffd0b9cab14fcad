#include "experiment/ports/given_answer.h"

#include <algorithm>

#include <fmt/format.h>

namespace overt {

std::vector<std::pair<std::string, std::string>> answer_variables(const std::vector<GivenAnswer>& answers) {
    std::vector<std::pair<std::string, std::string>> variables;
    for (const GivenAnswer& given : answers) {
        std::string name = given.item.empty() ? given.id : fmt::format("{}_{}", given.id, given.item);
        std::ranges::replace(name, ' ', '_');
        variables.emplace_back(name, given.is_missed ? "n/a" : given.value);
        if (const std::optional<SessionDuration> time = given.response_time())
            variables.emplace_back(name + "_time_ms", fmt::format("{:.3f}", 1e3 * to_seconds(*time)));
        if (given.gauge && !given.is_missed) {
            variables.emplace_back(name + "_slant_deg", fmt::format("{:.3f}", given.gauge->set.slant.value));
            variables.emplace_back(name + "_tilt_deg", fmt::format("{:.3f}", given.gauge->set.tilt.value));
            if (const std::optional<Degrees> deviation = given.gauge->deviation())
                variables.emplace_back(name + "_deviation_deg", fmt::format("{:.3f}", deviation->value));
        }
        for (const MatchSetting& set : given.settings) {
            std::string along = name + "_" + set.along;
            std::ranges::replace(along, ' ', '_');
            variables.emplace_back(along + "_start", fmt::format("{:.10g}", set.start));
            variables.emplace_back(along, given.is_missed ? "n/a" : fmt::format("{:.10g}", set.final));
            if (set.reference)
                variables.emplace_back(along + "_reference", fmt::format("{:.10g}", *set.reference));
        }
        if (given.is_correct)
            variables.emplace_back(name + "_correct", *given.is_correct ? "1" : "0");
    }
    return variables;
}

} // namespace overt
