#include "experiment/spectra/spectra.h"

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/number_table.h"
#include "spectra_tables.h"

namespace overt {

namespace {

/// The columns of a table after the first: one spectrum each.
template <std::size_t columns> std::array<Spectrum, columns> columns_of(std::string_view table) {
    const std::vector<std::vector<double>> rows = rows_of_table(table, columns + 1);
    OVERT_EXPECTS(rows.size() == spectral_bins);
    std::array<Spectrum, columns> spectra{};
    for (std::size_t bin = 0; bin < rows.size(); ++bin) {
        OVERT_EXPECTS(rows[bin][0] == first_bin_centre_nm + bin_width_nm * static_cast<double>(bin));
        for (std::size_t column = 0; column < columns; ++column)
            spectra[column][bin] = rows[bin][column + 1];
    }
    return spectra;
}

ComplexIndex index_of(std::string_view table) {
    const auto columns = columns_of<2>(table);
    return {columns[0], columns[1]};
}

/// XYZ to linear Rec.709 (IEC 61966-2-1, whose white is D65).
constexpr double rec709_from_xyz[3][3] = {
    {3.2406, -1.5372, -0.4986}, {-0.9689, 1.8758, 0.0415}, {0.0557, -0.2040, 1.0570}};

glm::dvec3 xyz_under_d65(const Spectrum& reflectance) {
    glm::dvec3 xyz(0.0);
    for (std::size_t bin = 0; bin < spectral_bins; ++bin) {
        for (int axis = 0; axis < 3; ++axis) {
            xyz[axis] +=
                cie1931_xyz()[static_cast<std::size_t>(axis)][bin] * illuminant_d65()[bin] * reflectance[bin];
        }
    }
    return xyz;
}

glm::dvec3 rec709_of_xyz(glm::dvec3 xyz) {
    glm::dvec3 rgb(0.0);
    for (int channel = 0; channel < 3; ++channel) {
        for (int axis = 0; axis < 3; ++axis)
            rgb[channel] += rec709_from_xyz[channel][axis] * xyz[axis];
    }
    return rgb;
}

} // namespace

const ComplexIndex& metal_index(std::string_view metal) {
    static const ComplexIndex gold = index_of(embedded::au_nk_csv), silver = index_of(embedded::ag_nk_csv);
    if (metal == "Au")
        return gold;
    if (metal == "Ag")
        return silver;
    throw InputError(fmt::format("unknown metal \"{}\": known are Au and Ag", metal));
}

const std::array<Spectrum, 3>& cie1931_xyz() {
    static const auto table = columns_of<3>(embedded::cie1931_xyz_csv);
    return table;
}

const Spectrum& illuminant_d65() {
    static const auto table = columns_of<1>(embedded::d65_csv);
    return table[0];
}

Spectrum normal_reflectance(const ComplexIndex& metal, double outside) {
    Spectrum reflectance{};
    for (std::size_t bin = 0; bin < spectral_bins; ++bin) {
        const double n = metal.n[bin], k = metal.k[bin];
        reflectance[bin] = ((n - outside) * (n - outside) + k * k) / ((n + outside) * (n + outside) + k * k);
    }
    return reflectance;
}

glm::dvec3 linear_rec709_of(const Spectrum& reflectance) {
    Spectrum white;
    white.fill(1.0);
    // Relative to white, channel by channel: takes out what the coarse bins and the rounded matrix leave.
    return rec709_of_xyz(xyz_under_d65(reflectance)) / rec709_of_xyz(xyz_under_d65(white));
}

} // namespace overt
