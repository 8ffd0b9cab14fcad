#include "render/presenter/setup_screens.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/image/stored_values.h"
#include "render/image/text_layout.h"

namespace overt {

namespace {

constexpr double camera_height = 0.7, camera_width = 0.9;

int to_even(double value) { return 2 * static_cast<int>(std::lround(0.5 * value)); }

void put_cross(InkCanvas& canvas, glm::dvec2 at, double arm, bool oblique, double line_px) {
    const double along = oblique ? arm / std::numbers::sqrt2 : arm;
    const glm::dvec2 first = oblique ? glm::dvec2(along, along) : glm::dvec2(along, 0.0),
                     second = oblique ? glm::dvec2(along, -along) : glm::dvec2(0.0, along);
    canvas.line(at - first, at + first, 1.0, line_px);
    canvas.line(at - second, at + second, 1.0, line_px);
}

float linear_of(std::byte value) {
    return linear_from_srgb(static_cast<float>(std::to_integer<int>(value)) / 255.0f);
}

} // namespace

PlacedPicture draw_target(const Screen& screen, const ScreenGeometry& geometry, float grey,
                          float background) {
    PlacedPicture placed;
    placed.picture = draw_fixation_target(screen.target_diameter.value * geometry.px_per_deg_at_centre(),
                                          grey, background);
    const ScreenPoint place = screen.target_place.value_or(geometry.centre());
    const glm::ivec2 size = placed.picture.size_px;
    placed.origin_px =
        glm::clamp(glm::ivec2(to_even(place.x_px - 0.5 * size.x), to_even(place.y_px - 0.5 * size.y)),
                   glm::ivec2(0), (geometry.screen_px - size) / 2 * 2);
    return placed;
}

void put_validation(InkCanvas& canvas, const ValidationLayout& layout) {
    const double line = std::max(1.5, layout.ring_px / 6.0);
    if (layout.screen.width > 0.0)
        canvas.outline(layout.screen, 0.25, std::max(1.0, 0.5 * line), 2.0 * line);
    for (const ValidationLayout::Mark& mark : layout.marks) {
        canvas.ring(mark.target_px, layout.ring_px, 0.6, line);
        if (!mark.gaze_px)
            continue;
        canvas.line(mark.target_px, *mark.gaze_px, 0.6, line);
        // What was measured beyond the screen ends at its edge, without a cross.
        if (mark.gaze_is_inside)
            put_cross(canvas, *mark.gaze_px, layout.arm_px, mark.eye == Eye::left, line);
    }
    for (const PlacedText& error : layout.errors)
        put_text(canvas, error.text, error.style, error.origin_px, 0.9);
    if (!layout.words.text.empty())
        put_text(canvas, layout.words.text, layout.words.style, layout.words.origin_px);
}

void put_camera(LinearImage& onto, const Screen& screen, float grey) {
    const CameraImage& camera = screen.camera;
    const glm::ivec2 from(camera.width_px, camera.height_px);
    if (from.x <= 0 || from.y <= 0 ||
        camera.rgba.size() < 4 * static_cast<std::size_t>(from.x) * static_cast<std::size_t>(from.y))
        return;
    const double scale =
        std::min(camera_height * onto.size_px.y / from.y, camera_width * onto.size_px.x / from.x);
    const glm::ivec2 size(static_cast<int>(scale * from.x), static_cast<int>(scale * from.y));
    const glm::ivec2 origin = (onto.size_px - size) / 2;
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) {
            const auto source_x = static_cast<std::size_t>(std::min(from.x - 1, static_cast<int>(x / scale))),
                       source_y = static_cast<std::size_t>(std::min(from.y - 1, static_cast<int>(y / scale)));
            const std::byte* const pixel =
                &camera.rgba[4 * (source_y * static_cast<std::size_t>(from.x) + source_x)];
            onto.at(origin.x + x, origin.y + y) = glm::vec4(
                grey * glm::vec3(linear_of(pixel[0]), linear_of(pixel[1]), linear_of(pixel[2])), 1.0f);
        }
    }
    write_on(onto, screen.text,
             {onto.size_px.x / 2, origin.y + size.y + (onto.size_px.y - origin.y - size.y) / 2});
}

} // namespace overt
