#include "app/stimuli/head_outline.h"

#include <cmath>
#include <fmt/format.h>

namespace overt {

HeadOutline::HeadOutline(double first_radius, std::optional<PartRegion> given)
    : first_radius_(first_radius), given_(std::move(given)) {}

void HeadOutline::pick(glm::dvec3 point) {
    if (points_.empty())
        factor_ = 1.0;
    if (points_.size() == 3)
        points_.pop_back();
    points_.push_back(point);
}

void HeadOutline::take_back() {
    if (points_.empty())
        given_.reset();
    else
        points_.pop_back();
}

std::optional<PartRegion> HeadOutline::region() const {
    if (points_.empty()) {
        std::optional<PartRegion> given = given_;
        for (std::size_t i = 0; given && i < given->spheres.size(); ++i)
            given->spheres[i].w *= factor_;
        return given;
    }
    const bool has_both_sides = points_.size() >= 2;
    const glm::dvec3 middle = has_both_sides ? 0.5 * (points_[0] + points_[1]) : points_[0];
    const double radius = has_both_sides ? glm::distance(points_[0], middle) : first_radius_;
    PartRegion head{"head", {glm::dvec4(middle, factor_ * radius)}, {}};
    if (points_.size() == 3 && points_[2] != middle)
        head.half_spaces.push_back({points_[2], glm::normalize(middle - points_[2])});
    return head;
}

PartRegion transformed(const PartRegion& region, const glm::dmat3& turn, double scale, glm::dvec3 move) {
    PartRegion result{region.name, {}, {}};
    for (const glm::dvec4& sphere : region.spheres)
        result.spheres.emplace_back(scale * (turn * glm::dvec3(sphere)) + move, scale * sphere.w);
    for (const HalfSpace& space : region.half_spaces)
        result.half_spaces.push_back({scale * (turn * space.point) + move, turn * space.normal});
    return result;
}

std::string head_key(const PartRegion& region) {
    int digits = 6;
    if (!region.spheres.empty()) {
        const glm::dvec4 sphere = region.spheres.front();
        const double far = glm::length(glm::dvec3(sphere)) / sphere.w;
        digits += far > 10.0 ? static_cast<int>(std::log10(far)) : 0;
    }
    const auto number = [&](double value) {
        const std::string text = fmt::format("{:.{}g}", value, digits);
        return text == "-0" ? std::string("0") : text;
    };
    const auto list = [&](const glm::dvec3& v) {
        return fmt::format("{}, {}, {}", number(v.x), number(v.y), number(v.z));
    };
    std::string spheres, planes;
    for (const glm::dvec4& sphere : region.spheres)
        spheres += fmt::format("{}[{}, {}]", spheres.empty() ? "" : ", ", list(glm::dvec3(sphere)),
                               number(sphere.w));
    for (const HalfSpace& space : region.half_spaces)
        planes +=
            fmt::format("{}[[{}], [{}]]", planes.empty() ? "" : ", ", list(space.point), list(space.normal));
    std::string keys;
    if (!spheres.empty())
        keys = fmt::format("spheres = [{}]", spheres);
    if (!planes.empty())
        keys += fmt::format("{}planes = [{}]", keys.empty() ? "" : ", ", planes);
    return fmt::format("head = {{ {} }}", keys);
}

} // namespace overt
