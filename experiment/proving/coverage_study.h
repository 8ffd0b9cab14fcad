/// Simulated observers whose truth is known, and how often an interval of 95 % holds it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace overt {

struct CoverageStudy {
    std::string what;  ///< procedure and interval
    int studies = 0;   ///< that were simulated
    int held = 0;      ///< whose interval holds the truth
    int without = 0;   ///< that gave no interval: they count as not held
    double bias = 0.0; ///< mean of the estimates less the truth, in their spread over studies
    double share() const { return static_cast<double>(held) / studies; }
};

/// Of each procedure as many studies as asked for; everything follows from the seed.
std::vector<CoverageStudy> coverage_studies(int studies, std::uint64_t seed);

} // namespace overt
