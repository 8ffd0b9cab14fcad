/// What the sub-benchmarks of `overt bench` share: the figures they give and the figures in stone they
/// measure on.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/commands.h"
#include "experiment/sculpture.h"

namespace overt {

/// One measured figure.
struct BenchFigure {
    std::string figure; ///< what was measured, and on what
    double value = 0.0;
    std::string unit;
    std::string target = {};        ///< such as «<= 0.5»; empty if none is set
    std::optional<bool> holds = {}; ///< whether the value reaches the target; nothing without a target
};
using BenchFigures = std::vector<BenchFigure>;

/// A figure that must not be above, or not below, a bound.
BenchFigure at_most(std::string figure, double value, std::string unit, double bound);
BenchFigure at_least(std::string figure, double value, std::string unit, double bound);

/// What a benchmark measures on: a protocol with its sculptures.
struct BenchScene {
    Protocol protocol;
    std::vector<Sculpture> sculptures;
};

/// The sculpture of --mesh, else the shipped ones, in the default experiment with a picture of --size. Throws
/// InputError as load_sculpture does.
BenchScene bench_scene(const BenchOptions& options);

// The sub-benchmarks, each in a file of its name.
BenchFigures bench_lut(const BenchOptions& options); ///< the hidden pass: its exactness, time and memory

} // namespace overt
