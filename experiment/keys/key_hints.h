/// What to do about a key that stands where there is none of its name.
#pragma once

#include <string>
#include <string_view>

#include "experiment/keys/key_table.h"

namespace overt {

/// Of a key before the first heading: the headings below which there is one of its name.
std::string hint_for_stray_key(const KeyTable& table, std::string_view key);

/// Of a key that the section, or the table within one, has not: the nearest that it has, or else where this
/// very key is at home.
std::string hint_for_unknown_key(const KeyTable& table, std::string_view key, const Section& section);

} // namespace overt
