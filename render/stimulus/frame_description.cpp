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

/// The value of a key of a material, as its file has it; empty where the key is left out and nothing stands
/// in its place.
std::string text_of(const Key& key, const MaterialSettings& material) {
    const bool has_usual = material.kind != MaterialKind::own && material.kind != MaterialKind::glass &&
                           material.kind != MaterialKind::translucent;
    if (key.rule.name == "roughness")
        return material.roughness || has_usual ? fmt::format("{}", material.given_roughness()) : "";
    if (key.rule.name == "metallic")
        return material.metallic || has_usual ? fmt::format("{}", material.given_metallic()) : "";
    if (key.rule.name == "reflectance") {
        const glm::dvec3 of = material.given_reflectance();
        return material.reflectance || has_usual ? fmt::format("[{}, {}, {}]", of.x, of.y, of.z) : "";
    }
    if (key.rule.name == "bumps") // frames without describe themselves as they did before the key
        return material.has_own_bumps() ? "own" : "";
    if ((key.rule.name == "film_ior" && !material.film_nm) ||
        ((key.rule.name == "anisotropy" || key.rule.name == "brushed") && !(material.anisotropy > 0.0)) ||
        (key.rule.name.starts_with("clear_coat") && !(material.clear_coat > 0.0) &&
         (material.kind == MaterialKind::plastic || material.kind == MaterialKind::rough_conductor)))
        return ""; // likewise
    if (key.rule.name == "of")
        return fmt::format("{}", fmt::join(material.of, " "));
    if (const auto* number = key.get_if<std::optional<double>>(&material))
        return *number ? fmt::format("{}", **number) : "";
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
        if (name == "base" && !material.is_own())
            continue; // frames describe themselves as they did before the key
        for (const Key& key : protocol_keys().section("material").keys) {
            if (const std::string value = key.rule.name == name ? text_of(key, material) : ""; !value.empty())
                text += fmt::format(", {} = {}", name, value);
        }
    }
    return text;
}

/// What a light is, as frames say it: the name of its probe, or what is added up.
std::string name_of_light(const LightSettings& light) {
    std::string sum;
    for (const auto& [id, share] : light.sum)
        sum += fmt::format("{}{} x {}", sum.empty() ? "" : " + ", share, id);
    return light.sum.empty() ? light.probe : sum;
}

/// Its sun and lamps, as their keys have them.
std::string text_of_sources(const LightSettings& light) {
    std::string text = fmt::format("unit {} cd/m2", light.unit_cd_m2.value_or(1.0));
    if (light.sun_lux)
        text += fmt::format("; sun {} lx, azimuth {} deg, elevation {} deg, radius {} deg, colour {}",
                            *light.sun_lux, light.sun_azimuth_deg, light.sun_elevation_deg,
                            light.sun_radius_deg, fmt::join(light.sun_colour, " "));
    for (const LampSettings& lamp : light.shining) {
        const glm::dvec3 none(0.0);
        text += fmt::format("; {} {} {} cd/m2, colour {}, at {}", name_of(lamp.shape), lamp.id,
                            lamp.cd_m2.value_or(0.0), fmt::join(lamp.colour, " "),
                            text_of(lamp.position.value_or(none)));
        if (lamp.shape != LampShape::sphere)
            text += fmt::format(", faces {}", text_of(lamp.faces.value_or(none)));
        text += lamp.shape == LampShape::rectangle ? fmt::format(", {} x {}", lamp.width, lamp.height)
                                                   : fmt::format(", radius {}", lamp.radius);
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
        {"overt:light", name_of_light(light)},
        {"overt:light_rotation_deg", fmt::format("{}", light.rotation_deg + pose.light.value)}};
    if (camera.aside != 0.0)
        words.emplace_back("overt:camera_aside", fmt::format("{}", camera.aside));
    if (light.has_sources())
        words.emplace_back("overt:light_sources", text_of_sources(light));
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
