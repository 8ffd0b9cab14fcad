/// The numbers that picture files hold, as floats: fast enough that a frame's file is read in little more
/// than the time that unpacking it takes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace overt {

/// Whether none of them is infinite or not a number.
bool all_finite(std::span<const float> values) noexcept;

/// Numbers of IEEE 754 binary16, exactly. `into` has room for as many. Gives all_finite() of them.
bool floats_of_halves(std::span<const std::uint16_t> halves, std::span<float> into);

/// Codes of 16 bits: code / 65535, rounded to a float.
void floats_of_codes(std::span<const std::uint16_t> codes, std::span<float> into) noexcept;

/// The encoding of IEC 61966-2-1 and its inverse.
float srgb_from_linear(float value) noexcept;
float linear_from_srgb(float value) noexcept;

/// linear_from_srgb of a value that floats_of_codes() gave, of 8 or 16 bits.
float linear_from_srgb_code(float value) noexcept;

} // namespace overt
