#include "experiment/keys/value_type.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/error.h"
#include "experiment/keys/value_read.h"
#include "experiment/keys/value_schema.h"

namespace overt {

namespace {

/// A point stands within, as in a number.
bool has_points_within(std::string_view text) {
    return text.front() != '.' && text.back() != '.' && text.find("..") == std::string_view::npos;
}

bool is_identifier_character(char character) {
    return (character >= 'a' && character <= 'z') || (character >= 'A' && character <= 'Z') ||
           (character >= '0' && character <= '9') || character == '-' || character == '_' || character == '.';
}

// As it is written in a file.

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
template <class Value>
constexpr ValueType plain(std::string_view noun, nlohmann::ordered_json (*schema)(const KeyRule&)) {
    return {noun, read_as<Value>, schema, written_as<Value>};
}

/// Of a type whose default is to be left out.
template <class Value>
constexpr ValueType optional(std::string_view noun, nlohmann::ordered_json (*schema)(const KeyRule&)) {
    return {noun, read_as<Value>, schema, nullptr};
}

constexpr std::string_view a_whole = "a whole number", a_number = "a number", a_text = "a text",
                           a_three = "a list of three numbers";

constexpr ValueType truth_type = plain<bool>("true or false", schema_of::truth),
                    whole_type = plain<int>(a_whole, schema_of::whole),
                    number_type = plain<double>(a_number, schema_of::number),
                    degrees_type = plain<Degrees>(a_number, schema_of::number),
                    text_type = plain<std::string>(a_text, schema_of::text),
                    path_type = optional<std::filesystem::path>(a_text, schema_of::path),
                    optional_number_type = optional<std::optional<double>>(a_number, schema_of::number),
                    optional_whole_type = optional<std::optional<int>>(a_whole, schema_of::whole),
                    seed_type = optional<std::optional<std::uint64_t>>(a_whole, schema_of::whole),
                    vector_type = optional<std::optional<glm::dvec3>>(a_three, schema_of::three),
                    three_type = plain<std::array<double, 3>>(a_three, schema_of::three),
                    numbers_type = optional<std::vector<double>>("a list of numbers", schema_of::numbers),
                    texts_type = optional<std::vector<std::string>>("a list of texts", schema_of::texts),
                    triples_type = optional<std::vector<std::array<double, 3>>>(
                        "three numbers [a, b, c], or a list of such", schema_of::triples),
                    spheres_type = optional<std::vector<std::array<double, 4>>>(
                        "a sphere [x, y, z, radius], or a list of spheres", schema_of::spheres),
                    planes_type = optional<std::vector<std::array<double, 6>>>(
                        "a plane [[x, y, z], [nx, ny, nz]], or a list of planes", schema_of::planes),
                    boxes_type = optional<Boxes>("a list of boxes [[x, y, z], [x, y, z]]", schema_of::planes),
                    named_shares_type =
                        optional<NamedShares>("a table of names with a number each", schema_of::named_shares),
                    named_numbers_type = optional<NamedNumbers>("a table of names with a whole number each",
                                                                schema_of::named_numbers),
                    named_words_type = optional<NamedWords>("a table of names with a word or a number each",
                                                            schema_of::named_words),
                    series_type = optional<Series>("a table of keys with a list each", schema_of::series);

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
const ValueType& value_type(TypeTag<std::vector<std::array<double, 3>>>) { return triples_type; }
const ValueType& value_type(TypeTag<std::vector<std::array<double, 4>>>) { return spheres_type; }
const ValueType& value_type(TypeTag<std::vector<std::array<double, 6>>>) { return planes_type; }
const ValueType& value_type(TypeTag<Boxes>) { return boxes_type; }
const ValueType& value_type(TypeTag<NamedShares>) { return named_shares_type; }
const ValueType& value_type(TypeTag<NamedNumbers>) { return named_numbers_type; }
const ValueType& value_type(TypeTag<NamedWords>) { return named_words_type; }
const ValueType& value_type(TypeTag<Series>) { return series_type; }

ValueResult check_name(const std::string& name, Place place, std::string_view what) {
    constexpr std::size_t longest = 40;
    if (!name.empty() && name.size() <= longest &&
        std::all_of(name.begin(), name.end(), is_identifier_character) && has_points_within(name))
        return std::nullopt;
    return ValueFault{
        place, fmt::format("{}: \"{}\" cannot be used in file names", what, name),
        fmt::format("take 1 to {} of the letters a to z and A to Z, digits, - and _, with points within",
                    longest)};
}

ValueResult read_choice(const TomlValue& value, const KeyRule& rule, std::size_t& index) {
    std::string name;
    if (ValueResult fault = read_value(value, rule, name))
        return fault;
    index = static_cast<std::size_t>(std::find(rule.choices.begin(), rule.choices.end(), name) -
                                     rule.choices.begin());
    return std::nullopt;
}

ValueType type_of_choices(ValueResult (*read)(const TomlValue&, const KeyRule&, void*),
                          std::string (*written)(const KeyRule&, const void*),
                          std::span<const std::string_view> names) {
    return {a_text, read, schema_of::text, written, names};
}

std::string written_choice(const KeyRule& rule, std::size_t index) {
    OVERT_EXPECTS(index < rule.choices.size());
    return written(std::string(rule.choices[index]));
}

} // namespace overt
