/// The kinds of material. What the renderers make of each is in render/bake/material_model.h.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

namespace overt {

/// The number of a kind is in the keys of all its frames in the cache: new ones come last.
enum class MaterialKind : std::uint8_t {
    smooth_conductor,
    rough_conductor,
    coated_conductor,
    diffuse,
    plastic,
    metallic_roughness,
    own,
    glass,
    translucent,
};

struct MaterialKindRow {
    MaterialKind kind;
    std::string_view name;  ///< in a protocol
    std::string_view looks; ///< like what: "polished metal"
    /// The keys of [[material]] that make a difference to it, besides id, title and kind; empty behind the
    /// last.
    std::array<std::string_view, 12> keys;

    constexpr bool has_key(std::string_view key) const { return std::ranges::find(keys, key) != keys.end(); }
};

/// All kinds, in the order of MaterialKind.
inline constexpr auto material_kinds = std::to_array<MaterialKindRow>({
    {MaterialKind::smooth_conductor,
     "smooth-conductor",
     "polished metal",
     {"metal", "film_nm", "film_ior", "bumps"}},
    {MaterialKind::rough_conductor,
     "rough-conductor",
     "brushed metal",
     {"metal", "roughness", "anisotropy", "brushed", "multiple_scattering", "clear_coat",
      "clear_coat_roughness", "film_nm", "film_ior", "bumps"}},
    {MaterialKind::coated_conductor,
     "coated-conductor",
     "polished metal under a bumpy coloured coat",
     {"metal", "coat_ior", "coat_absorbance", "coat_thickness", "coat_bump", "coat_bump_width", "coat_seed"}},
    {MaterialKind::diffuse, "diffuse", "a matt surface", {"reflectance", "base", "bumps"}},
    {MaterialKind::plastic,
     "plastic",
     "a matt body under a clear surface, polished or rough",
     {"reflectance", "roughness", "roughness_as", "ior", "body", "clear_coat", "clear_coat_roughness", "base",
      "bumps"}},
    {MaterialKind::metallic_roughness,
     "metallic-roughness",
     "what other programs call metallic-roughness",
     {"reflectance", "roughness", "ior", "metallic", "clear_coat", "clear_coat_roughness", "base", "bumps"}},
    {MaterialKind::own,
     "own",
     "what the object's file says: its colours, pictures, metals and bumps",
     {"reflectance", "roughness", "ior", "metallic", "clear_coat", "clear_coat_roughness", "of", "bumps"}},
    {MaterialKind::glass,
     "glass",
     "glass, polished or rough, clear or coloured",
     {"ior", "roughness", "roughness_as", "abbe", "absorbance"}},
    {MaterialKind::translucent,
     "translucent",
     "a body that light goes into, is scattered in and leaves at other places, as wax, marble and skin",
     {"ior", "roughness", "roughness_as", "scattering_per_mm", "absorption_per_mm", "scattering_anisotropy",
      "density"}},
});

constexpr const MaterialKindRow& row_of(MaterialKind kind) {
    return material_kinds[static_cast<std::size_t>(kind)];
}

static_assert([] {
    for (std::size_t i = 0; i < material_kinds.size(); ++i) {
        if (material_kinds[i].kind != static_cast<MaterialKind>(i))
            return false;
    }
    return true;
}());

constexpr std::string_view name_of(MaterialKind kind) { return row_of(kind).name; }

} // namespace overt
