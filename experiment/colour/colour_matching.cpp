#include "experiment/colour/colour_matching.h"

#include <algorithm>
#include <cmath>

#include <glm/vec2.hpp>

#include "colour_tables.h"
#include "experiment/base/error.h"
#include "experiment/base/number_table.h"

namespace overt {

namespace {

/// Lumens per watt, at the wavelength of 540 THz: SI Brochure, 9th edition.
constexpr double luminous_efficacy = 683.0;

std::array<SampledSpectrum, 3> functions_of(std::string_view table) {
    std::array<SampledSpectrum, 3> functions;
    for (const std::vector<double>& row : rows_of_table(table, 4))
        for (std::size_t i = 0; i < 3; ++i) {
            functions[i].wavelengths_nm.push_back(row[0]);
            functions[i].values.push_back(row[i + 1]);
        }
    return functions;
}

} // namespace

const std::array<SampledSpectrum, 3>& colour_matching(ColourSpace space) {
    static const std::array tables{functions_of(embedded::cie1931_xyz_2deg_csv),
                                   functions_of(embedded::cie2006_xyz_2deg_csv),
                                   functions_of(embedded::cie2006_cones_2deg_csv)};
    return tables[static_cast<std::size_t>(space)];
}

glm::dvec3 tristimulus_of(const SampledSpectrum& radiance, ColourSpace space) {
    glm::dvec3 sum(0.0);
    if (radiance.values.empty())
        return sum;
    const auto& functions = colour_matching(space);
    const double first = std::max(radiance.first_nm(), functions[0].first_nm()),
                 last = std::min(radiance.last_nm(), functions[0].last_nm());
    // Whole nanometres, at which the functions are tabulated, and what is left over at both ends.
    for (double low = first; low < last;) {
        const double high = std::min(last, std::floor(low) + 1.0);
        for (int i = 0; i < 3; ++i) {
            const SampledSpectrum& function = functions[static_cast<std::size_t>(i)];
            sum[i] += 0.5 * (high - low) *
                      (radiance.at(low) * function.at(low) + radiance.at(high) * function.at(high));
        }
        low = high;
    }
    return space == ColourSpace::cie2006_cones ? sum : luminous_efficacy * sum;
}

glm::dvec2 chromaticity_of(const glm::dvec3& xyz) {
    const double sum = xyz.x + xyz.y + xyz.z;
    return sum > 0.0 ? glm::dvec2(xyz.x, xyz.y) / sum : glm::dvec2(0.0);
}

} // namespace overt
