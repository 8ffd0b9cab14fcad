#include "experiment/base/json_text.h"

#include <nlohmann/json.hpp>

namespace overt {

using Json = nlohmann::ordered_json;

std::string json_text(const Json& json) {
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::string json_quoted(std::string_view text) {
    return Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json parse_json(std::string_view text) { return Json::parse(text, nullptr, false); }

} // namespace overt
