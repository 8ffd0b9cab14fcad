#include "experiment/colour/display_colour.h"

#include <fmt/format.h>
#include <glm/matrix.hpp>

#include "experiment/base/error.h"
#include "experiment/colour/rgb_primaries.h"

namespace overt {

DisplayColour::DisplayColour(const DisplayCharacterisation& display, ColourSpace space) : space_(space) {
    std::array<glm::dvec3, 3> primaries = display.primaries_xyz;
    black_ = display.black_xyz;
    if (space != ColourSpace::cie1931_xyz) {
        if (!display.spectra) {
            throw InputError(fmt::format("the characterisation of \"{}\" has no spectra of its primaries, "
                                         "and without them nobody knows "
                                         "its {}: measure them, and name the table with [light] spectra.",
                                         display.display, name_of(space)));
        }
        for (std::size_t i = 0; i < 3; ++i)
            primaries[i] = tristimulus_of(display.spectra->channels[i], space);
        black_ = tristimulus_of(display.spectra->black, space);
    }
    if (independence_of(primaries) < least_independence)
        throw InputError(
            fmt::format("the primaries of \"{}\" lie in one plane of {}: no light has an inverse.",
                        display.display, name_of(space)));
    to_ = primary_matrix(primaries);
    from_ = glm::inverse(to_);
}

glm::dmat3 display_from_rec709(const DisplayCharacterisation& display) {
    const auto of_chromaticity = [](glm::dvec2 xy) {
        return glm::dvec3(xy.x / xy.y, 1.0, (1.0 - xy.x - xy.y) / xy.y);
    };
    const auto& [red, green, blue, white_point] = rec709_primaries;
    const glm::dmat3 primaries(of_chromaticity(red), of_chromaticity(green), of_chromaticity(blue));
    const glm::dvec3 luminances = glm::inverse(primaries) * of_chromaticity(white_point);
    const glm::dmat3 xyz_from_rec709(luminances.x * primaries[0], luminances.y * primaries[1],
                                     luminances.z * primaries[2]);
    const double white = display.luminance_of(1.0) - display.luminance_of(0.0);
    return glm::inverse(primary_matrix(display.primaries_xyz)) * (white * xyz_from_rec709);
}

bool GamutCount::add(const glm::dvec3& rgb) {
    constexpr double slack = 1e-9;
    bool inside = true;
    for (int channel = 0; channel < 3; ++channel) {
        const auto i = static_cast<std::size_t>(channel);
        const bool is_below = !(rgb[channel] >= -slack), is_above = rgb[channel] > 1.0 + slack;
        below[i] += is_below;
        above[i] += is_above;
        inside = inside && !is_below && !is_above;
    }
    ++colours;
    outside += !inside;
    return inside;
}

} // namespace overt
