#include "experiment/keys/value_type.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "experiment/base/error.h"
#include "experiment/keys/toml_order.h"

namespace overt {

namespace {

// What is read.

template <class Value> ValueFault wrong_kind(const TomlValue& value, const KeyRule& rule) {
    const std::string_view noun = value_type(TypeTag<Value>()).noun;
    return {value.place,
            fmt::format("{}: expected {}, found {}", rule.name, expected_text(rule, noun), value.kind())};
}

ValueResult check_range(const TomlValue& value, const KeyRule& rule, double number) {
    if (std::isfinite(number) && number >= rule.low && number <= rule.high)
        return std::nullopt;
    if (!std::isfinite(number))
        return ValueFault{value.place, fmt::format("{}: {} is no usable number", rule.name, number)};
    return ValueFault{
        value.place, fmt::format("{}: {} is out of range, which is {}", rule.name, number, range_text(rule))};
}

ValueResult read_whole(const TomlValue& value, const KeyRule& rule, std::int64_t& out) {
    const auto* whole = std::get_if<std::int64_t>(&value.content);
    if (!whole) {
        ValueFault fault = wrong_kind<int>(value, rule);
        if (const auto* number = std::get_if<double>(&value.content);
            number && std::abs(*number) < 1e9 && *number == std::floor(*number))
            fault.hint = fmt::format("write {:.0f}, without the point", *number);
        return fault;
    }
    if (ValueResult fault = check_range(value, rule, static_cast<double>(*whole)))
        return fault;
    out = *whole;
    return std::nullopt;
}

ValueResult read_value(const TomlValue& value, const KeyRule& rule, bool& out) {
    const auto* truth = std::get_if<bool>(&value.content);
    if (!truth)
        return wrong_kind<bool>(value, rule);
    out = *truth;
    return std::nullopt;
}

ValueResult read_value(const TomlValue& value, const KeyRule& rule, int& out) {
    std::int64_t whole = 0;
    if (ValueResult fault = read_whole(value, rule, whole))
        return fault;
    if (whole > std::numeric_limits<int>::max() || whole < std::numeric_limits<int>::min())
        return ValueFault{value.place, fmt::format("{}: {} is too large", rule.name, whole)};
    out = static_cast<int>(whole);
    return std::nullopt;
}

ValueResult read_value(const TomlValue& value, const KeyRule& rule, double& out) {
    double number = 0.0;
    if (const auto* whole = std::get_if<std::int64_t>(&value.content))
        number = static_cast<double>(*whole);
    else if (const auto* real = std::get_if<double>(&value.content))
        number = *real;
    else
        return wrong_kind<double>(value, rule);
    if (ValueResult fault = check_range(value, rule, number))
        return fault;
    out = number;
    return std::nullopt;
}

ValueResult read_value(const TomlValue& value, const KeyRule& rule, Degrees& out) {
    return read_value(value, rule, out.value);
}

/// A point stands within, as in a number.
bool has_points_within(std::string_view text) {
    return text.front() != '.' && text.back() != '.' && text.find("..") == std::string_view::npos;
}

bool is_identifier_character(char character) {
    return (character >= 'a' && character <= 'z') || (character >= 'A' && character <= 'Z') ||
           (character >= '0' && character <= '9') || character == '-' || character == '_' || character == '.';
}

ValueResult read_value(const TomlValue& value, const KeyRule& rule, std::string& out) {
    const auto* text = std::get_if<std::string>(&value.content);
    if (!text)
        return wrong_kind<std::string>(value, rule);
    if (!rule.choices.empty() &&
        std::find(rule.choices.begin(), rule.choices.end(), *text) == rule.choices.end()) {
        return ValueFault{value.place, fmt::format("{}: unknown value \"{}\"", rule.name, *text),
                          suggest_name(*text, rule.choices)};
    }
    if (rule.is_identifier) {
        if (ValueResult fault = check_name(*text, value.place, rule.name))
            return fault;
    }
    if (rule.is_required && text->find_first_not_of(" \t\r\n") == std::string::npos)
        return ValueFault{value.place, fmt::format("{}: the text is empty", rule.name)};
    out = *text;
    return std::nullopt;
}

ValueResult read_value(const TomlValue& value, const KeyRule& rule, std::filesystem::path& out) {
    std::string text;
    if (ValueResult fault = read_value(value, rule, text))
        return fault;
    if (text.empty())
        return ValueFault{value.place, fmt::format("{}: the path is empty", rule.name)};
    out = text;
    return std::nullopt;
}

ValueResult read_value(const TomlValue& value, const KeyRule& rule, std::optional<double>& out) {
    return read_value(value, rule, out.emplace());
}

ValueResult read_value(const TomlValue& value, const KeyRule& rule, std::optional<int>& out) {
    return read_value(value, rule, out.emplace());
}

ValueResult read_value(const TomlValue& value, const KeyRule& rule, std::optional<std::uint64_t>& out) {
    std::int64_t whole = 0;
    if (ValueResult fault = read_whole(value, rule, whole))
        return fault;
    out = static_cast<std::uint64_t>(whole);
    return std::nullopt;
}

/// The numbers of a list of exactly `count`, in a Value. The range of the rule holds for each.
template <class Value>
ValueResult read_numbers(const TomlValue& value, const KeyRule& rule, std::size_t count, double* out) {
    const TomlList* list = value.list();
    if (!list)
        return wrong_kind<Value>(value, rule);
    if (list->size() != count) {
        return ValueFault{value.place,
                          fmt::format("{}: expected {} numbers, found {}", rule.name, count, list->size())};
    }
    for (std::size_t i = 0; i < count; ++i) {
        if (ValueResult fault = read_value((*list)[i], rule, out[i]))
            return fault;
    }
    return std::nullopt;
}

ValueResult read_value(const TomlValue& value, const KeyRule& rule, std::array<double, 3>& out) {
    return read_numbers<std::array<double, 3>>(value, rule, out.size(), out.data());
}

ValueResult read_value(const TomlValue& value, const KeyRule& rule, std::optional<glm::dvec3>& out) {
    std::array<double, 3> numbers{};
    if (ValueResult fault = read_value(value, rule, numbers))
        return fault;
    out = glm::dvec3(numbers[0], numbers[1], numbers[2]);
    return std::nullopt;
}

ValueResult read_value(const TomlValue& value, const KeyRule& rule, std::vector<double>& out) {
    if (!value.list()) {
        double number = 0.0;
        const bool is_number = std::holds_alternative<double>(value.content) ||
                               std::holds_alternative<std::int64_t>(value.content);
        if (!is_number)
            return wrong_kind<std::vector<double>>(value, rule);
        if (ValueResult fault = read_value(value, rule, number))
            return fault;
        out = {number};
        return std::nullopt;
    }
    out.resize(value.list()->size());
    return read_numbers<std::vector<double>>(value, rule, out.size(), out.data());
}

ValueResult read_value(const TomlValue& value, const KeyRule& rule, std::vector<std::string>& out) {
    out.clear(); // of what it is when the key is left out
    if (!value.list()) {
        if (!std::holds_alternative<std::string>(value.content))
            return wrong_kind<std::vector<std::string>>(value, rule);
        return read_value(value, rule, out.emplace_back());
    }
    for (const TomlValue& item : *value.list()) {
        if (ValueResult fault = read_value(item, rule, out.emplace_back()))
            return fault;
    }
    if (out.empty())
        return ValueFault{value.place, fmt::format("{}: the list is empty", rule.name),
                          "leave the key out to take all"};
    return std::nullopt;
}

namespace {

/// The items of a list of lists; what is one such item itself, as its first element tells, counts as a list
/// of it: `[x, y, z, r]` as `[[x, y, z, r]]`. `depth`: of lists in an item.
std::span<const TomlValue> items_of(const TomlValue& value, int depth) {
    const TomlValue* first = &value;
    for (int level = 0; level < depth && first->list() && !first->list()->empty(); ++level)
        first = &first->list()->front();
    if (first->list())
        return *value.list();
    return {&value, 1};
}

} // namespace

ValueResult read_value(const TomlValue& value, const KeyRule& rule, std::vector<std::array<double, 4>>& out) {
    using Spheres = std::vector<std::array<double, 4>>;
    if (!value.list())
        return wrong_kind<Spheres>(value, rule);
    for (const TomlValue& item : items_of(value, 1)) {
        std::array<double, 4> sphere{};
        if (ValueResult fault = read_numbers<Spheres>(item, rule, sphere.size(), sphere.data()))
            return fault;
        if (!(sphere[3] > 0.0))
            return ValueFault{
                item.place, fmt::format("{}: a sphere's radius of {} is not above 0", rule.name, sphere[3])};
        out.push_back(sphere);
    }
    return std::nullopt;
}

ValueResult read_value(const TomlValue& value, const KeyRule& rule, std::vector<std::array<double, 6>>& out) {
    using Planes = std::vector<std::array<double, 6>>;
    if (!value.list())
        return wrong_kind<Planes>(value, rule);
    for (const TomlValue& item : items_of(value, 2)) {
        const TomlList* pair = item.list();
        if (!pair || pair->size() != 2)
            return ValueFault{
                item.place,
                fmt::format("{}: expected a point and a direction, [[x, y, z], [nx, ny, nz]]", rule.name)};
        std::array<double, 6> plane{};
        for (std::size_t half = 0; half < 2; ++half) {
            if (ValueResult fault = read_numbers<Planes>((*pair)[half], rule, 3, plane.data() + 3 * half))
                return fault;
        }
        if (plane[3] == 0.0 && plane[4] == 0.0 && plane[5] == 0.0)
            return ValueFault{(*pair)[1].place,
                              fmt::format("{}: a direction of length 0 points nowhere", rule.name)};
        out.push_back(plane);
    }
    return std::nullopt;
}

using Boxes = std::vector<std::array<glm::dvec3, 2>>;

ValueResult read_value(const TomlValue& value, const KeyRule& rule, Boxes& out) {
    if (!value.list())
        return wrong_kind<Boxes>(value, rule);
    for (const TomlValue& item : *value.list()) {
        const TomlList* pair = item.list();
        if (!pair || pair->size() != 2)
            return ValueFault{item.place,
                              fmt::format("{}: expected two corners, [[x, y, z], [x, y, z]]", rule.name)};
        auto& [low, high] = out.emplace_back();
        for (const auto& [corner, written] : {std::pair{&low, &(*pair)[0]}, {&high, &(*pair)[1]}}) {
            if (ValueResult fault = read_numbers<Boxes>(*written, rule, 3, &corner->x))
                return fault;
        }
        for (int axis = 0; axis < 3; ++axis) {
            if (!(low[axis] < high[axis]))
                return ValueFault{item.place,
                                  fmt::format("{}: the box reaches from {} to {} along {}", rule.name,
                                              low[axis], high[axis], "xyz"[axis]),
                                  "give the corner with the smallest coordinates first"};
        }
    }
    return std::nullopt;
}

using NamedShares = std::vector<std::pair<std::string, double>>;

ValueResult read_value(const TomlValue& value, const KeyRule& rule, NamedShares& out) {
    if (!value.table())
        return wrong_kind<NamedShares>(value, rule);
    for (const TomlEntry& entry : *value.table()) {
        if (ValueResult fault = check_name(entry.key, entry.key_place, rule.name))
            return fault;
        double number = 0.0;
        if (ValueResult fault = read_value(entry.value, rule, number))
            return fault;
        out.emplace_back(entry.key, number);
    }
    return std::nullopt;
}

/// A word that goes into the cells of tables.
ValueResult check_word(const TomlValue& value, const KeyRule& rule, std::string_view name,
                       const std::string& word) {
    const bool is_blank = word.find_first_not_of(' ') == std::string::npos;
    if (!is_blank &&
        std::none_of(word.begin(), word.end(), [](unsigned char character) { return character < 0x20; }))
        return std::nullopt;
    return ValueFault{
        value.place,
        fmt::format("{}.{}: {}", rule.name, name,
                    is_blank ? "the word is empty" : "the word does not go into one cell of a table"),
        "take letters, digits and signs on one line"};
}

ValueResult read_value(const TomlValue& value, const KeyRule& rule, NamedNumbers& out) {
    if (!value.table())
        return wrong_kind<NamedNumbers>(value, rule);
    for (const TomlEntry* written : in_order_of_file(*value.table())) {
        const TomlEntry& entry = *written;
        NamedNumber& named = out.emplace_back(NamedNumber{entry.key});
        if (ValueResult fault = read_value(entry.value, rule, named.number))
            return fault;
    }
    return std::nullopt;
}

ValueResult read_value(const TomlValue& value, const KeyRule& rule, NamedWords& out) {
    if (!value.table())
        return wrong_kind<NamedWords>(value, rule);
    for (const TomlEntry* written : in_order_of_file(*value.table())) {
        const TomlEntry& entry = *written;
        NamedWord& named = out.emplace_back(NamedWord{entry.key, {}, {}});
        if (const auto* word = std::get_if<std::string>(&entry.value.content)) {
            if (ValueResult fault = check_word(entry.value, rule, entry.key, *word))
                return fault;
            named.text = *word;
            continue;
        }
        double number = 0.0;
        const bool is_number = std::holds_alternative<double>(entry.value.content) ||
                               std::holds_alternative<std::int64_t>(entry.value.content);
        if (!is_number)
            return ValueFault{entry.value.place, fmt::format("{}.{}: expected a word or a number, found {}",
                                                             rule.name, entry.key, entry.value.kind())};
        if (ValueResult fault = read_value(entry.value, rule, number))
            return fault;
        named.text = fmt::format("{}", number);
        named.number = number;
    }
    return std::nullopt;
}

ValueResult read_value(const TomlValue& value, const KeyRule& rule, Series& out) {
    if (!value.table())
        return wrong_kind<Series>(value, rule);
    for (const TomlEntry* written : in_order_of_file(*value.table()))
        out.keys.push_back(written->key);
    return std::nullopt;
}

// JSON Schema.

using Json = nlohmann::ordered_json;

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

Json truth(const KeyRule&) { return {{"type", "boolean"}}; }
Json whole(const KeyRule& rule) { return ranged("integer", rule); }
Json number(const KeyRule& rule) { return ranged("number", rule); }
Json path(const KeyRule&) { return {{"type", "string"}, {"minLength", 1}}; }
Json three(const KeyRule& rule) { return list_of(number(rule), 3, 3); }
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
                        "a sphere [x, y, z, radius], or a list of spheres", spheres),
                    planes_type = optional<std::vector<std::array<double, 6>>>(
                        "a plane [[x, y, z], [nx, ny, nz]], or a list of planes", planes),
                    boxes_type = optional<Boxes>("a list of boxes [[x, y, z], [x, y, z]]", planes),
                    named_shares_type =
                        optional<NamedShares>("a table of names with a number each", named_shares),
                    named_numbers_type =
                        optional<NamedNumbers>("a table of names with a whole number each", named_numbers),
                    named_words_type =
                        optional<NamedWords>("a table of names with a word or a number each", named_words),
                    series_type = optional<Series>("a table of keys with a list each", series);

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
const ValueType& value_type(TypeTag<Boxes>) { return boxes_type; }
const ValueType& value_type(TypeTag<NamedShares>) { return named_shares_type; }

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

const ValueType& value_type(TypeTag<NamedNumbers>) { return named_numbers_type; }
const ValueType& value_type(TypeTag<NamedWords>) { return named_words_type; }
const ValueType& value_type(TypeTag<Series>) { return series_type; }

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
    return {a_text, read, text, written, names};
}

std::string written_choice(const KeyRule& rule, std::size_t index) {
    OVERT_EXPECTS(index < rule.choices.size());
    return written(std::string(rule.choices[index]));
}

} // namespace overt
