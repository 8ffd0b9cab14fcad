#include "experiment/scene/surface_appearance.h"

#include <algorithm>
#include <cmath>

#include "experiment/base/error.h"

namespace overt {

namespace {

const std::array<float, 256>& srgb_table() {
    static const std::array<float, 256> table = [] {
        std::array<float, 256> light{};
        for (std::size_t code = 0; code < light.size(); ++code) {
            const double share = static_cast<double>(code) / 255.0;
            light[code] =
                static_cast<float>(share <= 0.04045 ? share / 12.92 : std::pow((share + 0.055) / 1.055, 2.4));
        }
        return light;
    }();
    return table;
}

/// Where in a row or column of `size` texels a place lies that may be outside.
int inside(std::int64_t place, int size, PictureEdge edge) {
    switch (edge) {
    case PictureEdge::clamp:
        return static_cast<int>(std::clamp<std::int64_t>(place, 0, size - 1));
    case PictureEdge::repeat:
        return static_cast<int>(((place % size) + size) % size);
    case PictureEdge::mirror:
        break;
    }
    const std::int64_t there_and_back = ((place % (2 * size)) + 2 * size) % (2 * size);
    return static_cast<int>(there_and_back < size ? there_and_back : 2 * size - 1 - there_and_back);
}

/// What the look-ups mix of a texel: a colour's linear light, codes as shares, its alpha three times, or the
/// normal that it codes.
enum class TexelValue : std::uint8_t { srgb, linear, alpha, normal };

/// -1 … 1 (glTF 2.0: 2 c / 255 - 1). None is between two codes: either stands for it, or what is flat in the
/// program that made it would lean by 0.3 degrees.
float slope_of(std::uint8_t code) {
    return code == 127 || code == 128 ? 0.0f : 2.0f * static_cast<float>(code) / 255.0f - 1.0f;
}

glm::vec3 value_of(const glm::u8vec4& texel, TexelValue which) {
    if (which == TexelValue::alpha)
        return glm::vec3(static_cast<float>(texel.w) / 255.0f);
    if (which == TexelValue::normal)
        return {slope_of(texel.x), slope_of(texel.y), slope_of(texel.z)};
    if (which == TexelValue::linear)
        return glm::vec3(texel.x, texel.y, texel.z) / 255.0f;
    const std::array<float, 256>& table = srgb_table();
    return {table[texel.x], table[texel.y], table[texel.z]};
}

glm::vec3 picture_at(const SurfacePicture& picture, const SurfacePlacement& placed, glm::dvec2 uv,
                     TexelValue which) {
    // So far out that no texel could be told: numbers that a file may hold, but no place.
    constexpr double farthest = 1e9;
    const glm::dvec2 place = glm::clamp(placed.place_of(uv), glm::dvec2(-farthest), glm::dvec2(farthest)) *
                             glm::dvec2(picture.size_px);
    const auto texel = [&](std::int64_t x, std::int64_t y) {
        const auto column = static_cast<std::size_t>(inside(x, picture.size_px.x, placed.across));
        const auto row = static_cast<std::size_t>(inside(y, picture.size_px.y, placed.down));
        return value_of(picture.texels[row * static_cast<std::size_t>(picture.size_px.x) + column], which);
    };
    if (placed.is_nearest)
        return texel(static_cast<std::int64_t>(std::floor(place.x)),
                     static_cast<std::int64_t>(std::floor(place.y)));
    const glm::dvec2 from_middle = place - 0.5, first = glm::floor(from_middle);
    const glm::vec2 share(from_middle - first);
    const auto x = static_cast<std::int64_t>(first.x), y = static_cast<std::int64_t>(first.y);
    return glm::mix(glm::mix(texel(x, y), texel(x + 1, y), share.x),
                    glm::mix(texel(x, y + 1), texel(x + 1, y + 1), share.x), share.y);
}

template <class Value> Value between(const std::array<Value, 3>& corners, glm::vec2 place) {
    return (1.0f - place.x - place.y) * corners[0] + place.x * corners[1] + place.y * corners[2];
}

glm::vec3 placed_value(const SurfaceAppearance& appearance, const SurfacePlacement& placed,
                       std::uint32_t triangle, glm::vec2 place, TexelValue which) {
    const std::vector<CornerUvs>& uvs = appearance.uvs[static_cast<std::size_t>(placed.uv_set)];
    const glm::dvec2 uv = uvs.empty() ? glm::dvec2(0.0) : glm::dvec2(between(uvs[triangle], place));
    return picture_at(*appearance.pictures[static_cast<std::size_t>(placed.picture)], placed, uv, which);
}

template <class Value>
void rearrange_corners(std::vector<std::array<Value, 3>>& values, std::span<const CornersFrom> from) {
    if (values.empty())
        return;
    std::vector<std::array<Value, 3>> moved(from.size());
    for (std::size_t i = 0; i < from.size(); ++i)
        for (std::size_t corner = 0; corner < 3; ++corner)
            moved[i][corner] = values[from[i].triangle][from[i].corner[corner]];
    values = std::move(moved);
}

void add_placed(ContentHasher& hasher, const SurfacePlacement& placed) {
    hasher.add(placed.picture);
    if (placed.picture < 0)
        return;
    hasher.add(placed.uv_set).add(static_cast<int>(placed.across)).add(static_cast<int>(placed.down));
    hasher.add(static_cast<int>(placed.is_nearest)).add(placed.turn_rad);
    for (const double number : {placed.scale.x, placed.scale.y, placed.offset.x, placed.offset.y})
        hasher.add(number);
}

} // namespace

glm::dvec2 SurfacePlacement::place_of(glm::dvec2 uv) const {
    if (turn_rad == 0.0)
        return offset + scale * uv;
    const double c = std::cos(turn_rad), s = std::sin(turn_rad);
    return {c * scale.x * uv.x + s * scale.y * uv.y + offset.x,
            -s * scale.x * uv.x + c * scale.y * uv.y + offset.y};
}

float linear_of_srgb(std::uint8_t code) { return srgb_table()[code]; }

SurfaceAppearance rearranged(SurfaceAppearance appearance, std::span<const CornersFrom> from) {
    if (!appearance.triangle_materials.empty()) {
        std::vector<std::uint16_t> materials(from.size());
        for (std::size_t i = 0; i < from.size(); ++i)
            materials[i] = appearance.triangle_materials[from[i].triangle];
        appearance.triangle_materials = std::move(materials);
    }
    for (std::vector<CornerUvs>& set : appearance.uvs)
        rearrange_corners(set, from);
    rearrange_corners(appearance.colours, from);
    return appearance;
}

ContentHash hash_of_appearance(const SurfaceAppearance& appearance) {
    ContentHasher hasher;
    hasher.add(static_cast<int>(appearance.pictures.size()));
    for (const auto& picture : appearance.pictures) {
        hasher.add(picture->size_px.x).add(picture->size_px.y).add(picture->texels);
    }
    hasher.add(static_cast<int>(appearance.materials.size()));
    for (const FileMaterial& material : appearance.materials) {
        for (const float number :
             {material.colour.x, material.colour.y, material.colour.z, material.metallic, material.roughness})
            hasher.add(static_cast<double>(number));
        add_placed(hasher, material.colour_picture);
        add_placed(hasher, material.surface_picture);
        if (material.normal_picture.picture >= 0) { // looks without keep their names
            add_placed(hasher, material.normal_picture);
            hasher.add(static_cast<double>(material.normal_scale));
        }
    }
    hasher.add(appearance.triangle_materials);
    for (const std::vector<CornerUvs>& set : appearance.uvs)
        hasher.add(static_cast<int>(set.size())).add(set);
    hasher.add(static_cast<int>(appearance.colours.size())).add(appearance.colours);
    return hasher.finish();
}

SurfaceLook look_at(const SurfaceAppearance& appearance, std::uint32_t triangle, glm::vec2 place) {
    SurfaceLook look;
    if (!appearance.materials.empty()) {
        const FileMaterial& material = appearance.material_of(triangle);
        look = {material.colour, material.metallic, material.roughness};
        if (material.colour_picture.picture >= 0)
            look.colour *=
                placed_value(appearance, material.colour_picture, triangle, place, TexelValue::srgb);
        if (material.surface_picture.picture >= 0) {
            const glm::vec3 surface =
                placed_value(appearance, material.surface_picture, triangle, place, TexelValue::linear);
            look.roughness *= surface.y;
            look.metallic *= surface.z;
        }
    }
    if (!appearance.colours.empty())
        look.colour *= between(appearance.colours[triangle], place);
    look.colour = glm::clamp(look.colour, 0.0f, 1.0f);
    look.metallic = std::clamp(look.metallic, 0.0f, 1.0f);
    look.roughness = std::clamp(look.roughness, 0.0f, 1.0f);
    return look;
}

bool has_bumps(const SurfaceAppearance& appearance) {
    return std::ranges::any_of(appearance.materials, [](const FileMaterial& material) {
        return material.normal_picture.picture >= 0 && material.normal_scale != 0.0f;
    });
}

glm::vec3 bump_at(const SurfaceAppearance& appearance, std::uint32_t triangle, glm::vec2 place) {
    constexpr glm::vec3 flat(0.0f, 0.0f, 1.0f);
    if (appearance.materials.empty())
        return flat;
    const FileMaterial& material = appearance.material_of(triangle);
    if (material.normal_picture.picture < 0)
        return flat;
    glm::vec3 bump = placed_value(appearance, material.normal_picture, triangle, place, TexelValue::normal);
    bump.x *= material.normal_scale;
    bump.y *= material.normal_scale;
    if (bump.x == 0.0f && bump.y == 0.0f)
        return flat;
    // A normal that leans below the surface is none that glTF allows.
    constexpr float least_height = 0.01f;
    return glm::normalize(glm::vec3(bump.x, bump.y, std::max(bump.z, least_height)));
}

float alpha_at(const SurfaceAppearance& appearance, std::uint32_t triangle, glm::vec2 place) {
    if (appearance.materials.empty())
        return 1.0f;
    const SurfacePlacement& picture = appearance.material_of(triangle).colour_picture;
    return picture.picture < 0 ? 1.0f
                               : placed_value(appearance, picture, triangle, place, TexelValue::alpha).x;
}

std::vector<MeanLook> mean_looks(const SurfaceAppearance& appearance, const Mesh& mesh) {
    constexpr std::size_t places_wanted = 200'000;
    std::vector<MeanLook> looks(std::max<std::size_t>(appearance.materials.size(), 1));
    struct Sum {
        glm::dvec3 colour{0.0};
        double metallic = 0.0, roughness = 0.0;
    };
    std::vector<Sum> sums(looks.size());
    const std::size_t triangles = mesh.triangles.size();
    if (triangles == 0)
        return looks;
    // Places in rows of each triangle's unit square, folded over its diagonal.
    const auto side = static_cast<int>(std::clamp(
        std::sqrt(static_cast<double>(places_wanted) / static_cast<double>(triangles)), 1.0, 256.0));
    for (std::uint32_t triangle = 0; triangle < triangles; ++triangle) {
        const std::size_t of =
            appearance.triangle_materials.empty() ? 0 : appearance.triangle_materials[triangle];
        const glm::uvec3& corners = mesh.triangles[triangle];
        const glm::dvec3 a(mesh.positions[corners.x]), b(mesh.positions[corners.y]),
            c(mesh.positions[corners.z]);
        const double area = 0.5 * glm::length(glm::cross(b - a, c - a));
        const double share = area / (side * side);
        for (int i = 0; i < side * side; ++i) {
            glm::vec2 place((static_cast<float>(i % side) + 0.5f) / static_cast<float>(side),
                            (static_cast<float>(i / side) + 0.5f) / static_cast<float>(side));
            if (side == 1)
                place = glm::vec2(1.0f / 3.0f);
            else if (place.x + place.y > 1.0f)
                place = 1.0f - place;
            const SurfaceLook look = look_at(appearance, triangle, place);
            sums[of].colour += share * glm::dvec3(look.colour);
            sums[of].metallic += share * static_cast<double>(look.metallic);
            sums[of].roughness += share * static_cast<double>(look.roughness);
            const float largest = std::max({look.colour.x, look.colour.y, look.colour.z});
            looks[of].largest = std::max(looks[of].largest, static_cast<double>(largest));
            looks[of].overexposed += largest >= 0.99f ? share : 0.0;
        }
        looks[of].area += area;
    }
    for (std::size_t i = 0; i < looks.size(); ++i) {
        MeanLook& look = looks[i];
        if (!(look.area > 0.0))
            continue;
        look.look.colour = glm::vec3(sums[i].colour / look.area);
        look.look.metallic = static_cast<float>(sums[i].metallic / look.area);
        look.look.roughness = static_cast<float>(sums[i].roughness / look.area);
        look.overexposed /= look.area;
    }
    return looks;
}

} // namespace overt
