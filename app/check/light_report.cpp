#include "app/check/light_report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "render/bake/light_sources.h"

namespace overt {

std::vector<LightFacts> measure_lights(const Protocol& protocol) {
    std::vector<LightFacts> lights;
    for (const LightSettings& light : protocol.lights)
        lights.push_back({light.id, probe_facts(distant_probe(light))});
    return lights;
}

std::string to_text(const std::vector<LightFacts>& lights) {
    std::string text = "\nLight\n";
    for (const LightFacts& light : lights)
        text += fmt::format("  {}: {}.\n", light.id,
                            light.surroundings ? describe(*light.surroundings) : std::string("none"));
    return text;
}

nlohmann::ordered_json to_json(const std::vector<LightFacts>& lights) {
    auto list = nlohmann::ordered_json::array();
    for (const LightFacts& light : lights) {
        nlohmann::ordered_json one{{"light", light.id}};
        if (const auto& facts = light.surroundings)
            one.update(nlohmann::ordered_json{{"brightest_by_mean", facts->brightest},
                                              {"unevenness", facts->unevenness},
                                              {"share_of_brightest_hundredth", facts->top_share},
                                              {"log_sd", facts->sd},
                                              {"log_skew", facts->skew},
                                              {"log_kurtosis", facts->kurtosis}});
        list.push_back(std::move(one));
    }
    return list;
}

} // namespace overt
