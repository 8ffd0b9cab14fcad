/// The screen in front of the observer: where the stimulus stands on it, and angles between its points.
#pragma once

#include <glm/glm.hpp>

#include "experiment/units.h"

namespace overt {

/// Where an image stands on the screen, pixel for pixel.
struct ImageBox {
    glm::ivec2 origin_px{0}, size_px{0}; ///< its top left pixel
    friend bool operator==(const ImageBox&, const ImageBox&) = default;
};

/// A flat screen seen perpendicularly from the middle.
struct ScreenGeometry {
    glm::ivec2 screen_px{1920, 1080};
    glm::dvec2 screen_mm{698.4, 392.9};
    double viewing_distance_mm = 1750.0;
    glm::ivec2 image_origin_px{448, 28}; ///< top left pixel of the stimulus on the screen
    glm::ivec2 image_px{1024, 1024};     ///< the stimulus is shown 1:1

    /// True visual angle between two points of the screen, by the directions from the eye: 2 atan(size / 2 /
    /// distance) for points symmetric about the middle, without linearisation.
    Degrees angle_between(ScreenPoint a, ScreenPoint b) const;

    /// Pixels per degree at the middle of the screen, horizontally.
    double px_per_deg_at_centre() const;

    ImageBox image_box() const { return {image_origin_px, image_px}; }
    ScreenPoint centre() const { return {0.5 * screen_px.x, 0.5 * screen_px.y}; }

    /// Angles from the middle of the screen to the middle of the image, to the right and up.
    glm::dvec2 middle_deg() const;

    glm::dvec2 image_from_screen(ScreenPoint point) const {
        return {point.x_px - image_origin_px.x, point.y_px - image_origin_px.y};
    }
    ScreenPoint screen_from_image(glm::dvec2 point) const {
        return {point.x + image_origin_px.x, point.y + image_origin_px.y};
    }
    bool is_inside_image(glm::dvec2 point) const {
        return point.x >= 0.0 && point.y >= 0.0 && point.x < image_px.x && point.y < image_px.y;
    }
};

/// Top left pixel of an image centred on a screen. The column is even: the pixel pairs of Color++ count from
/// the left edge.
glm::ivec2 centred_origin_px(glm::ivec2 screen_px, glm::ivec2 image_px);

} // namespace overt
