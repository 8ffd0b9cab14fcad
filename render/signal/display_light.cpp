#include "render/signal/display_light.h"

#include "experiment/base/error.h"
#include "experiment/colour/display_colour.h"

namespace overt {

namespace {

/// Columns: XYZ of red, green and blue; Rec. 709's by its primaries and white (ITU-R BT.709-6).
const glm::dmat3& xyz_from_rec709() {
    static const glm::dmat3 matrix = [] {
        DisplayCharacterisation unit;
        // With XYZ itself for primaries, a display's light is XYZ, white having Y = 1.
        for (int i = 0; i < 3; ++i)
            unit.primaries_xyz[static_cast<std::size_t>(i)][i] = 1.0;
        return display_from_rec709(unit);
    }();
    return matrix;
}

glm::dmat3 display_from_xyz_f(const DisplayCharacterisation& display) {
    const DisplayColour colour(display, ColourSpace::cie2006_xyz);
    const double white = colour.tristimulus_of_rgb(glm::dvec3(1.0)).y - colour.black().y;
    glm::dmat3 matrix;
    // The black is there in any case and is not taken off.
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 one(0.0);
        one[axis] = white;
        matrix[axis] = colour.rgb_of(colour.black() + one);
    }
    return matrix;
}

} // namespace

glm::dmat3 display_from(PictureColours colours, const DisplaySettings& display) {
    const auto& light = display.characterisation;
    switch (colours) {
    case PictureColours::display:
        return glm::dmat3(1.0);
    case PictureColours::rec709:
        return light ? display_from_rec709(*light) : glm::dmat3(1.0);
    case PictureColours::cie1931_xyz:
        return display_from(PictureColours::rec709, display) * glm::inverse(xyz_from_rec709());
    case PictureColours::cie2006_xyz:
        return display_from_xyz_f(light ? *light : DisplayCharacterisation{});
    }
    return glm::dmat3(1.0);
}

glm::dmat3 xyz_from(PictureColours colours) {
    OVERT_EXPECTS(colours != PictureColours::display);
    return colours == PictureColours::rec709 ? xyz_from_rec709() : glm::dmat3(1.0);
}

PictureColours colours_of(const FrameSequenceSettings& sequence) {
    switch (sequence.colour_space) {
    case FrameColours::display:
        return PictureColours::display;
    case FrameColours::rec709:
        return PictureColours::rec709;
    case FrameColours::xyz:
        return PictureColours::cie1931_xyz;
    }
    return PictureColours::display;
}

PictureColours rendered_colours(StandardObserver observer) {
    return observer == StandardObserver::cie2006 ? PictureColours::cie2006_xyz : PictureColours::rec709;
}

void transform(LinearImage& picture, const glm::dmat3& matrix) {
    if (matrix == glm::dmat3(1.0))
        return;
    const glm::mat3 by(matrix);
    for (glm::vec4& pixel : picture.pixels)
        pixel = glm::vec4(by * glm::vec3(pixel), pixel.w);
}

} // namespace overt
