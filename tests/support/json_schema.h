/// As much of JSON Schema (draft 2020-12) as the protocol's schema uses; an unknown word is an error.
#pragma once

#include <regex>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace overt::test {

using SchemaJson = nlohmann::ordered_json;

inline bool is_of_type(const SchemaJson& value, const std::string& type) {
    return type == "object"    ? value.is_object()
           : type == "array"   ? value.is_array()
           : type == "string"  ? value.is_string()
           : type == "boolean" ? value.is_boolean()
           : type == "number"  ? value.is_number()
                               : type == "integer" && value.is_number_integer();
}

/// What does not fit, as "PATH: why".
inline std::vector<std::string> schema_faults(const SchemaJson& value, const SchemaJson& schema,
                                              const std::string& path = "") {
    std::vector<std::string> faults;
    const auto fault = [&](const std::string& why) { faults.push_back(path + ": " + why); };
    const auto add = [&](const std::vector<std::string>& more) {
        faults.insert(faults.end(), more.begin(), more.end());
    };
    for (const auto& [word, rule] : schema.items()) {
        if (word == "$schema" || word == "title" || word == "description" || word == "default")
            continue;
        if (word == "type") {
            if (!is_of_type(value, rule))
                fault("is no " + rule.get<std::string>());
        } else if (word == "enum") {
            if (std::find(rule.begin(), rule.end(), value) == rule.end())
                fault("is none of the values");
        } else if (word == "minimum" || word == "maximum") {
            if (value.is_number() && (word == "minimum" ? value < rule : value > rule))
                fault("is beyond the " + word);
        } else if (word == "pattern") {
            if (value.is_string() &&
                !std::regex_search(value.get<std::string>(), std::regex(rule.get<std::string>())))
                fault("does not fit the pattern");
        } else if (word == "minLength") {
            if (value.is_string() && value.get<std::string>().size() < rule.get<std::size_t>())
                fault("is too short");
        } else if (word == "minItems" || word == "maxItems") {
            const bool is_least = word == "minItems";
            if (value.is_array() &&
                (is_least ? value.size() < rule.get<std::size_t>() : value.size() > rule.get<std::size_t>()))
                fault("has the wrong number of items");
        } else if (word == "items") {
            for (std::size_t i = 0; value.is_array() && i < value.size(); ++i)
                add(schema_faults(value[i], rule, path + "[" + std::to_string(i) + "]"));
        } else if (word == "anyOf") {
            const bool fits = std::any_of(rule.begin(), rule.end(), [&](const SchemaJson& option) {
                return schema_faults(value, option, path).empty();
            });
            if (!fits)
                fault("fits none of the forms");
        } else if (word == "required") {
            for (const auto& key : rule)
                if (value.is_object() && !value.contains(key.get<std::string>()))
                    fault("lacks " + key.get<std::string>());
        } else if (word == "properties") {
            for (const auto& [key, inner] : rule.items())
                if (value.is_object() && value.contains(key))
                    add(schema_faults(value[key], inner, path + "." + key));
        } else if (word == "additionalProperties") {
            for (const auto& item : value.items())
                if (value.is_object() && !schema.at("properties").contains(item.key()))
                    fault("has the unknown key " + item.key());
        } else {
            fault("the schema has the unknown word " + word);
        }
    }
    return faults;
}

} // namespace overt::test
