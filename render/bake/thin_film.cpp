#include "render/bake/thin_film.h"

#include <cmath>
#include <numbers>

#include "experiment/spectra/metal_table.h"

namespace overt {

double film_reflectance(double wavelength_nm, double film, double film_nm, std::complex<double> body,
                        double cosine) {
    using Complex = std::complex<double>;
    const double sine_squared = 1.0 - cosine * cosine;
    const Complex in_film = std::sqrt(Complex(1.0 - sine_squared / (film * film)));
    const Complex in_body = std::sqrt(1.0 - sine_squared / (body * body));
    const Complex phase =
        std::exp(Complex(0.0, 4.0 * std::numbers::pi * film * film_nm / wavelength_nm) * in_film);
    double sum = 0.0;
    for (const bool is_across : {true, false}) {
        // Amplitudes at a surface between two media, by indices and cosines.
        const auto amplitude = [&](Complex from, Complex to, Complex cosine_from, Complex cosine_to) {
            return is_across ? (from * cosine_from - to * cosine_to) / (from * cosine_from + to * cosine_to)
                             : (to * cosine_from - from * cosine_to) / (to * cosine_from + from * cosine_to);
        };
        const Complex upper = amplitude(1.0, film, cosine, in_film),
                      lower = amplitude(film, body, in_film, in_body);
        sum += 0.5 * std::norm((upper + lower * phase) / (1.0 + upper * lower * phase));
    }
    return sum;
}

Bins film_over_metal(const ComplexIndex& metal, double film, double film_nm, double cosine) {
    constexpr int parts = 8;
    Bins bins{};
    for (std::size_t bin = 0; bin < spectral_bins; ++bin) {
        double sum = 0.0;
        for (int part = 0; part < parts; ++part) {
            const double wavelength =
                first_bin_centre_nm + bin_width_nm * (static_cast<double>(bin) + (part + 0.5) / parts - 0.5);
            sum += film_reflectance(wavelength, film, film_nm, {metal.n[bin], metal.k[bin]}, cosine) / parts;
        }
        bins.value[bin] = static_cast<float>(sum);
    }
    return bins;
}

ConductorTable metal_table(const MaterialSettings& material) {
    const ComplexIndex metal = load_metal(material.metal);
    if (material.film_nm && row_of(material.kind).has_key("film_nm"))
        return ConductorTable([&](double cosine) {
            return film_over_metal(metal, material.film_ior, *material.film_nm, cosine);
        });
    return {metal, material.kind == MaterialKind::coated_conductor ? material.coat_ior : 1.0};
}

} // namespace overt
