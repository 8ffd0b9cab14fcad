#include "render/stimulus/frame_key.h"

#include "experiment/scene/metal_table.h"
#include "render/bake/frame_baker.h"
#include "render/image/gallery_probe.h"
#include "render/stimulus/stimulus_renderer.h"

namespace overt {

void add_to(ContentHasher& hasher, const SceneView& scene) {
    // The bounds are the mesh's.
    const auto& [camera, image_px] = scene.view;
    const auto& [position, target, fov] = camera;
    for (const glm::dvec3& vector : {position, target})
        hasher.add(vector.x).add(vector.y).add(vector.z);
    hasher.add(fov.value).add(image_px.x).add(image_px.y);
}

void add_to(ContentHasher& hasher, const MaterialSettings& material) {
    const auto& [entry, kind, metal, roughness, coat_ior, coat_absorbance, coat_thickness, coat_bump,
                 coat_bump_width, coat_seed, reflectance] = material;
    hasher.add(static_cast<int>(kind))
        .add(std::string_view(is_metal_file(metal) ? hash_of_file(metal) : metal));
    for (const double number : {roughness, coat_ior, coat_thickness, coat_bump, coat_bump_width})
        hasher.add(number);
    for (const double number : coat_absorbance)
        hasher.add(number);
    hasher.add(coat_seed);
    for (const double number : reflectance)
        hasher.add(number);
}

void add_to(ContentHasher& hasher, const BakeSettings& settings) {
    const auto& [samples, target_error_de, filter, filter_width_px, pixel_step, seed, threads] = settings;
    hasher.add(samples).add(target_error_de).add(static_cast<int>(filter)).add(filter_width_px);
    hasher.add(pixel_step).add(seed);
}

Surroundings::Surroundings(const LightSettings& settings)
    : light(settings), content(settings.is_file() ? hash_of_file(settings.probe) : settings.probe) {}

ContentHash hash_of_surroundings(const Surroundings& surroundings, Degrees turn) {
    const LightSettings& light = surroundings.light;
    const auto& [entry, probe, exposure, rotation_deg] = light;
    ContentHasher hasher;
    hasher.add(std::string_view(surroundings.content)).add(rotation_deg + turn.value);
    // The overcast sky is as it always was, and no path is aimed in it.
    if (probe == "gallery")
        hasher.add(gallery_probe_version);
    if (probe != "overcast")
        hasher.add(aimed_paths_version);
    if (light.is_file())
        hasher.add(probe_file_version);
    return hasher.finish();
}

ContentHash traced_key(const Object& object, int view, const MaterialSettings& material,
                       const ContentHash& surroundings, double exposure, const BakeSettings& settings,
                       StandardObserver observer) {
    ContentHasher hasher;
    // The silhouette follows the maps.
    hasher.add(std::string_view("traced")).add(frame_baker_version).add(coordinate_pass_version);
    hasher.add(std::string_view(object.mesh_hash)).add(std::string_view(surroundings));
    add_to(hasher, object.scene(view));
    add_to(hasher, material);
    add_to(hasher, settings);
    hasher.add(settings.target_error_de > 0.0 ? exposure : 0.0).add(static_cast<int>(observer));
    return hasher.finish();
}

ContentHash live_key(const Object& object, int view, const MaterialSettings& material,
                     const ContentHash& surroundings, Degrees turn, double exposure) {
    ContentHasher hasher;
    hasher.add(std::string_view("live")).add(stimulus_renderer_version);
    hasher.add(std::string_view(object.mesh_hash)).add(std::string_view(surroundings)).add(exposure);
    add_to(hasher, object.scene(view));
    add_to(hasher, material);
    // The same pictures as ever where the light does not move.
    if (turn.value != 0.0)
        hasher.add(turn.value);
    return hasher.finish();
}

ContentHash map_key(const Object& object, int view) {
    ContentHasher hasher;
    hasher.add(std::string_view(object.mesh_hash)).add(coordinate_pass_version);
    add_to(hasher, object.scene(view));
    return hasher.finish();
}

} // namespace overt
