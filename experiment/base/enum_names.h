/// Names of enumerations as files have them: one list for each enumeration, right below it.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace overt {

/// Whether a number is one of an enumeration's values. gcc and clang write such a value by its name, and any
/// other number as a cast, "(overt::BreakPace)2".
template <class Enum, Enum value> consteval bool is_enumerator() {
    std::string_view text = __PRETTY_FUNCTION__;
    text = text.substr(0, text.find_last_not_of("0123456789]") + 1);
    return !text.ends_with(')');
}

/// The names of an enumeration whose values count from 0, in their order, by specialisation:
///     enum class BreakPace { self, timed };
///     template <> inline constexpr auto names_of<BreakPace> = enum_names<BreakPace>("self", "timed");
template <class Enum> inline constexpr std::nullptr_t names_of = nullptr;

/// A value without a name does not compile, nor does a name too many.
template <class Enum, class... Names> consteval auto enum_names(Names... names) {
    constexpr std::size_t count = sizeof...(Names);
    static_assert(is_enumerator<Enum, static_cast<Enum>(count - 1)>(), "there is a name too many");
    static_assert(!is_enumerator<Enum, static_cast<Enum>(count)>(), "a value has no name");
    return std::array<std::string_view, count>{names...};
}

template <class Enum>
concept NamedEnum = requires {
    names_of<Enum>.size();
};

template <NamedEnum Enum> constexpr std::string_view name_of(Enum value) {
    return names_of<Enum>.at(static_cast<std::size_t>(value));
}

} // namespace overt
