/// A whole sculpture before it is contoured.
#pragma once

#include "experiment/scene/mesh.h"
#include "experiment/scene/sculptures/clay.h"
#include "experiment/scene/sculptures/contouring.h"

namespace overt {

/// The sculpture's three parts, which make it up together, and what tells them apart.
struct Figure {
    Clay head;   ///< with hair, beard and the whole neck
    Clay body;   ///< trunk, limbs and garments
    Clay plinth; ///< with what stands on it: a rock, a support
    double neck_blend_mm = 6.0;
    double plinth_blend_mm = 1.5;
    glm::dvec3 mid_neck{0.0}; ///< the head begins here, in the direction of neck_axis
    glm::dvec3 neck_axis{0.0, 0.0, 1.0};
    double cell_factor = 1.0; ///< on the size of the grid cells; below 1 for fine folds
    Fovea fovea;              ///< face and hair
    Bounds box_mm;            ///< holds the whole sculpture

    /// All of it as one solid.
    Clay whole() const;
    /// 0 for the head, 1 for the body, 2 for the plinth: the number of the part nearest to `point`.
    PartIndex part_at(const glm::dvec3& point) const;
};

} // namespace overt
