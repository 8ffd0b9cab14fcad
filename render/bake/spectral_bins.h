/// What a path carries: a number for each of the 31 bins, padded to 32, and what is done with it at each
/// event. The loops are compiled for several processors; all give the same bits, for no sum runs across the
/// bins.
#pragma once

#include <array>
#include <cstddef>

#include <glm/glm.hpp>

#include "experiment/spectra/spectra.h"

namespace overt {

struct alignas(64) Bins {
    static constexpr std::size_t padded = 32;
    std::array<float, padded> value{};

    static Bins filled(float with) {
        Bins bins;
        bins.value.fill(with);
        return bins;
    }
    static Bins of(const Spectrum& spectrum) {
        Bins bins;
        for (std::size_t bin = 0; bin < spectral_bins; ++bin)
            bins.value[bin] = static_cast<float>(spectrum[bin]);
        return bins;
    }
    /// Largest of the 31.
    float largest() const;
};

/// Three spectra that red, green and blue stand for.
using RgbBasis = std::array<Bins, 3>;

void scale(Bins& bins, float factor);
/// Likewise, and what is below 1e-30 is nothing: numbers near the least that there is are slow.
void scale_or_drop(Bins& bins, float factor);
void multiply(Bins& bins, const Bins& by);
/// Times `from`, or `to`, or what lies between them at `share`.
void multiply_mixed(Bins& bins, const Bins& from, const Bins& to, float share);
/// Beer and Lambert: times exp(-absorbance * path); relative error below 3e-7.
void absorb(Bins& bins, const Bins& absorbance, float path);
/// How likely flights and scatterings are to the bands of a medium, by how likely they are to one of them:
/// coefficients per unit of length and their logarithms to the base of 2.
struct FlightChances {
    const Bins &logarithm, &coefficient;
    float own_logarithm, own_coefficient; ///< of that one
};
/// Times (coefficient / own)^count * exp(-(coefficient - own) * length).
void multiply_by_flights(Bins& bins, const FlightChances& chances, float count, float length);
/// sum += bins * (rgb.r * basis[0] + rgb.g * basis[1] + rgb.b * basis[2])
void add_lit(Bins& sum, const Bins& bins, const RgbBasis& basis, glm::vec3 rgb);
/// sum += bins
void add(Bins& sum, const Bins& bins);

} // namespace overt
