/// Numbers that a text is, in every locale the same.
#pragma once

#include <charconv>
#include <concepts>
#include <optional>
#include <string_view>

namespace overt {

/// The number that a text is, all of it and nothing else; nothing if it is none, or none that a `Number`
/// holds. `base`: of whole numbers that are not decimal; 16 is without "0x".
template <class Number>
std::optional<Number> number_in(std::string_view text, std::same_as<int> auto... base) noexcept {
    Number number{};
    const char* const end = text.data() + text.size();
    const auto [after, error] = std::from_chars(text.data(), end, number, base...);
    return error == std::errc() && after == end ? std::optional(number) : std::nullopt;
}

} // namespace overt
