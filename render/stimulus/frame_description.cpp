#include "render/stimulus/frame_description.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/error.h"
#include "experiment/protocol/keys/protocol_keys.h"
#include "render/bake/frame_baker.h"
#include "render/stimulus/cached_frame.h"

namespace overt {

namespace {

std::string text_of(glm::dvec3 vector) { return fmt::format("{} {} {}", vector.x, vector.y, vector.z); }

/// The value of a key of a material, as its file has it.
std::string text_of(const Key& key, const MaterialSettings& material) {
    if (const auto* text = key.get_if<std::string>(&material))
        return *text;
    if (const auto* number = key.get_if<double>(&material))
        return fmt::format("{}", *number);
    if (const auto* whole = key.get_if<int>(&material))
        return fmt::format("{}", *whole);
    if (const auto* numbers = key.get_if<std::array<double, 3>>(&material))
        return fmt::format("[{}]", fmt::join(*numbers, ", "));
    OVERT_EXPECTS(key.type->written != nullptr); // no key of a material can be left out
    return key.type->written(key.rule, key.place.in(&material));
}

/// Its kind, and the keys that make a difference to it.
std::string text_of(const MaterialSettings& material) {
    const MaterialKindRow& row = row_of(material.kind);
    std::string text = fmt::format("kind = {}", row.name);
    for (const std::string_view name : row.keys) {
        if (name == "base" && !material.is_of_file())
            continue; // frames describe themselves as they did before the key
        for (const Key& key : protocol_keys().section("material").keys) {
            if (key.rule.name == name)
                text += fmt::format(", {} = {}", name, text_of(key, material));
        }
    }
    return text;
}

} // namespace

ImageAttributes describe_stimulus(const Protocol& protocol, std::span<const Object> objects,
                                  const Stimulus& stimulus, const Pose& pose) {
    const Object& object = objects[static_cast<std::size_t>(stimulus.object)];
    const MaterialSettings& material = protocol.material_of(stimulus);
    const LightSettings& light = protocol.light_of(stimulus);
    const Camera& camera = object.scene(stimulus.view).view.camera;
    ImageAttributes words{
        {"overt:protocol", protocol.name},
        {"overt:object", object.id},
        {"overt:mesh_sha256", object.mesh_hash},
        {"overt:material", material.id},
        {"overt:material_settings", text_of(material)},
        {"overt:angle_deg", fmt::format("{}", pose.object.angle.value)},
        {"overt:camera_position", text_of(camera.position)},
        {"overt:camera_target", text_of(camera.target)},
        {"overt:camera_vertical_fov_deg", fmt::format("{}", camera.vertical_fov.value)},
        {"overt:light", light.probe},
        {"overt:light_rotation_deg", fmt::format("{}", light.rotation_deg + pose.light.value)}};
    if (material.is_of_file() && object.appearance)
        words.emplace_back("overt:surface_sha256", object.appearance_hash);
    if (!pose.object.is_turn())
        words.emplace_back(move_attribute, text_of_move(pose.object));
    return words;
}

ImageAttributes describe_tracing(const FrameQuality& quality, const Protocol& protocol,
                                 MaterialKind material) {
    const BakeSettings settings = bake_settings(quality, protocol.bake, material);
    ImageAttributes attributes{{"overt:renderer", fmt::format("path tracer {}", frame_baker_version)},
                               {"overt:quality", std::string(name_of(quality.level))},
                               {"overt:samples", fmt::format("{}", settings.samples)},
                               {"overt:pixel_step", fmt::format("{}", settings.pixel_step)},
                               {"overt:filter", std::string(name_of(settings.filter))},
                               {"overt:filter_width_px", fmt::format("{}", settings.filter_width_px)},
                               {"overt:seed", fmt::format("{}", settings.seed)},
                               {"overt:observer", std::string(name_of(protocol.bake.observer))}};
    if (settings.target_error_de > 0.0)
        attributes.emplace_back("overt:target_error_de", fmt::format("{}", settings.target_error_de));
    return attributes;
}

} // namespace overt
