/// What a metal reflects, from its complex refractive index.
#pragma once

#include <functional>
#include <vector>

#include "render/bake/spectral_bins.h"

namespace overt {

/// Share of unpolarised light that a smooth metal n + ik, both relative to the medium outside, reflects at
/// the cosine of the angle to its normal: Fresnel's equations, exact (Born and Wolf, Principles of
/// Optics, 13.2).
double conductor_fresnel(double n, double k, double cosine);

/// The same of a dielectric with `ior` = index beyond / index on the light's side; 1 beyond the critical
/// angle.
float dielectric_fresnel(float ior, float cosine);

/// conductor_fresnel of all bins, tabulated over 1025 cosines, between which it is taken as straight: the
/// error is below 2e-5 for metals.
class ConductorTable {
  public:
    ConductorTable() = default;
    /// `outside`: index of the medium over the metal.
    ConductorTable(const ComplexIndex& metal, double outside);
    /// Of any other surface, by what it reflects at a cosine.
    explicit ConductorTable(const std::function<Bins(double cosine)>& reflectance);

    /// bins times the reflectance at that cosine, 0 … 1.
    void multiply_into(Bins& bins, float cosine) const {
        const float place = cosine * static_cast<float>(rows - 1);
        const int row = place < 0.0f ? 0 : (place > rows - 2 ? rows - 2 : static_cast<int>(place));
        const Bins* from = &reflectance_[static_cast<std::size_t>(row)];
        multiply_mixed(bins, from[0], from[1], place - static_cast<float>(row));
    }

  private:
    static constexpr int rows = 1025;
    std::vector<Bins> reflectance_;
};

} // namespace overt
