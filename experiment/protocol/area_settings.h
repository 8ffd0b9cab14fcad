/// Where an area of an object's surface is, as a protocol says.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace overt {

/// An entry of `areas = { NAME = { … } }` in [[object]], or `head = { … }`, in the coordinates of the file:
/// what lies in any sphere, box or group, and on the positive side of all planes.
struct AreaSettings {
    std::string name;
    std::vector<std::array<double, 4>> spheres;   ///< x, y, z, radius
    std::vector<std::array<glm::dvec3, 2>> boxes; ///< corners with the smallest and largest coordinates
    std::vector<std::string> groups;              ///< parts that the mesh file, or `labels`, names
    std::vector<std::array<double, 6>> planes;    ///< point and normal
    /// Of a flat picture, in its pixels from its top left corner: left, top, right, bottom; and the x, y and
    /// radius of discs. Boxes and spheres are made of them when the protocol is complete.
    std::vector<std::array<double, 4>> rectangles = {};
    std::vector<std::array<double, 3>> discs = {};

    bool operator==(const AreaSettings&) const = default;
};

} // namespace overt
