#include "experiment/protocol/stereo.h"

#include "experiment/protocol/protocol.h"

namespace overt {

ImageBox field_of(const Protocol& protocol, Eye eye) {
    const glm::ivec2 screen_px(protocol.display.width_px, protocol.display.height_px);
    if (protocol.stereo.kind != StereoKind::mirrors)
        return {{0, 0}, screen_px};
    const glm::ivec2 half_px(screen_px.x / 2, screen_px.y);
    const bool is_left_half = (eye == Eye::left) != protocol.stereo.swapped;
    return {{is_left_half ? 0 : screen_px.x - half_px.x, 0}, half_px};
}

ScreenGeometry whole_screen_of(const Protocol& protocol) {
    ScreenGeometry geometry = screen_geometry_of(protocol);
    geometry.screen_px = {protocol.display.width_px, protocol.display.height_px};
    geometry.screen_mm = {protocol.display.width_mm, protocol.display.height_mm};
    return geometry;
}

DisplaySettings display_of_field(const Protocol& protocol) {
    const ScreenGeometry field = screen_geometry_of(protocol);
    DisplaySettings display = protocol.display;
    display.width_px = field.screen_px.x;
    display.height_px = field.screen_px.y;
    display.width_mm = field.screen_mm.x;
    display.height_mm = field.screen_mm.y;
    return display;
}

glm::dvec2 in_field(const Protocol& protocol, glm::dvec2 from_middle_px) {
    const StereoSettings& stereo = protocol.stereo;
    if (stereo.kind != StereoKind::mirrors)
        return from_middle_px;
    const glm::dvec2 on_screen =
        from_middle_px + 0.5 * glm::dvec2(protocol.display.width_px, protocol.display.height_px);
    const ImageBox left = field_of(protocol, Eye::left);
    const bool is_left = on_screen.x >= left.origin_px.x && on_screen.x < left.origin_px.x + left.size_px.x;
    const Eye eye = is_left ? Eye::left : Eye::right;
    const ImageBox field = field_of(protocol, eye);
    glm::dvec2 from_field = on_screen - glm::dvec2(field.origin_px) - 0.5 * glm::dvec2(field.size_px) -
                            glm::dvec2(stereo.shift_px(eye));
    if (stereo.mirrored)
        from_field.x = -from_field.x;
    return from_field;
}

double aside_mm(const StereoSettings& stereo, Eye eye) {
    return !stereo.is_on() ? 0.0 : (eye == Eye::left ? -0.5 : 0.5) * stereo.interocular_mm;
}

void add_views_of_eyes(Protocol& protocol) {
    if (!protocol.stereo.is_on())
        return;
    const auto count = static_cast<int>(protocol.views_at_all_sizes());
    std::vector<ViewSettings> of_right;
    for (int view = 0; view < count; ++view) {
        of_right.push_back(protocol.view_at(view));
        if (of_right.back().two_eyes)
            of_right.back().aside_mm = aside_mm(protocol.stereo, Eye::right);
    }
    for (std::vector<ViewSettings>* const views : {&protocol.views, &protocol.views_in_slots})
        for (ViewSettings& view : *views)
            view.aside_mm = view.two_eyes ? aside_mm(protocol.stereo, Eye::left) : 0.0;
    protocol.views_in_slots.insert(protocol.views_in_slots.end(), of_right.begin(), of_right.end());
}

} // namespace overt
