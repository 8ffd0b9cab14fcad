/// Colours of the world into a display's linear light, and back.
#pragma once

#include <array>
#include <cstdint>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "experiment/colour/display_characterisation.h"

namespace overt {

/// A display seen in one colour space. Linear light is 0 … 1 in red, green and blue, from the display's black
/// to its white; what lies outside of it the display cannot show.
class DisplayColour {
  public:
    /// Throws InputError for another space than CIE 1931 XYZ where the characterisation has no spectra: three
    /// numbers of one observer do not tell those of another.
    DisplayColour(const DisplayCharacterisation& display, ColourSpace space);

    /// Light that, black included, has these values: XYZ in cd/m2, or cone excitations in W/(sr m2).
    glm::dvec3 rgb_of(const glm::dvec3& tristimulus) const { return from_ * (tristimulus - black_); }

    /// The light for a spectrum's radiance in W/(sr m2 nm).
    glm::dvec3 rgb_of(const SampledSpectrum& radiance) const {
        return rgb_of(tristimulus_of(radiance, space_));
    }

    glm::dvec3 tristimulus_of_rgb(const glm::dvec3& rgb) const { return black_ + to_ * rgb; }

    const glm::dvec3& black() const { return black_; }

  private:
    ColourSpace space_;
    glm::dvec3 black_{0.0};
    glm::dmat3 to_{1.0}, from_{1.0};
};

/// What turns linear Rec. 709 light (ITU-R BT.709-6: its primaries, white D65), of which 1 in all channels
/// has the luminance that the display's white adds to its black, into the display's linear light of the same
/// colour. The display's black is there in any case and is not taken off.
glm::dmat3 display_from_rec709(const DisplayCharacterisation& display);

/// How many colours a display cannot show, by channel. A billionth of white outside is inside.
struct GamutCount {
    std::int64_t colours = 0, outside = 0;
    std::array<std::int64_t, 3> below{}, above{};

    /// Counts one; true if the display can show it.
    bool add(const glm::dvec3& rgb);
};

} // namespace overt
