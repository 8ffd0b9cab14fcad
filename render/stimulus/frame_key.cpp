#include "render/stimulus/frame_key.h"

#include "experiment/spectra/metal_table.h"
#include "render/bake/frame_baker.h"
#include "render/bake/glass.h"
#include "render/bake/light_sources.h"
#include "render/bake/medium.h"
#include "render/bake/own_surface.h"
#include "render/bake/thin_film.h"
#include "render/image/gallery_probe.h"
#include "render/stimulus/stimulus_renderer.h"

namespace overt {

namespace {

struct ConvertsToAll {
    template <class T> operator T() const;
};

/// How many values a struct is made of; its base counts as one. Structs with a base cannot be taken apart.
template <class Whole, class... Values> constexpr int value_count() {
    if constexpr (requires { Whole{Values{}..., ConvertsToAll{}}; })
        return value_count<Whole, Values..., ConvertsToAll>();
    else
        return static_cast<int>(sizeof...(Values));
}

} // namespace

void add_to(ContentHasher& hasher, const SceneView& scene) {
    // The bounds are the mesh's.
    const auto& [camera, image_px] = scene.view;
    const auto& [position, target, fov, aside] = camera;
    for (const glm::dvec3& vector : {position, target})
        hasher.add(vector.x).add(vector.y).add(vector.z);
    hasher.add(fov.value).add(image_px.x).add(image_px.y);
    // What one eye sees keeps its names.
    if (aside != 0.0)
        hasher.add(std::string_view("aside")).add(aside);
}

void add_to(ContentHasher& hasher, const MaterialSettings& material) {
    static_assert(value_count<MaterialSettings>() == 31, "what was added counts here, or is of no light");
    const MaterialSettings& m = material;
    hasher.add(static_cast<int>(m.kind))
        .add(std::string_view(is_metal_file(m.metal) ? hash_of_file(m.metal) : m.metal));
    for (const double number :
         {m.given_roughness(), m.coat_ior, m.coat_thickness, m.coat_bump, m.coat_bump_width})
        hasher.add(number);
    for (const double number : m.coat_absorbance)
        hasher.add(number);
    hasher.add(m.coat_seed);
    const glm::dvec3 reflectance = m.given_reflectance();
    hasher.add(reflectance.x).add(reflectance.y).add(reflectance.z);
    // Frames that were there before these keys keep their names.
    if (m.multiple_scattering)
        hasher.add(std::string_view("multiple scattering")).add(layered_surface_version);
    if (row_of(m.kind).has_key("ior")) {
        hasher.add(layered_surface_version).add(static_cast<int>(m.roughness_as));
        hasher.add(static_cast<int>(m.body));
        for (const double number : {m.ior, m.given_metallic(), m.clear_coat, m.clear_coat_roughness})
            hasher.add(number);
    }
    if (m.is_own())
        hasher.add(std::string_view("of the file")).add(static_cast<int>(m.base)).add(own_surface_version);
    if (m.is_of_file())
        hasher.add(std::string_view(m.has_own_bumps() ? "its bumps" : "no bumps"));
    if (m.kind == MaterialKind::own) {
        for (const bool is_given :
             {m.reflectance.has_value(), m.metallic.has_value(), m.roughness.has_value()})
            hasher.add(is_given ? 1 : 0);
        for (const std::string& name : m.of)
            hasher.add(std::string_view(name));
    }
    if (row_of(m.kind).has_key("film_nm") && m.film_nm)
        hasher.add(std::string_view("film")).add(thin_film_version).add(*m.film_nm).add(m.film_ior);
    if (m.kind == MaterialKind::rough_conductor && m.clear_coat > 0.0)
        hasher.add(std::string_view("clear coat"))
            .add(layered_surface_version)
            .add(m.clear_coat)
            .add(m.clear_coat_roughness);
    if (m.kind == MaterialKind::rough_conductor && m.anisotropy > 0.0)
        hasher.add(std::string_view("brushed")).add(m.anisotropy).add(static_cast<int>(m.brushed));
    if (m.kind == MaterialKind::glass) {
        hasher.add(glass_version).add(m.roughness.has_value() ? 1 : 0).add(m.abbe.value_or(0.0));
        for (const double number : m.absorbance)
            hasher.add(number);
    }
    if (m.kind == MaterialKind::translucent) {
        hasher.add(medium_version).add(glass_version).add(m.roughness.has_value() ? 1 : 0);
        for (const auto& coefficients : {m.scattering_per_mm, m.absorption_per_mm})
            for (const double number : coefficients)
                hasher.add(number);
        hasher.add(m.scattering_anisotropy).add(m.density);
    }
}

void add_to(ContentHasher& hasher, const BakeSettings& settings) {
    const auto& [samples, target_error_de, filter, filter_width_px, pixel_step, seed, threads] = settings;
    hasher.add(samples).add(target_error_de).add(static_cast<int>(filter)).add(filter_width_px);
    hasher.add(pixel_step).add(seed);
}

Surroundings::Surroundings(const LightSettings& settings)
    : light(settings), content(settings.is_file() ? hash_of_file(settings.probe) : settings.probe) {
    for (const LightSettings& part : settings.parts)
        parts.emplace_back(part);
}

namespace {

void add_to(ContentHasher& hasher, const LampSettings& lamp) {
    const auto& [id, shape, cd_m2, colour, position, faces, width, height, radius] = lamp;
    hasher.add(static_cast<int>(shape)).add(cd_m2.value_or(0.0)).add(width).add(height).add(radius);
    for (const double number : colour)
        hasher.add(number);
    for (const glm::dvec3& place : {position.value_or(glm::dvec3(0.0)), faces.value_or(glm::dvec3(0.0))})
        hasher.add(place.x).add(place.y).add(place.z);
}

} // namespace

ContentHash hash_of_surroundings(const Surroundings& surroundings, Degrees turn) {
    const LightSettings& light = surroundings.light;
    static_assert(value_count<LightSettings>() == 14, "what was added counts here, or is the exposure");
    ContentHasher hasher;
    if (!surroundings.parts.empty()) {
        hasher.add(std::string_view("sum"));
        for (std::size_t i = 0; i < surroundings.parts.size(); ++i)
            hasher.add(light.sum[i].second)
                .add(std::string_view(hash_of_surroundings(surroundings.parts[i], turn)));
        return hasher.finish();
    }
    hasher.add(std::string_view(surroundings.content)).add(light.rotation_deg + turn.value);
    // The overcast sky is as it always was, and no path is aimed in it.
    if (light.probe == "gallery")
        hasher.add(gallery_probe_version);
    if (light.probe != "overcast")
        hasher.add(aimed_paths_version);
    if (light.is_file())
        hasher.add(probe_file_version);
    if (!light.has_sources())
        return hasher.finish(); // as there were lights before there were sun and lamps
    hasher.add(std::string_view("sources")).add(light_sources_version).add(light.unit_cd_m2.value_or(1.0));
    hasher.add(light.sun_lux.value_or(0.0)).add(light.sun_azimuth_deg).add(light.sun_elevation_deg);
    hasher.add(light.sun_radius_deg);
    for (const double number : light.sun_colour)
        hasher.add(number);
    for (const LampSettings& lamp : light.shining)
        add_to(hasher, lamp);
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
    if (material.is_of_file())
        hasher.add(std::string_view(object.appearance_hash));
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
    if (material.is_of_file())
        hasher.add(std::string_view(object.appearance_hash));
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
