#include "experiment/stimulus/object_size.h"

#include <algorithm>

#include <fmt/format.h>

namespace overt {
namespace {

/// A unit that would make a likely height of one in millimetres; empty if none would.
std::string likely_unit(double height_mm) {
    for (const char* const unit : {"m", "cm", "in"}) {
        const double height = height_mm * mm_of_unit(unit);
        if (height >= 2.0 * smallest_likely_mm && height <= largest_likely_mm)
            return fmt::format("unit = \"{}\" would make it {:.0f} mm; ", unit, height);
    }
    return {};
}

} // namespace

ObjectSize size_of(const Object& object, const ObjectSettings& settings, const Protocol& protocol) {
    ObjectSize size;
    size.object = object.scene().bounds.extent();
    size.unit = unit_of_lengths(settings);
    const View& view = object.scene().view;
    const glm::dmat4 world_from_object = object.scene().pose_at({0.0}).world_from_object();
    glm::dvec2 low(view.image_px), high(0.0);
    for (const glm::vec3& position : object.mesh->positions) {
        const glm::dvec3 world(world_from_object * glm::dvec4(position, 1.0));
        if (view.depth_of(world) <= 0.0)
            continue;
        const glm::dvec2 place = view.project(world);
        low = glm::min(low, place);
        high = glm::max(high, place);
    }
    // No more is shown than the image has room for.
    low = glm::clamp(low, glm::dvec2(0.0), glm::dvec2(view.image_px));
    high = glm::max(low, glm::clamp(high, glm::dvec2(0.0), glm::dvec2(view.image_px)));
    const ScreenGeometry geometry = screen_geometry_of(protocol);
    size.shown_mm = (high - low) * geometry.screen_mm / glm::dvec2(geometry.screen_px);
    const glm::dvec2 middle = 0.5 * (low + high);
    const auto point = [&](double x, double y) { return geometry.screen_from_image({x, y}); };
    size.shown_deg = {geometry.angle_between(point(low.x, middle.y), point(high.x, middle.y)).value,
                      geometry.angle_between(point(middle.x, low.y), point(middle.x, high.y)).value};
    return size;
}

std::optional<SizeDoubt> doubt_of_size(const ObjectSize& size, bool unit_is_written) {
    const double height = size.object.z;
    const double smallest = unit_is_written ? smallest_stated_mm : smallest_likely_mm,
                 largest = unit_is_written ? largest_stated_mm : largest_likely_mm;
    if (size.unit == "mm" && height < smallest)
        return SizeDoubt{
            fmt::format("it is {:.3g} mm high, less than {} mm, which few objects are", height, smallest),
            fmt::format("{}unit says what the mesh file's numbers are, scale multiplies them",
                        unit_is_written ? "" : likely_unit(height))};
    if (size.unit == "mm" && height > largest)
        return SizeDoubt{
            fmt::format("it is {:.6g} mm high, more than {:.0f} mm, which few objects are", height, largest),
            fmt::format("scale = {:g} would make it {:.3g} mm; unit says what the mesh file's numbers are",
                        height > 1000.0 * largest_likely_mm ? 1e-6 : 1e-3,
                        height * (height > 1000.0 * largest_likely_mm ? 1e-6 : 1e-3))};
    const double least_deg = std::min(size.shown_deg.x, size.shown_deg.y),
                 most_deg = std::max(size.shown_deg.x, size.shown_deg.y);
    if (least_deg < smallest_likely_deg)
        return SizeDoubt{
            fmt::format("it is seen under {:.2g} deg only, less than a tracker can tell apart", least_deg),
            "make the image of [view] larger, or correct the screen's size and distance in [display]"};
    if (most_deg > largest_likely_deg)
        return SizeDoubt{
            fmt::format("it is seen under {:.0f} deg, more than is seen without turning the head", most_deg),
            "make the image of [view] smaller, or correct the screen's size and distance in [display]"};
    return std::nullopt;
}

} // namespace overt
