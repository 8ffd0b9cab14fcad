#include "experiment/keys/value_type.h"

#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "experiment/base/error.h"

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

Json list_of(Json item, int least, int most) {
    Json schema{{"type", "array"}, {"items", std::move(item)}, {"minItems", least}};
    if (most > 0)
        schema["maxItems"] = most;
    return schema;
}

Json truth(const KeyRule&) { return {{"type", "boolean"}}; }
Json whole(const KeyRule& rule) { return ranged("integer", rule); }
Json number(const KeyRule& rule) { return ranged("number", rule); }
Json path(const KeyRule&) { return {{"type", "string"}, {"minLength", 1}}; }
Json three(const KeyRule& rule) { return list_of(number(rule), 3, 3); }
Json spheres(const KeyRule& rule) { return list_of(list_of(number(rule), 4, 4), 0, 0); }
Json planes(const KeyRule& rule) { return list_of(list_of(three(rule), 2, 2), 0, 0); }
Json numbers(const KeyRule& rule) { return {{"anyOf", {number(rule), list_of(number(rule), 0, 0)}}}; }

Json text(const KeyRule& rule) {
    Json schema{{"type", "string"}};
    if (!rule.choices.empty())
        schema["enum"] = rule.choices;
    else if (rule.is_identifier)
        schema["pattern"] = "^[A-Za-z0-9_-]{1,40}$";
    else if (rule.is_required)
        schema["pattern"] = "[^ \\t\\r\\n]";
    return schema;
}

Json texts(const KeyRule& rule) { return {{"anyOf", {text(rule), list_of(text(rule), 1, 0)}}}; }

std::string written(bool value) { return value ? "true" : "false"; }
std::string written(int value) { return fmt::format("{}", value); }
std::string written(double value) { return fmt::format("{}", value); }
std::string written(Degrees value) { return written(value.value); }
std::string written(const std::array<double, 3>& value) {
    return fmt::format("[{}]", fmt::join(value, ", "));
}

std::string written(const std::string& value) {
    std::string quoted;
    for (const char character : value) {
        if (character == '"' || character == '\\')
            quoted += '\\';
        quoted += character == '\n' ? std::string("\\n") : std::string(1, character);
    }
    return fmt::format("\"{}\"", quoted);
}

template <class Value> std::string written_as(const KeyRule&, const void* value) {
    return written(*static_cast<const Value*>(value));
}

template <class Value> ValueResult read_as(const TomlValue& value, const KeyRule& rule, void* out) {
    return read_value(value, rule, *static_cast<Value*>(out));
}

/// Of a type that has defaults.
template <class Value> constexpr ValueType plain(std::string_view noun, Json (*schema)(const KeyRule&)) {
    return {noun, read_as<Value>, schema, written_as<Value>};
}

/// Of a type whose default is to be left out.
template <class Value> constexpr ValueType optional(std::string_view noun, Json (*schema)(const KeyRule&)) {
    return {noun, read_as<Value>, schema, nullptr};
}

constexpr std::string_view a_whole = "a whole number", a_number = "a number", a_text = "a text",
                           a_three = "a list of three numbers";

constexpr ValueType truth_type = plain<bool>("true or false", truth), whole_type = plain<int>(a_whole, whole),
                    number_type = plain<double>(a_number, number),
                    degrees_type = plain<Degrees>(a_number, number),
                    text_type = plain<std::string>(a_text, text),
                    path_type = optional<std::filesystem::path>(a_text, path),
                    optional_number_type = optional<std::optional<double>>(a_number, number),
                    optional_whole_type = optional<std::optional<int>>(a_whole, whole),
                    seed_type = optional<std::optional<std::uint64_t>>(a_whole, whole),
                    vector_type = optional<std::optional<glm::dvec3>>(a_three, three),
                    three_type = plain<std::array<double, 3>>(a_three, three),
                    numbers_type = optional<std::vector<double>>("a list of numbers", numbers),
                    texts_type = optional<std::vector<std::string>>("a list of texts", texts),
                    spheres_type = optional<std::vector<std::array<double, 4>>>(
                        "a list of spheres [x, y, z, radius]", spheres),
                    planes_type = optional<std::vector<std::array<double, 6>>>(
                        "a list of planes [[x, y, z], [nx, ny, nz]]", planes);

} // namespace

const ValueType& value_type(TypeTag<bool>) { return truth_type; }
const ValueType& value_type(TypeTag<int>) { return whole_type; }
const ValueType& value_type(TypeTag<double>) { return number_type; }
const ValueType& value_type(TypeTag<Degrees>) { return degrees_type; }
const ValueType& value_type(TypeTag<std::string>) { return text_type; }
const ValueType& value_type(TypeTag<std::filesystem::path>) { return path_type; }
const ValueType& value_type(TypeTag<std::optional<double>>) { return optional_number_type; }
const ValueType& value_type(TypeTag<std::optional<int>>) { return optional_whole_type; }
const ValueType& value_type(TypeTag<std::optional<std::uint64_t>>) { return seed_type; }
const ValueType& value_type(TypeTag<std::optional<glm::dvec3>>) { return vector_type; }
const ValueType& value_type(TypeTag<std::array<double, 3>>) { return three_type; }
const ValueType& value_type(TypeTag<std::vector<double>>) { return numbers_type; }
const ValueType& value_type(TypeTag<std::vector<std::string>>) { return texts_type; }
const ValueType& value_type(TypeTag<std::vector<std::array<double, 4>>>) { return spheres_type; }
const ValueType& value_type(TypeTag<std::vector<std::array<double, 6>>>) { return planes_type; }

ValueType type_of_choices(ValueResult (*read)(const TomlValue&, const KeyRule&, void*),
                          std::string (*written)(const KeyRule&, const void*),
                          std::span<const std::string_view> names) {
    return {a_text, read, text, written, names};
}

std::string written_choice(const KeyRule& rule, std::size_t index) {
    OVERT_EXPECTS(index < rule.choices.size());
    return written(std::string(rule.choices[index]));
}

} // namespace overt
