/// For each pixel of an image, the nearest of a set of pixels: the exact Euclidean distance transform.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

namespace overt {

/// By pixel, top row first; {-1, -1} everywhere if the set is empty. Distances are between pixel centres; of
/// pixels at the same distance the one in the column farthest to the left. `in_set` has one flag for each
/// pixel, 0 or not. Linear in the number of pixels. After Meijster, Roerdink and Hesselink, "A general
/// algorithm for computing distance transforms in linear time", 2000. Sizes up to 16,384.
std::vector<glm::i16vec2> nearest_pixels(const std::vector<std::uint8_t>& in_set, glm::ivec2 size_px);

/// The place of a pixel's square that is nearest to a point.
inline glm::dvec2 nearest_place_of(glm::ivec2 pixel, glm::dvec2 point_px) {
    return glm::clamp(point_px, glm::dvec2(pixel), glm::dvec2(pixel + 1));
}

} // namespace overt
