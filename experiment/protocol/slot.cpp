#include "experiment/protocol/slot.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "experiment/protocol/protocol.h"

namespace overt {

namespace {

/// The places of one entry, relative to its middle: to the right and up, in degrees.
std::vector<glm::dvec2> places_of(const SlotSettings& entry) {
    std::vector<glm::dvec2> places;
    for (int i = 0; i < entry.circle; ++i) {
        const double turn = 2.0 * std::numbers::pi * i / entry.circle;
        places.push_back(entry.radius_deg * glm::dvec2(std::sin(turn), std::cos(turn)));
    }
    if (entry.grid.size() == 2) {
        const auto columns = static_cast<int>(entry.grid[0]), rows = static_cast<int>(entry.grid[1]);
        for (int row = 0; row < rows; ++row)
            for (int column = 0; column < columns; ++column)
                places.push_back(entry.distance_deg *
                                 glm::dvec2(column - 0.5 * (columns - 1), 0.5 * (rows - 1) - row));
    }
    return places;
}

} // namespace

std::vector<Slot> written_out(const std::vector<SlotSettings>& entries) {
    std::vector<Slot> slots;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const SlotSettings& entry = entries[i];
        const std::string& title = entry.title.empty() ? entry.id : entry.title;
        Slot slot{entry.id,
                  title,
                  entry.right_deg,
                  entry.up_deg,
                  entry.size_deg ? entry.size_deg : entry.width_deg,
                  entry.size_deg ? entry.size_deg : entry.height_deg,
                  static_cast<int>(i)};
        const std::vector<glm::dvec2> places = places_of(entry);
        if (places.empty())
            slots.push_back(slot);
        for (std::size_t place = 0; place < places.size(); ++place) {
            slot.id = fmt::format("{}-{}", entry.id, place + 1);
            slot.title = fmt::format("{} {}", title, place + 1);
            slot.right_deg = entry.right_deg.value_or(0.0) + places[place].x;
            slot.up_deg = entry.up_deg.value_or(0.0) + places[place].y;
            slots.push_back(slot);
        }
    }
    if (slots.empty())
        slots.push_back({"centre", "centre", {}, {}, {}, {}, -1});
    return slots;
}

ScreenGeometry slot_geometry(const Protocol& protocol, const Slot& slot) {
    ScreenGeometry geometry = screen_geometry_of(protocol);
    if (slot.entry < 0)
        return geometry;
    const glm::dvec2 px_per_mm = glm::dvec2(geometry.screen_px) / geometry.screen_mm;
    const auto px_of = [&](double deg, int axis) {
        return std::tan(to_radians({deg}).value) * geometry.viewing_distance_mm * px_per_mm[axis];
    };
    const glm::dvec2 own_middle = glm::dvec2(geometry.image_origin_px) + 0.5 * glm::dvec2(geometry.image_px);
    const auto place = [&](std::optional<double> middle_px, std::optional<double> size_deg, int axis) {
        const int step = axis == 0 ? 2 : 1;
        if (size_deg)
            geometry.image_px[axis] = std::max(
                step, step * static_cast<int>(std::lround(2.0 * px_of(0.5 * *size_deg, axis) / step)));
        geometry.image_origin_px[axis] =
            step * static_cast<int>(std::lround(
                       (middle_px.value_or(own_middle[axis]) - 0.5 * geometry.image_px[axis]) / step));
    };
    std::optional<double> column, row;
    if (slot.right_deg)
        column = geometry.centre().x_px + px_of(*slot.right_deg, 0);
    if (slot.up_deg)
        row = geometry.centre().y_px - px_of(*slot.up_deg, 1);
    place(column, slot.width_deg, 0);
    place(row, slot.height_deg, 1);
    return geometry;
}

std::vector<ImageBox> slot_places(const Protocol& protocol) {
    std::vector<ImageBox> places;
    for (const Slot& slot : protocol.slots)
        if (slot.entry >= 0)
            places.push_back(slot_geometry(protocol, slot).image_box());
    return places;
}

namespace {

ViewSettings at_size(ViewSettings view, glm::ivec2 size_px, const DisplaySettings& display) {
    if (size_px == glm::ivec2(view.width_px, view.height_px))
        return view;
    if (view.camera_position && !view.vertical_fov_deg) {
        const double height_mm = view.height_px * display.height_mm / display.height_px;
        view.vertical_fov_deg =
            to_degrees({2.0 * std::atan(0.5 * height_mm / display.viewing_distance_mm)}).value;
    }
    view.width_px = size_px.x;
    view.height_px = size_px.y;
    return view;
}

} // namespace

void fit_views_to_slots(Protocol& protocol) {
    if (protocol.slots.front().entry < 0)
        return; // the only slot is made of the view
    std::vector<glm::ivec2> sizes_px;
    for (Slot& slot : protocol.slots) {
        const glm::ivec2 size_px = slot_geometry(protocol, slot).image_px;
        const auto known = std::ranges::find(sizes_px, size_px);
        slot.size = static_cast<int>(known - sizes_px.begin());
        if (known == sizes_px.end())
            sizes_px.push_back(size_px);
    }
    for (std::size_t size = 1; size < sizes_px.size(); ++size)
        for (const ViewSettings& view : protocol.views)
            protocol.views_in_slots.push_back(at_size(view, sizes_px[size], protocol.display));
    for (ViewSettings& view : protocol.views)
        view = at_size(view, sizes_px.front(), protocol.display);
}

ScreenPoint middle_of_slot(const Protocol& protocol, int slot) {
    const ScreenGeometry at = slot_geometry(protocol, protocol.slots.at(static_cast<std::size_t>(slot)));
    return at.screen_from_image(0.5 * glm::dvec2(at.image_px));
}

std::vector<int> slots_of_task(const Protocol& protocol, int task) {
    const std::vector<std::string>& named = protocol.tasks.at(static_cast<std::size_t>(task)).slots;
    return named.empty() ? std::vector<int>{0} : slots_named(protocol, named);
}

std::vector<int> slots_named(const Protocol& protocol, const std::vector<std::string>& named) {
    std::vector<int> slots;
    for (const std::string& name : named) {
        for (std::size_t i = 0; i < protocol.slots.size(); ++i) {
            const Slot& slot = protocol.slots[i];
            const bool is_of_entry =
                slot.entry >= 0 && protocol.slot_entries[static_cast<std::size_t>(slot.entry)].id == name;
            if (slot.id == name || is_of_entry)
                slots.push_back(static_cast<int>(i));
        }
    }
    return slots;
}

} // namespace overt
