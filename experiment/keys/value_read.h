/// How the value of a key is read: one function for each type of value_type.h. Only the files of value types
/// include it. Each takes the value as it stands in the file and the rule of its key, and gives what is wrong
/// with it, or fills `out`.
#pragma once

#include <fmt/format.h>

#include "experiment/keys/value_type.h"

namespace overt {

using Triples = std::vector<std::array<double, 3>>;
using Spheres = std::vector<std::array<double, 4>>;
using Planes = std::vector<std::array<double, 6>>;
using Boxes = std::vector<std::array<glm::dvec3, 2>>;
using NamedShares = std::vector<std::pair<std::string, double>>;

// Single values and lists of them (value_read.cpp).
ValueResult read_value(const TomlValue& value, const KeyRule& rule, bool& out);
ValueResult read_value(const TomlValue& value, const KeyRule& rule, int& out);
ValueResult read_value(const TomlValue& value, const KeyRule& rule, double& out);
ValueResult read_value(const TomlValue& value, const KeyRule& rule, Degrees& out);
ValueResult read_value(const TomlValue& value, const KeyRule& rule, std::string& out);
ValueResult read_value(const TomlValue& value, const KeyRule& rule, std::filesystem::path& out);
ValueResult read_value(const TomlValue& value, const KeyRule& rule, std::optional<double>& out);
ValueResult read_value(const TomlValue& value, const KeyRule& rule, std::optional<int>& out);
ValueResult read_value(const TomlValue& value, const KeyRule& rule, std::optional<std::uint64_t>& out);
ValueResult read_value(const TomlValue& value, const KeyRule& rule, std::array<double, 3>& out);
ValueResult read_value(const TomlValue& value, const KeyRule& rule, std::optional<glm::dvec3>& out);
ValueResult read_value(const TomlValue& value, const KeyRule& rule, std::vector<double>& out);
ValueResult read_value(const TomlValue& value, const KeyRule& rule, std::vector<std::string>& out);
// Shapes in space (value_shapes.cpp).
ValueResult read_value(const TomlValue& value, const KeyRule& rule, Triples& out);
ValueResult read_value(const TomlValue& value, const KeyRule& rule, Spheres& out);
ValueResult read_value(const TomlValue& value, const KeyRule& rule, Planes& out);
ValueResult read_value(const TomlValue& value, const KeyRule& rule, Boxes& out);
// Tables of names (value_tables.cpp).
ValueResult read_value(const TomlValue& value, const KeyRule& rule, NamedShares& out);
ValueResult read_value(const TomlValue& value, const KeyRule& rule, NamedNumbers& out);
ValueResult read_value(const TomlValue& value, const KeyRule& rule, NamedWords& out);
ValueResult read_value(const TomlValue& value, const KeyRule& rule, Series& out);

template <class Value> ValueFault wrong_kind(const TomlValue& value, const KeyRule& rule) {
    const std::string_view noun = value_type(TypeTag<Value>()).noun;
    return {value.place,
            fmt::format("{}: expected {}, found {}", rule.name, expected_text(rule, noun), value.kind())};
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

} // namespace overt
