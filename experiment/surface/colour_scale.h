/// Colours for values on surfaces and in figures.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace overt {

/// 256 colours from the lowest value to the highest, in sRGB as a screen takes them.
using ColourTable = std::array<std::array<std::uint8_t, 3>, 256>;

enum class ColourMap : std::uint8_t {
    viridis, ///< for densities: even steps of lightness, also for colour-blind readers
    cividis, ///< the same, made for readers who see no difference of red and green
    coolwarm ///< for differences: blue below 0, red above, light grey at 0
};

/// From the published tables in assets/colour_maps.
const ColourTable& colour_table(ColourMap map);
std::string_view name_of(ColourMap map);

/// For what an observer could never see; no colour map has it.
inline constexpr std::array<std::uint8_t, 3> never_visible{150, 150, 150};

} // namespace overt
