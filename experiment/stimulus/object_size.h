/// How large an object is, and how large it is seen.
#pragma once

#include <optional>
#include <string>

#include "experiment/stimulus/object.h"

namespace overt {

struct ObjectSize {
    glm::dvec3 object{0.0};    ///< width, depth and height of its box as it stands, in `unit`
    std::string unit;          ///< unit_of_lengths()
    glm::dvec2 shown_mm{0.0};  ///< width and height on the screen, turned to the front
    glm::dvec2 shown_deg{0.0}; ///< the same as visual angles, by the directions from the eye
};

/// In the first view. Only for an object with a mesh.
ObjectSize size_of(const Object& object, const ObjectSettings& settings, const Protocol& protocol);

/// What is hardly meant so, and what may be.
struct SizeDoubt {
    std::string message, hint;
};

/// Heights of an object's own, mm, beyond which its unit is doubted: a figurine and a large statue; where
/// the protocol writes the unit, only beyond the wider bounds.
inline constexpr double smallest_likely_mm = 50.0, largest_likely_mm = 3000.0;
inline constexpr double smallest_stated_mm = 2.0, largest_stated_mm = 20000.0;
/// Visual angles of the height or width, beyond which the screen or the distance is doubted: a tracker's
/// error, and what is seen without turning the head.
inline constexpr double smallest_likely_deg = 0.2, largest_likely_deg = 60.0;

/// `unit_is_written`: the protocol says of which unit the mesh file is.
std::optional<SizeDoubt> doubt_of_size(const ObjectSize& size, bool unit_is_written);

} // namespace overt
