/// The colours of thin films.
#pragma once

#include <complex>

#include "experiment/protocol/protocol.h"
#include "experiment/spectra/spectra.h"
#include "render/bake/conductor.h"

namespace overt {

/// Changes whenever the same inputs would give other light: part of the key under which frames are kept.
constexpr int thin_film_version = 1;

/// Share of unpolarised light of a wavelength in vacuum that a film of index `film` and thickness `film_nm`
/// in air reflects, over a body of complex index n + ik, at the cosine of the angle to its normal: Airy's sum
/// of all that goes to and fro in it, for both polarisations (Born and Wolf, Principles of Optics, 7.6
/// and 14.4).
double film_reflectance(double wavelength_nm, double film, double film_nm, std::complex<double> body,
                        double cosine);

/// The same for all bins over a metal, each the mean of eight wavelengths within it: fringes narrower than a
/// bin come out right to 0.01 Delta-E up to films of 4 um.
Bins film_over_metal(const ComplexIndex& metal, double film, double film_nm, double cosine);

/// What the metal of a material reflects, through its film if it has one; of a coated one below the coat.
/// Throws InputError for an unknown metal.
ConductorTable metal_table(const MaterialSettings& material);

} // namespace overt
