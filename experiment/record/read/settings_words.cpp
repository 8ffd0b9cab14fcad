#include "experiment/record/read/settings_words.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace overt {

namespace {

/// Longer endings first: "_deg_s" is none of "_s".
constexpr std::array<std::pair<std::string_view, std::string_view>, 9> units_of_names{{{"_deg_s2", " deg/s2"},
                                                                                       {"_deg_s", " deg/s"},
                                                                                       {"_px_s", " px/s"},
                                                                                       {"_deg", " deg"},
                                                                                       {"_ms", " ms"},
                                                                                       {"_hz", " Hz"},
                                                                                       {"_mm", " mm"},
                                                                                       {"_px", " px"},
                                                                                       {"_s", " s"}}};

std::string setting_in_words(std::string name, const nlohmann::ordered_json& value) {
    std::string_view unit;
    for (const auto& [ending, words] : units_of_names) {
        if (name.ends_with(ending) && value.is_number()) {
            name.resize(name.size() - ending.size());
            unit = words;
            break;
        }
    }
    std::ranges::replace(name, '_', ' ');
    return fmt::format("{} {}{}", name,
                       value.is_string()    ? value.get<std::string>()
                       : value.is_number()  ? fmt::format("{:.6g}", value.get<double>())
                       : value.is_boolean() ? (value.get<bool>() ? "yes" : "no")
                                            : value.dump(),
                       unit);
}

} // namespace

std::string settings_in_words(const std::string& json) {
    const nlohmann::ordered_json settings = nlohmann::ordered_json::parse(json, nullptr, false);
    if (!settings.is_object())
        return json;
    std::string words;
    for (const auto& [name, value] : settings.items())
        words += fmt::format("{}{}", words.empty() ? "" : ", ", setting_in_words(name, value));
    return words;
}

} // namespace overt
