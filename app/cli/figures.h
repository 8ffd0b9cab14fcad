/// Measured figures with their targets, as benchmarks and checks print them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace overt {

/// One measured figure.
struct BenchFigure {
    std::string figure; ///< what was measured, and on what
    double value = 0.0;
    std::string unit;
    std::string target = {};        ///< such as "<= 0.5"; empty if none is set
    std::optional<bool> holds = {}; ///< whether the value reaches the target; nothing without a target
};
using BenchFigures = std::vector<BenchFigure>;

/// A figure that must not be above, or not below, a bound.
BenchFigure at_most(std::string figure, double value, std::string unit, double bound);
BenchFigure at_least(std::string figure, double value, std::string unit, double bound);

/// No figure misses its target.
bool all_hold(const BenchFigures& figures);

/// {"figures": [{"figure", "value", "unit", "target", "holds"}, …]}; the last two only where a target is set.
nlohmann::ordered_json to_json(const BenchFigures& figures);

/// To standard output, a line each.
void print_table(const BenchFigures& figures);

} // namespace overt
