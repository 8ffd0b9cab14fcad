/// Matches: what observers set to look like a reference.
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace overt {

/// Settings for one reference.
struct MatchSettings {
    double reference = 0.0;
    std::vector<double> settings; ///< at least one
};

struct MatchEstimate {
    double reference = 0.0;
    double point_of_equality = 0.0;             ///< mean of the settings
    double constant_error = 0.0;                ///< that less the reference
    std::optional<double> sd = {};              ///< of the settings (n - 1); with two at least
    std::optional<double> just_noticeable = {}; ///< 0.67449 sd: half of the settings lie within it
};

/// A straight line of match over reference.
struct MatchLine {
    double slope = 0.0, intercept = 0.0;
};

std::vector<MatchEstimate> match_estimates(std::span<const MatchSettings> references);

/// Of all settings over their references, by least squares. Nothing with fewer than two references.
std::optional<MatchLine> least_squares_line(std::span<const MatchSettings> references);

/// With errors of the same size in both (Deming). Nothing where there is no line.
std::optional<MatchLine> deming_line(std::span<const MatchSettings> references);

/// How much of the way from the proximal match (what reaches the eye) to the distal one (what is there) a
/// match goes: 0 none, 1 all. Thouless takes logarithms, so that all three must be positive.
double brunswik_ratio(double match, double proximal, double distal);
double thouless_ratio(double match, double proximal, double distal);

} // namespace overt
