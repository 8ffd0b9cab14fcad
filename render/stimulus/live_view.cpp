#include "render/stimulus/live_view.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/colour/display_colour.h"
#include "experiment/protocol/all_stimuli.h"
#include "render/image/text_layout.h"

namespace overt {

namespace {

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

LiveView::LiveView(const GlContext& context, const Protocol& protocol, std::span<const Object> objects,
                   glm::ivec2 image_px)
    : context_(&context), protocol_(&protocol), objects_(objects), image_px_(image_px),
      label_grey_(protocol.display.background > 0.3 ? 0.0f : 0.6f) {}

void LiveView::choose(const Stimulus& stimulus) {
    const Object& object = objects_[static_cast<std::size_t>(stimulus.object)];
    if (!object.has_mesh())
        throw InputError(fmt::format("object \"{}\" has no mesh to be turned", object.id));
    if (stimulus.object != stimulus_.object) {
        buffers_.reset();
        buffers_.emplace(*context_, object.mesh, openness_of_vertices(object.mesh));
    }
    const bool is_lit_otherwise = stimulus.light != stimulus_.light;
    if (is_lit_otherwise)
        renderer_.emplace(*context_, protocol_->light_of(stimulus), image_px_);
    const MaterialSettings& material = protocol_->material_of(stimulus);
    const bool is_of_object = material.is_own() && object.appearance;
    if (is_lit_otherwise || stimulus.material != stimulus_.material ||
        (is_of_object && stimulus.object != stimulus_.object))
        set_material(material, object, is_of_object);
    stimulus_ = stimulus;
    TextStyle style;
    style.line_height_px = std::max(12, image_px_.y / 36);
    style.wrap_width_px = image_px_.x;
    style.background = static_cast<float>(protocol_->display.background);
    style.grey = label_grey_;
    style.centred = false;
    label_ = draw_text("Live preview, approximate: " + stimulus_name(*protocol_, stimulus), style);
}

void LiveView::set_material(const MaterialSettings& material, const Object& object, bool is_of_object) {
    if (!is_of_object) {
        renderer_->set_material(material);
        painted_.reset();
        return;
    }
    std::optional<PaintedSurface> painted;
    painted.emplace(*context_, object.mesh, *buffers_, *object.appearance, material);
    painted_ = std::move(painted);
    renderer_->set_painted(*painted_);
}

LinearImage LiveView::draw(const Orbit& orbit, const Pose& pose) {
    OVERT_EXPECTS(buffers_.has_value());
    SceneView scene = objects_[static_cast<std::size_t>(stimulus_.object)].scene(stimulus_.view);
    scene.view.image_px = image_px_;
    Pose turned = pose;
    turned.object.angle.value += orbit.turn_deg;
    LinearImage picture = renderer_->draw(*buffers_, seen_from(scene, orbit), turned);
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
