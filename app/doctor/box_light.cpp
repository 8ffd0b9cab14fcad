#include "app/doctor/box_light.h"

#include <algorithm>

namespace overt {

BoxLightSensor::BoxLightSensor(std::unique_ptr<ThreadedButtonBox> box, BoxWords& words)
    : box_(std::move(box)), words_(words) {
    words_.description = box_->description();
    box_->begin();
}

void BoxLightSensor::take() {
    for (ButtonChange change; box_->poll(change);) {
        if (change.is_turn())
            continue;
        edges_.push_back({change.at, change.is_down});
        words_.worst_uncertainty = std::max(words_.worst_uncertainty, change.uncertainty);
    }
    words_.is_lost = words_.is_lost || box_->lost();
}

std::vector<LightEdge> BoxLightSensor::edges() {
    take();
    // Two buttons of one box, and boxes that stamp by themselves, may be told out of order.
    std::ranges::stable_sort(edges_, {}, &LightEdge::at);
    return edges_;
}

} // namespace overt
