/// Spaces of linear red, green and blue, by the colours of their primaries and of their white.
#pragma once

#include <glm/glm.hpp>

namespace overt {

/// CIE 1931 x, y of light in one channel alone, and of equal light in all three.
struct RgbPrimaries {
    glm::dvec2 red, green, blue, white;
};

/// ITU-R BT.709-6, with white D65.
inline constexpr RgbPrimaries rec709_primaries{
    {0.640, 0.330}, {0.300, 0.600}, {0.150, 0.060}, {0.3127, 0.3290}};

/// Whether they span a space: y above 0, not on one line, and white inside.
bool are_primaries(const RgbPrimaries& primaries);

/// The XYZ of light, of which white, 1 in all channels, has Y = 1. For what are_primaries().
glm::dmat3 xyz_from_rgb(const RgbPrimaries& primaries);

/// Linear Rec. 709 light that looks, beside its own white, as light of these primaries beside theirs: white
/// stays white. Adapted by the Bradford cone responses (Lam 1985; ICC.1:2010, annex E).
glm::dmat3 rec709_from(const RgbPrimaries& primaries);

} // namespace overt
