#include "experiment/base/number_text.h"

#include <array>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

namespace overt {
namespace {

constexpr std::array<std::int64_t, 10> powers_of_ten{
    1, 10, 100, 1'000, 10'000, 100'000, 1'000'000, 10'000'000, 100'000'000, 1'000'000'000};

void append_integer(std::string& text, std::uint64_t number) {
    std::array<char, 20> digits;
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
    text.append(digits.data(), end);
}

} // namespace

void append_scaled(std::string& text, std::int64_t number, int decimals) {
    if (number < 0)
        text += '-';
    const std::uint64_t magnitude = number < 0 ? std::uint64_t{0} - static_cast<std::uint64_t>(number)
                                               : static_cast<std::uint64_t>(number);
    const auto scale = static_cast<std::uint64_t>(powers_of_ten[static_cast<std::size_t>(decimals)]);
    append_integer(text, magnitude / scale);
    if (decimals == 0)
        return;
    text += '.';
    std::array<char, 9> digits;
    std::uint64_t rest = magnitude % scale;
    for (int i = decimals - 1; i >= 0; --i, rest /= 10)
        digits[static_cast<std::size_t>(i)] = static_cast<char>('0' + rest % 10);
    text.append(digits.data(), static_cast<std::size_t>(decimals));
}

void append_fixed(std::string& text, double number, int decimals) {
    constexpr double largest_exact = 9.0e15; // below 2^53: all whole numbers up to here are doubles
    const double scaled = number * static_cast<double>(powers_of_ten[static_cast<std::size_t>(decimals)]);
    if (std::abs(scaled) < largest_exact)
        append_scaled(text, std::llround(scaled), decimals);
    else
        text += fmt::format("{:.{}f}", number, decimals);
}

double shortest_decimal(float number) {
    constexpr std::size_t longest = 32; // of the shortest text of a float
    std::array<char, longest> digits;
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
    double decimal = 0.0;
    std::from_chars(digits.data(), end, decimal);
    return decimal;
}

} // namespace overt
