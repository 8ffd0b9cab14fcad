/// One value of a TOML file into one member of a struct, by the rule of its key.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "experiment/keys/key_rule.h"
#include "experiment/keys/toml_tree.h"
#include "experiment/units.h"

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

/// A text that is one of the rule's choices: which.
ValueResult read_choice(const TomlValue& value, const KeyRule& rule, std::size_t& index);

} // namespace overt
