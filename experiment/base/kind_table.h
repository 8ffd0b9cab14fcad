/// Kinds of a thing of which files name one, as a table: a row is all that the rest of the program knows of a
/// kind, and an enumeration without values of its own counts the rows:
///     enum class TrackerKind : std::uint8_t {};
///     template <> inline constexpr auto kinds_of<TrackerKind> = std::to_array<TrackerKindRow>({…});
/// A row begins with its `name`, which makes name_of() and the key table know the kinds by their names.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "experiment/base/enum_names.h"

namespace overt {

template <class Kind> inline constexpr std::nullptr_t kinds_of = nullptr;

template <class Kind>
concept TableKind = requires {
    kinds_of<Kind>.size();
};

template <TableKind Kind>
inline constexpr auto names_of<Kind> = [] {
    std::array<std::string_view, kinds_of<Kind>.size()> names{};
    std::ranges::transform(kinds_of<Kind>, names.begin(), [](const auto& row) { return row.name; });
    return names;
}();

template <TableKind Kind> constexpr const auto& row_of(Kind kind) {
    return kinds_of<Kind>.at(static_cast<std::size_t>(kind));
}

/// The kind that is called so; a name that is in no row does not compile.
template <TableKind Kind> consteval Kind kind_called(std::string_view name) {
    const auto found = std::ranges::find(names_of<Kind>, name);
    return found != names_of<Kind>.end() ? static_cast<Kind>(found - names_of<Kind>.begin())
                                         : throw std::invalid_argument("there is no such kind");
}

/// Each kind, in the order of the table.
template <TableKind Kind>
inline constexpr auto all_kinds = [] {
    std::array<Kind, kinds_of<Kind>.size()> kinds{};
    for (std::size_t i = 0; i < kinds.size(); ++i)
        kinds[i] = static_cast<Kind>(i);
    return kinds;
}();

/// What `make` gives for each kind, in the order of the table: for_each_kind<Kind>([]<Kind kind> { … }).
template <TableKind Kind, class Make> auto for_each_kind(Make make) {
    return [&]<std::size_t... i>(std::index_sequence<i...>) {
        return std::array{make.template operator()<static_cast<Kind>(i)>()...};
    }
    (std::make_index_sequence<kinds_of<Kind>.size()>());
}

} // namespace overt
