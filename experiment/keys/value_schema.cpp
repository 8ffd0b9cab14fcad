#include "experiment/keys/value_schema.h"

#include <cmath>

namespace overt::schema_of {

namespace {

constexpr const char* identifier_pattern = "^(?=.{1,40}$)[A-Za-z0-9_-]+(\\.[A-Za-z0-9_-]+)*$";

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

Json list_of(Json item, int least, int most) {
    Json schema{{"type", "array"}, {"items", std::move(item)}, {"minItems", least}};
    if (most > 0)
        schema["maxItems"] = most;
    return schema;
}

} // namespace

Json truth(const KeyRule&) { return {{"type", "boolean"}}; }
Json whole(const KeyRule& rule) { return ranged("integer", rule); }
Json number(const KeyRule& rule) { return ranged("number", rule); }
Json path(const KeyRule&) { return {{"type", "string"}, {"minLength", 1}}; }
Json three(const KeyRule& rule) { return list_of(number(rule), 3, 3); }
Json triples(const KeyRule& rule) { return list_of(list_of(number(rule), 3, 3), 0, 0); }
Json spheres(const KeyRule& rule) { return list_of(list_of(number(rule), 4, 4), 0, 0); }
Json planes(const KeyRule& rule) { return list_of(list_of(three(rule), 2, 2), 0, 0); }
Json named_numbers(const KeyRule& rule) {
    return {{"type", "object"}, {"additionalProperties", whole(rule)}};
}
Json named_shares(const KeyRule& rule) {
    return {{"type", "object"},
            {"propertyNames", {{"pattern", identifier_pattern}}},
            {"additionalProperties", number(rule)}};
}
Json named_words(const KeyRule& rule) {
    return {{"type", "object"},
            {"additionalProperties", {{"anyOf", {Json{{"type", "string"}}, number(rule)}}}}};
}
Json series(const KeyRule&) {
    return {{"type", "object"}, {"additionalProperties", {{"type", "array"}, {"minItems", 1}}}};
}
Json numbers(const KeyRule& rule) { return {{"anyOf", {number(rule), list_of(number(rule), 0, 0)}}}; }

Json text(const KeyRule& rule) {
    Json schema{{"type", "string"}};
    if (!rule.choices.empty())
        schema["enum"] = rule.choices;
    else if (rule.is_identifier)
        schema["pattern"] = identifier_pattern;
    else if (rule.is_required)
        schema["pattern"] = "[^ \\t\\r\\n]";
    return schema;
}

Json texts(const KeyRule& rule) { return {{"anyOf", {text(rule), list_of(text(rule), 1, 0)}}}; }

} // namespace overt::schema_of
