#include "experiment/protocol/keys/protocol_schema.h"

#include <nlohmann/json.hpp>

#include "experiment/protocol/keys/protocol_keys.h"
#include "experiment/scene/sculptures/sculptures.h"

namespace overt {

namespace {

using Json = nlohmann::ordered_json;

Json list_of(Json item) { return {{"type", "array"}, {"items", std::move(item)}, {"minItems", 1}}; }

Json section_schema(const Section& section) {
    Json schema{{"type", "object"}, {"additionalProperties", false}, {"properties", Json::object()}};
    Json required = Json::array();
    for (const Key& key : section.keys) {
        const KeyRule& rule = key.rule;
        Json value = key.type->schema(rule);
        if (const std::string written = key.default_text(); !written.empty())
            value["default"] = Json::parse(written);
        value["description"] =
            without_links(rule.explanation) +
            (rule.if_left_out.empty() ? "" : " Left out: " + std::string(rule.if_left_out) + ".");
        schema["properties"][std::string(rule.name)] = std::move(value);
        if (rule.is_required)
            required.push_back(rule.name);
    }
    for (const Section& table : section.tables) {
        Json inner = section_schema(table);
        if (table.home.is_by_name())
            inner = {{"type", "object"},
                     {"propertyNames", {{"pattern", "^[A-Za-z0-9_-]{1,40}$"}}},
                     {"additionalProperties", std::move(inner)}};
        if (table.home.is_list())
            inner = list_of(std::move(inner));
        Json& property = schema["properties"][std::string(table.name)];
        if (property.is_null()) {
            property = std::move(inner);
        } else {
            Json description = property["description"];
            property = {{"description", std::move(description)}, {"anyOf", {property, std::move(inner)}}};
        }
    }
    schema["description"] = without_links(section.explanation);
    if (!required.empty())
        schema["required"] = std::move(required);
    return schema;
}

/// What the reader asks for beyond a type and a range.
void narrow(Json& properties) {
    properties["answers"]["properties"]["bits"]["enum"] = {16, 24};
    Json shipped = Json::array();
    for (const SculptureDescription& object : shipped_sculptures())
        shipped.push_back(object.name);
    properties["object"]["items"]["properties"]["shipped"]["enum"] = std::move(shipped);
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
        const std::size_t end =
            middle == std::string_view::npos ? std::string_view::npos : text.find(')', middle);
        if (begin == std::string_view::npos || end == std::string_view::npos)
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
                             {"anyOf", {path, list_of(path)}}};
    for (const Section& section : protocol_keys()) {
        Json schema = section_schema(section);
        if (section.is_list()) {
            const std::string description = schema["description"];
            Json list = list_of(schema);
            schema = section.is_never_empty() ? Json{{"anyOf", {schema, std::move(list)}}} : std::move(list);
            schema["description"] = description;
        }
        if (section.is_never_empty())
            properties[std::string(section.alone)] = schema;
        properties[std::string(section.name)] = std::move(schema);
    }
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
