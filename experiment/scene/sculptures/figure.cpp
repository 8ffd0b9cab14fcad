#include "experiment/scene/sculptures/figure.h"

namespace overt {

Clay Figure::whole() const {
    Clay whole;
    whole.add(body, 1.0);
    whole.add(head, neck_blend_mm);
    whole.add(plinth, plinth_blend_mm);
    return whole;
}

PartIndex Figure::part_at(const glm::dvec3& point) const {
    const double to_body = body.distance(point);
    const double to_head = head.distance(point);
    if (plinth.distance(point) < std::min(to_body, to_head))
        return 2;
    return to_head < to_body && glm::dot(point - mid_neck, neck_axis) > 0.0 ? 0 : 1;
}

} // namespace overt
