/// The types that the value of a key can have: one object for each, with all that is done with such a value.
/// A type of its own needs a read_value() (value_read.h), the form it
/// has in a file (value_schema.h) and a row in value_type.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <glm/glm.hpp>
#include <nlohmann/json_fwd.hpp>

#include "experiment/base/enum_names.h"
#include "experiment/base/named_words.h"
#include "experiment/keys/key_rule.h"
#include "experiment/keys/toml_tree.h"
#include "experiment/units.h"

namespace overt {

/// What is wrong with a value, and where in it.
struct ValueFault {
    Place place;
    std::string message;
    std::string hint = {};
    std::vector<ValueFault> more = {}; ///< of a value of several parts: what else is wrong
};
using ValueResult = std::optional<ValueFault>; ///< nothing: the value was taken

/// `value` and `out` point to an object of the type.
struct ValueType {
    std::string_view noun; ///< what such a value is called in a file
    ValueResult (*read)(const TomlValue& written, const KeyRule& rule, void* out);
    nlohmann::ordered_json (*schema)(const KeyRule& rule); ///< JSON Schema
    /// As it is written in a file; null for types that have no default but "left out".
    std::string (*written)(const KeyRule& rule, const void* value);
    std::span<const std::string_view> names = {}; ///< of an enumeration that has names
};

template <class Value> using TypeTag = std::type_identity<Value>;

/// The object of each type. Safe from any thread.
const ValueType& value_type(TypeTag<bool>);
const ValueType& value_type(TypeTag<int>);
const ValueType& value_type(TypeTag<double>);
const ValueType& value_type(TypeTag<Degrees>);
const ValueType& value_type(TypeTag<std::string>);
const ValueType& value_type(TypeTag<std::filesystem::path>);
const ValueType& value_type(TypeTag<std::optional<double>>);
const ValueType& value_type(TypeTag<std::optional<int>>);
const ValueType& value_type(TypeTag<std::optional<std::uint64_t>>);
const ValueType& value_type(TypeTag<std::optional<glm::dvec3>>);
const ValueType& value_type(TypeTag<std::array<double, 3>>);
const ValueType& value_type(TypeTag<std::vector<double>>); ///< one number is a list of one
/// One text is a list of one. The rule holds for each.
const ValueType& value_type(TypeTag<std::vector<std::string>>);
const ValueType& value_type(TypeTag<std::vector<std::array<double, 3>>>); ///< a list of three numbers each
const ValueType& value_type(TypeTag<std::vector<std::array<double, 4>>>);
const ValueType& value_type(TypeTag<std::vector<std::array<double, 6>>>);
const ValueType& value_type(TypeTag<std::vector<std::array<glm::dvec3, 2>>>); ///< corners of boxes
/// Numbers by names, in the order of the file: { rim = 0.2, base = 0.3 }. The rule holds for each number.
const ValueType& value_type(TypeTag<std::vector<std::pair<std::string, double>>>);

/// Tables of names that no table of keys knows. The rule holds for each value.
const ValueType& value_type(TypeTag<NamedNumbers>);
const ValueType& value_type(TypeTag<NamedWords>);
const ValueType& value_type(TypeTag<Series>);

/// A name that the file gives to something: letters, digits, - and _, 40 at most. `what`: of which it is.
ValueResult check_name(const std::string& name, Place place, std::string_view what);
/// A text that is one of the rule's choices: which.
ValueResult read_choice(const TomlValue& value, const KeyRule& rule, std::size_t& index);

/// Of an enumeration, whose values are chosen by the names of the rule.
ValueType type_of_choices(ValueResult (*read)(const TomlValue&, const KeyRule&, void*),
                          std::string (*written)(const KeyRule&, const void*),
                          std::span<const std::string_view> names);
std::string written_choice(const KeyRule& rule, std::size_t index);

template <class Enum> std::span<const std::string_view> names_if_any() {
    if constexpr (NamedEnum<Enum>)
        return names_of<Enum>;
    else
        return {};
}

template <class Enum>
requires std::is_enum_v<Enum> ValueResult read_enum(const TomlValue& written, const KeyRule& rule,
                                                    Enum& out) {
    std::size_t index = 0;
    ValueResult fault = read_choice(written, rule, index);
    if (!fault)
        out = static_cast<Enum>(index);
    return fault;
}

template <class Enum>
requires std::is_enum_v<Enum>
const ValueType& value_type(TypeTag<Enum>) {
    static const ValueType type = type_of_choices(
        [](const TomlValue& written, const KeyRule& rule, void* out) {
            return read_enum(written, rule, *static_cast<Enum*>(out));
        },
        [](const KeyRule& rule, const void* value) {
            return written_choice(rule, static_cast<std::size_t>(*static_cast<const Enum*>(value)));
        },
        names_if_any<Enum>());
    return type;
}

template <class Enum>
requires std::is_enum_v<Enum>
const ValueType& value_type(TypeTag<std::optional<Enum>>) {
    static const ValueType type = type_of_choices(
        [](const TomlValue& written, const KeyRule& rule, void* out) {
            return read_enum(written, rule, static_cast<std::optional<Enum>*>(out)->emplace());
        },
        nullptr, names_if_any<Enum>());
    return type;
}

} // namespace overt
