/// How a surface looks where the file that it comes from says it: pictures that lie on it, colours of its
/// corners, and what each of its triangles is made of. It stands beside a mesh, whose triangles are counted
/// alike; places on the surface, maps and areas know nothing of it.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "experiment/base/content_hash.h"
#include "experiment/scene/mesh.h"

namespace overt {

/// A picture as its file holds it: rows from the top, red, green, blue and alpha in codes of eight bits.
struct SurfacePicture {
    std::string name; ///< for messages
    std::string file; ///< its name beside the mesh, or where it lies in the mesh's file: "images[0]"
    glm::ivec2 size_px{0};
    std::vector<glm::u8vec4> texels;
};

/// What lies beyond the edge of a picture.
enum class PictureEdge : std::uint8_t { repeat, clamp, mirror };

/// A picture as a material has it on its surface.
struct SurfacePlacement {
    int picture = -1; ///< index; -1: none
    int uv_set = 0;   ///< 0 or 1
    PictureEdge across = PictureEdge::repeat, down = PictureEdge::repeat;
    bool is_nearest = false; ///< texels have sharp edges
    // u' = offset + turn * scale * u (KHR_texture_transform): scaled, turned, moved.
    glm::dvec2 scale{1.0}, offset{0.0};
    double turn_rad = 0.0;

    glm::dvec2 place_of(glm::dvec2 uv) const;
};

/// What glTF calls a material of metallic-roughness. Colours are linear Rec. 709.
struct FileMaterial {
    std::string name;
    glm::vec3 colour{1.0f}; ///< factor on colour_picture, which is in sRGB, and on the corners' colours
    SurfacePlacement colour_picture;  ///< sRGB
    float metallic = 0.0f;            ///< factor on the blue of surface_picture
    float roughness = 0.5f;           ///< factor on its green; the root of GGX alpha
    SurfacePlacement surface_picture; ///< linear
    SurfacePlacement normal_picture;  ///< linear; of normals, x along u and y against v
    float normal_scale = 1.0f;        ///< factor on their x and y
    bool is_unlit =
        false; ///< its colours are to be shown as they stand: photographs, with their light in them
};

/// Where the corners of a triangle come from.
struct CornersFrom {
    std::uint32_t triangle = 0;
    std::array<std::uint8_t, 3> corner{0, 1, 2}; ///< of that triangle, for each of the new one's
};

using CornerUvs = std::array<glm::vec2, 3>;
using CornerColours = std::array<glm::vec3, 3>;

struct SurfaceAppearance {
    std::vector<std::shared_ptr<const SurfacePicture>> pictures;
    std::vector<FileMaterial> materials;
    std::vector<std::uint16_t> triangle_materials; ///< index for each triangle; empty: all of the first
    /// Places in pictures, u to the right and v down from the upper left corner, for the corners of each
    /// triangle; a set that no picture needs is empty.
    std::array<std::vector<CornerUvs>, 2> uvs;
    std::vector<CornerColours> colours; ///< of the corners of each triangle, linear; empty: white
    std::vector<std::string> remarks;   ///< what was left aside or read otherwise than the file may mean it

    /// Whether the file says anything of how the surface looks.
    bool says_something() const { return !materials.empty() || !colours.empty(); }
    const FileMaterial& material_of(std::uint32_t triangle) const {
        return materials[triangle_materials.empty() ? 0 : triangle_materials[triangle]];
    }
};

/// The same surface with other triangles: each as `from` says, which may leave some out.
SurfaceAppearance rearranged(SurfaceAppearance appearance, std::span<const CornersFrom> from);

/// Of all that light depends on.
ContentHash hash_of_appearance(const SurfaceAppearance& appearance);

/// What a place of the surface is like.
struct SurfaceLook {
    glm::vec3 colour{1.0f}; ///< linear Rec. 709, 0 … 1
    float metallic = 0.0f;  ///< 0 … 1
    float roughness = 0.5f; ///< 0 … 1
};

/// At a place of a triangle, which is (1 - u - v) of its first corner, u of its second and v of its third.
/// Pictures are read between their four nearest texels, in linear light. Any thread; allocates nothing.
SurfaceLook look_at(const SurfaceAppearance& appearance, std::uint32_t triangle, glm::vec2 place);

/// The normal that a material's picture gives a place of a triangle, in the frame of its tangent, bitangent
/// and normal: (0, 0, 1), of unit length, without a picture and where the picture is flat. Codes 127 and 128
/// are none.
glm::vec3 bump_at(const SurfaceAppearance& appearance, std::uint32_t triangle, glm::vec2 place);

/// Whether any of its materials has a picture of normals.
bool has_bumps(const SurfaceAppearance& appearance);

/// The alpha of the colour's picture there, 0 … 1; 1 without a picture.
float alpha_at(const SurfaceAppearance& appearance, std::uint32_t triangle, glm::vec2 place);

/// What the triangles of a material look like in the mean over their area.
struct MeanLook {
    SurfaceLook look;
    double area = 0.0;        ///< in the square of the mesh's unit
    double largest = 0.0;     ///< of the colour's channels, as found at the places looked at
    double overexposed = 0.0; ///< share of the area where a channel of the colour is at 0.99 or above
};

/// Of each material, by its index; one of no triangle has an area of 0. Looks at some 200,000 places, the
/// same each time.
std::vector<MeanLook> mean_looks(const SurfaceAppearance& appearance, const Mesh& mesh);

/// The linear light of a code of sRGB (IEC 61966-2-1).
float linear_of_srgb(std::uint8_t code);

} // namespace overt
