/// What to do about a key that stands where there is none of its name.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace overt {

/// Of a key before the first heading: the headings below which there is one of its name.
std::string hint_for_stray_key(std::string_view key);

/// Of a key in a section that has only `names`: the nearest of them, or else where this very key is at home.
std::string hint_for_unknown_key(std::string_view key, std::string_view section,
                                 std::span<const std::string_view> names);

} // namespace overt
