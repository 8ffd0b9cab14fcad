/// Numbers as decimal text, the same on every machine and in every locale, and fast.
#pragma once

#include <cstdint>
#include <string>

namespace overt {

/// A whole number of 10^-decimals (0 … 9): 12345 with 3 decimals is 12.345.
void append_scaled(std::string& text, std::int64_t number, int decimals);

/// With that many decimals (0 … 9), half away from zero. The number must be finite.
void append_fixed(std::string& text, double number, int decimals);

/// The shortest decimal number that only this float stands for: 2338.6 of 2338.6f, which as a double is
/// 2338.60009765625. What a tracker gave with up to six digits comes back as it was.
double shortest_decimal(float number);

} // namespace overt
