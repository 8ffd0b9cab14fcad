#include "render/stimulus/frame_key.h"

#include "experiment/spectra/metal_table.h"
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
    const auto& [id, title, kind, metal, roughness, coat_ior, coat_absorbance, coat_thickness, coat_bump,
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

ContentHash hash_of_surroundings(const LightSettings& light) {
    const auto& [probe, exposure, rotation_deg] = light;
    ContentHasher hasher;
    hasher.add(std::string_view(light.is_file() ? hash_of_file(probe) : probe)).add(rotation_deg);
    // The overcast sky is as it always was, and no path is aimed in it.
    if (probe == "gallery")
        hasher.add(gallery_probe_version);
    if (probe != "overcast")
        hasher.add(aimed_paths_version);
    if (light.is_file())
        hasher.add(probe_file_version);
    return hasher.finish();
}

ContentHash traced_key(const Object& object, const MaterialSettings& material,
                       const ContentHash& surroundings, double exposure, const BakeSettings& settings,
                       StandardObserver observer) {
    ContentHasher hasher;
    // The silhouette follows the maps.
    hasher.add(std::string_view("traced")).add(frame_baker_version).add(coordinate_pass_version);
    hasher.add(std::string_view(object.mesh_hash)).add(std::string_view(surroundings));
    add_to(hasher, object.scene);
    add_to(hasher, material);
    add_to(hasher, settings);
    hasher.add(settings.target_error_de > 0.0 ? exposure : 0.0).add(static_cast<int>(observer));
    return hasher.finish();
}

ContentHash live_key(const Object& object, const MaterialSettings& material, const ContentHash& surroundings,
                     double exposure) {
    ContentHasher hasher;
    hasher.add(std::string_view("live")).add(stimulus_renderer_version);
    hasher.add(std::string_view(object.mesh_hash)).add(std::string_view(surroundings)).add(exposure);
    add_to(hasher, object.scene);
    add_to(hasher, material);
    return hasher.finish();
}

ContentHash map_key(const Object& object) {
    ContentHasher hasher;
    hasher.add(std::string_view(object.mesh_hash)).add(coordinate_pass_version);
    add_to(hasher, object.scene);
    return hasher.finish();
}

} // namespace overt
