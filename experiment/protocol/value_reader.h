/// One value of a protocol file into one member of a struct, by the rule of its key.
#pragma once

#include <string>
#include <type_traits>

#include "experiment/protocol/protocol_keys.h"
#include "experiment/protocol/toml_tree.h"

namespace overt {

/// What is wrong with a value, and where in it.
struct ValueFault {
    Place place;
    std::string message;
    std::string hint = {};
};
using ValueResult = std::optional<ValueFault>; ///< nothing: the value was taken

ValueResult read_value(const TomlValue& value, const KeyRule& rule, bool& out);
ValueResult read_value(const TomlValue& value, const KeyRule& rule, int& out);
ValueResult read_value(const TomlValue& value, const KeyRule& rule, double& out);
ValueResult read_value(const TomlValue& value, const KeyRule& rule, Degrees& out);
ValueResult read_value(const TomlValue& value, const KeyRule& rule, std::string& out);
ValueResult read_value(const TomlValue& value, const KeyRule& rule, std::filesystem::path& out);
ValueResult read_value(const TomlValue& value, const KeyRule& rule, std::optional<double>& out);
ValueResult read_value(const TomlValue& value, const KeyRule& rule, std::optional<int>& out);
ValueResult read_value(const TomlValue& value, const KeyRule& rule, std::optional<std::uint64_t>& out);
ValueResult read_value(const TomlValue& value, const KeyRule& rule, std::optional<glm::dvec3>& out);
ValueResult read_value(const TomlValue& value, const KeyRule& rule, std::array<double, 3>& out);
/// A list of numbers, or one number, which is a list of one.
ValueResult read_value(const TomlValue& value, const KeyRule& rule, std::vector<double>& out);
ValueResult read_value(const TomlValue& value, const KeyRule& rule, std::vector<std::array<double, 4>>& out);
ValueResult read_value(const TomlValue& value, const KeyRule& rule, std::vector<std::array<double, 6>>& out);

/// A list of texts, or one text, which is a list of one. The rule holds for each.
ValueResult read_value(const TomlValue& value, const KeyRule& rule, std::vector<std::string>& out);

template <class Enumeration>
requires std::is_enum_v<Enumeration> ValueResult read_value(const TomlValue& value, const KeyRule& rule,
                                                            Enumeration& out) {
    std::string name;
    if (ValueResult fault = read_value(value, rule, name))
        return fault;
    for (std::size_t i = 0; i < rule.choices.size(); ++i) {
        if (rule.choices[i] == name)
            out = static_cast<Enumeration>(i);
    }
    return std::nullopt;
}

template <class Enumeration>
requires std::is_enum_v<Enumeration> ValueResult read_value(const TomlValue& value, const KeyRule& rule,
                                                            std::optional<Enumeration>& out) {
    return read_value(value, rule, out.emplace());
}

} // namespace overt
