#include "render/stimulus/live_view.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/colour/display_colour.h"
#include "render/image/text_layout.h"

namespace overt {

namespace {

constexpr double deg_per_px = 0.5;
constexpr double zoom_per_step = 0.9;

/// Just outside of the cylinder and height that the turning object sweeps.
constexpr double least_clearance = 1.02;

void put_over(LinearImage& picture, const LinearImage& text, float grey, glm::ivec2 origin) {
    const glm::ivec2 end = glm::min(picture.size_px - origin, text.size_px);
    for (int y = 0; y < end.y; ++y) {
        for (int x = 0; x < end.x; ++x) {
            const float letters = text.at(x, y).w;
            glm::vec4& under = picture.at(origin.x + x, origin.y + y);
            under = (1.0f - letters) * under + letters * glm::vec4(glm::vec3(grey), 1.0f);
        }
    }
}

} // namespace

void Orbit::drag(glm::dvec2 by_px) {
    turn_deg = std::remainder(turn_deg + deg_per_px * by_px.x, 360.0);
    elevation_deg = std::clamp(elevation_deg + deg_per_px * by_px.y, -85.0, 85.0);
}

void Orbit::zoom(double steps) {
    distance = std::clamp(distance * std::pow(zoom_per_step, steps), 0.1, 10.0);
}

SceneView seen_from(const SceneView& scene, const Orbit& orbit) {
    SceneView seen = scene;
    Camera& camera = seen.view.camera;
    const glm::dvec3 away = camera.position - camera.target;
    const double level = std::hypot(away.x, away.y);
    const double elevation =
        std::clamp(std::atan2(away.z, level) + to_radians(Degrees{orbit.elevation_deg}).value, -1.5, 1.5);
    const glm::dvec2 heading = level > 0.0 ? glm::dvec2(away) / level : glm::dvec2(0.0, -1.0);
    const glm::dvec3 half = 0.5 * (scene.bounds.max - scene.bounds.min);
    const double distance =
        std::max(orbit.distance * glm::length(away),
                 least_clearance * glm::length(half) + glm::length(camera.target - scene.bounds.centre()));
    camera.position =
        camera.target + distance * glm::dvec3(std::cos(elevation) * heading, std::sin(elevation));
    return seen;
}

LiveView::LiveView(const GlContext& context, const Protocol& protocol, std::span<const Sculpture> sculptures,
                   glm::ivec2 image_px)
    : context_(&context), protocol_(&protocol), sculptures_(sculptures), image_px_(image_px),
      renderer_(context, protocol.light, image_px),
      label_grey_(protocol.display.background > 0.3 ? 0.0f : 0.6f) {}

void LiveView::choose(const Condition& stimulus) {
    const Sculpture& sculpture = sculptures_[static_cast<std::size_t>(stimulus.sculpture)];
    const MaterialSettings& material = protocol_->materials[static_cast<std::size_t>(stimulus.material)];
    if (!sculpture.has_mesh())
        throw InputError(fmt::format("sculpture \"{}\" has no mesh to be turned", sculpture.id));
    if (stimulus.sculpture != stimulus_.sculpture) {
        buffers_.reset();
        buffers_.emplace(*context_, sculpture.mesh, openness_of_vertices(sculpture.mesh));
    }
    if (stimulus.material != stimulus_.material)
        renderer_.set_material(material);
    stimulus_ = stimulus;
    TextStyle style;
    style.line_height_px = std::max(12, image_px_.y / 36);
    style.wrap_width_px = image_px_.x;
    style.background = static_cast<float>(protocol_->display.background);
    style.grey = label_grey_;
    style.centred = false;
    label_ = draw_text(fmt::format("Live preview, approximate: {}/{}", sculpture.id, material.id), style);
}

LinearImage LiveView::draw(const Orbit& orbit) {
    OVERT_EXPECTS(buffers_.has_value());
    SceneView scene = sculptures_[static_cast<std::size_t>(stimulus_.sculpture)].scene;
    scene.view.image_px = image_px_;
    LinearImage picture = renderer_.draw(*buffers_, seen_from(scene, orbit), Degrees{orbit.turn_deg});
    const glm::mat3 to_display = protocol_->display.characterisation
                                     ? glm::mat3(display_from_rec709(*protocol_->display.characterisation))
                                     : glm::mat3(1.0f);
    const auto background = static_cast<float>(protocol_->display.background);
    for (glm::vec4& pixel : picture.pixels)
        pixel = glm::vec4(to_display * glm::vec3(pixel) + (1.0f - pixel.w) * background, 1.0f);
    put_over(picture, label_, label_grey_, glm::ivec2(label_.size_px.y / 2));
    return picture;
}

} // namespace overt
