#include "experiment/protocol/protocol_schema.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "experiment/protocol/protocol_keys.h"
#include "experiment/scene/sculptures/sculptures.h"

namespace overt {

namespace {

using Json = nlohmann::ordered_json;

/// A bound without a point where it has none, as whole numbers have to be written.
Json bound(double value) {
    if (value == std::floor(value) && std::abs(value) < 1e15)
        return static_cast<std::int64_t>(value);
    return value;
}

Json ranged(const char* type, const KeyRule& rule) {
    Json schema{{"type", type}};
    if (std::isfinite(rule.low))
        schema["minimum"] = bound(rule.low);
    if (std::isfinite(rule.high))
        schema["maximum"] = bound(rule.high);
    return schema;
}

Json texts(const KeyRule& rule) {
    Json schema{{"type", "string"}};
    if (!rule.choices.empty())
        schema["enum"] = rule.choices;
    else if (rule.is_identifier)
        schema["pattern"] = "^[A-Za-z0-9_-]{1,40}$";
    else if (rule.is_required)
        schema["pattern"] = "[^ \\t\\r\\n]";
    return schema;
}

Json list_of(Json item, int least, int most) {
    Json schema{{"type", "array"}, {"items", std::move(item)}, {"minItems", least}};
    if (most > 0)
        schema["maxItems"] = most;
    return schema;
}

template <class Value> Json value_schema(const KeyRule& rule) {
    using std::is_same_v;
    if constexpr (is_same_v<Value, bool>) {
        return {{"type", "boolean"}};
    } else if constexpr (is_same_v<Value, int> || is_same_v<Value, std::optional<int>> ||
                         is_same_v<Value, std::optional<std::uint64_t>>) {
        return ranged("integer", rule);
    } else if constexpr (is_same_v<Value, double> || is_same_v<Value, Degrees> ||
                         is_same_v<Value, std::optional<double>>) {
        return ranged("number", rule);
    } else if constexpr (is_same_v<Value, std::optional<glm::dvec3>> ||
                         is_same_v<Value, std::array<double, 3>>) {
        return list_of(ranged("number", rule), 3, 3);
    } else if constexpr (is_same_v<Value, std::vector<std::array<double, 4>>>) {
        return list_of(list_of(ranged("number", rule), 4, 4), 0, 0);
    } else if constexpr (is_same_v<Value, std::vector<std::array<double, 6>>>) {
        return list_of(list_of(list_of(ranged("number", rule), 3, 3), 2, 2), 0, 0);
    } else if constexpr (is_same_v<Value, std::vector<double>>) {
        return {{"anyOf", {ranged("number", rule), list_of(ranged("number", rule), 0, 0)}}};
    } else if constexpr (is_same_v<Value, std::vector<std::string>>) {
        return {{"anyOf", {texts(rule), list_of(texts(rule), 1, 0)}}};
    } else if constexpr (is_same_v<Value, std::filesystem::path>) {
        return {{"type", "string"}, {"minLength", 1}};
    } else {
        return texts(rule);
    }
}

/// A key's default, or null where it has none of its own.
template <class Value> Json default_json(const KeyRule& rule, const Value& value) {
    using std::is_same_v;
    if constexpr (is_same_v<Value, bool> || is_same_v<Value, int> || is_same_v<Value, std::string>)
        return value;
    else if constexpr (is_same_v<Value, double>)
        return bound(value);
    else if constexpr (is_same_v<Value, Degrees>)
        return bound(value.value);
    else if constexpr (is_same_v<Value, std::array<double, 3>>)
        return Json{bound(value[0]), bound(value[1]), bound(value[2])};
    else if constexpr (std::is_enum_v<Value>)
        return rule.choices[static_cast<std::size_t>(value)];
    else
        return nullptr;
}

template <class Struct> Json section_schema(const Section<Struct>& section) {
    Json schema{{"type", "object"}, {"additionalProperties", false}, {"properties", Json::object()}};
    Json required = Json::array();
    static const Struct defaults{};
    for (const Key<Struct>& key : section.keys) {
        const KeyRule& rule = key.rule;
        Json value = std::visit(
            [&]<class Value>(Value Struct::*member) {
                Json of_value = value_schema<Value>(rule);
                if (rule.is_required || !rule.if_left_out.empty())
                    return of_value;
                if (Json standard = default_json(rule, defaults.*member); !standard.is_null())
                    of_value["default"] = std::move(standard);
                return of_value;
            },
            key.member);
        value["description"] =
            without_links(rule.explanation) +
            (rule.if_left_out.empty() ? "" : " Left out: " + std::string(rule.if_left_out) + ".");
        schema["properties"][std::string(rule.name)] = std::move(value);
        if (rule.is_required)
            required.push_back(rule.name);
    }
    for (const Section<Struct>& table : section.tables)
        schema["properties"][std::string(table.name)] = section_schema(table);
    schema["description"] = without_links(section.explanation);
    if (!required.empty())
        schema["required"] = std::move(required);
    return schema;
}

/// What the reader asks for beyond a type and a range.
void narrow(Json& properties) {
    properties["answers"]["properties"]["bits"]["enum"] = {16, 24};
    Json shipped = Json::array();
    for (const SculptureDescription& sculpture : shipped_sculptures())
        shipped.push_back(sculpture.name);
    properties["sculpture"]["items"]["properties"]["shipped"]["enum"] = std::move(shipped);
    properties["frames"]["items"]["properties"]["files"]["pattern"] = "^[^#]*#+[^#]*$";
}

/// What may stand in an included file is asked for only where there is none.
Json required_without_includes(Json& properties) {
    Json name{{"properties", {{"protocol", {{"required", properties["protocol"]["required"]}}}}}};
    properties["protocol"].erase("required");
    return {Json{{"required", {"include"}}}, std::move(name)};
}

} // namespace

std::string without_links(std::string_view text) {
    std::string plain;
    while (true) {
        const std::size_t middle = text.find("]("), begin = text.substr(0, middle).rfind('[');
        const std::size_t end = middle == text.npos ? text.npos : text.find(')', middle);
        if (begin == text.npos || end == text.npos)
            return plain + std::string(text);
        plain += std::string(text.substr(0, begin)) + "docs/" +
                 std::string(text.substr(middle + 2, end - middle - 2));
        text.remove_prefix(end + 1);
    }
}

Json protocol_schema() {
    Json properties = Json::object();
    const Json path{{"type", "string"}, {"minLength", 1}};
    properties["include"] = {{"description", "Files that the protocol is completed by, from its folder."},
                             {"anyOf", {path, list_of(path, 1, 0)}}};
    for_each_section([&]<class Struct>(const Section<Struct>& section) {
        Json schema = section_schema(section);
        if (section.many) {
            const std::string description = schema["description"];
            schema = list_of(std::move(schema), 1, 0);
            schema["description"] = description;
        }
        properties[std::string(section.name)] = std::move(schema);
    });
    narrow(properties);
    Json required = required_without_includes(properties);
    return {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
            {"title", "overt protocol"},
            {"description", "An eye-tracking experiment on animated 3D objects."},
            {"type", "object"},
            {"anyOf", std::move(required)},
            {"additionalProperties", false},
            {"properties", std::move(properties)}};
}

} // namespace overt
