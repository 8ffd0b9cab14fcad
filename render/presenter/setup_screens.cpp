#include "render/presenter/setup_screens.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "render/image/stored_values.h"
#include "render/image/text_layout.h"

namespace overt {

namespace {

constexpr double ring_of_letters = 0.8, cross_of_letters = 0.35;
/// Of the screen's height: where the text of a validation ends, above the keys.
constexpr double text_ends = 0.9;
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

void put_validation(InkCanvas& canvas, const Screen& screen, const TextStyle& letters) {
    const double em = letters.line_height_px, line = std::max(1.5, em / 14.0);
    TextStyle small = letters;
    small.line_height_px = std::max(8, static_cast<int>(0.7 * em));
    for (const ValidatedTarget& target : screen.validated) {
        const glm::dvec2 at(target.target.x_px, target.target.y_px);
        canvas.ring(at, 0.5 * ring_of_letters * em, 0.6, line);
        const bool is_left = target.eye == Eye::left;
        std::string label = "–";
        if (target.gaze) {
            const glm::dvec2 gaze(target.gaze->x_px, target.gaze->y_px);
            canvas.line(at, gaze, 0.6, line);
            put_cross(canvas, gaze, cross_of_letters * em, is_left, line);
            label = fmt::format("{:.2f}°", target.error.value);
        }
        const glm::ivec2 size = measure_text(label, small).size_px;
        // Of two eyes, the left one's stands left.
        const double left = is_left ? at.x - ring_of_letters * em - size.x : at.x + ring_of_letters * em;
        const glm::ivec2 origin =
            glm::clamp(glm::ivec2(static_cast<int>(left), static_cast<int>(at.y - 0.5 * size.y)),
                       glm::ivec2(0), canvas.size_px() - size);
        put_text(canvas, label, small, origin, 0.9);
    }
    const glm::ivec2 size = measure_text(screen.text, letters).size_px;
    put_text(canvas, screen.text, letters,
             {(canvas.size_px().x - size.x) / 2, static_cast<int>(text_ends * canvas.size_px().y) - size.y});
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
