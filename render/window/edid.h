/// What a monitor tells of itself over its cable: Extended Display Identification Data (VESA E-EDID Standard,
/// release A2, 2006).
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace overt {

/// Of the base block, in which the name stands.
inline constexpr std::size_t edid_block_bytes = 128;

/// The monitor's name, of at most 13 characters of ASCII. Empty if `edid` does not begin with a base block,
/// or if that has no name.
std::string product_name_of(std::span<const std::byte> edid);

} // namespace overt
