/// Smooth noise in space, fixed by a seed.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

namespace overt {

/// Mixes bits: the finaliser of SplitMix64 (Steele, Lea and Flood 2014).
std::uint64_t mixed_bits(std::uint64_t x);

/// Perlin's noise (2002) with a lattice of 1: mean 0, within about -0.9 … 0.9.
double lattice_noise(glm::dvec3 place, std::uint64_t seed);

} // namespace overt
