/// A rough metal as a crowd of small mirrors: the distribution GGX.
#pragma once

#include <glm/glm.hpp>

namespace overt {

/// Two directions that make a right-handed frame with a normal (Duff et al. 2017, "Building an orthonormal
/// basis, revisited").
struct NormalFrame {
    glm::vec3 tangent, bitangent, normal;
    explicit NormalFrame(glm::vec3 of_normal);
    /// With its tangent along a direction in the surface, as near as may be to `along`; any, where that is
    /// the normal's.
    NormalFrame(glm::vec3 of_normal, glm::vec3 along);
    glm::vec3 to_local(glm::vec3 v) const { return {dot(v, tangent), dot(v, bitangent), dot(v, normal)}; }
    glm::vec3 to_world(glm::vec3 v) const { return v.x * tangent + v.y * bitangent + v.z * normal; }
};

/// Smith's share of the micro-mirrors facing `direction` that are not hidden by others: 2 / (1 + sqrt(1 +
/// alpha^2 tan^2)). Local frame; 0 below the surface.
float ggx_visible_share(glm::vec3 direction, float alpha);

/// Density of micro-normals per solid angle (Walter et al. 2007, eq. 33).
float ggx_density(glm::vec3 micro_normal, float alpha);

/// Micro-normal as seen from `towards_eye` (local frame, above the surface), for a place in the unit square:
/// drawn with the density of visible normals (Heitz 2018, JCGT 7(4)). What such a mirror reflects weighs
/// Fresnel times ggx_visible_share(out), shadowing and masking taken as independent.
glm::vec3 ggx_visible_normal(glm::vec3 towards_eye, float alpha, glm::vec2 place);

/// Density per solid angle with which the mirrors that are seen from `to_eye` lead on in `out`, both in the
/// local frame: G1(v) D(h) / (4 cos_v) (Walter et al. 2007, eq. 14; Heitz 2018).
float ggx_mirror_density(glm::vec3 to_eye, glm::vec3 out, float alpha);

/// Roughness along the tangent and across it, of what is brushed.
struct GgxWidths {
    float along = 0.1f, across = 0.1f;
};

// The same functions for mirrors that are spread unlike along and across.
float ggx_visible_share(glm::vec3 direction, GgxWidths alpha);
float ggx_density(glm::vec3 micro_normal, GgxWidths alpha);
glm::vec3 ggx_visible_normal(glm::vec3 towards_eye, GgxWidths alpha, glm::vec2 place);

/// Direction with density cosine / pi about +z.
glm::vec3 cosine_direction(glm::vec2 place);

} // namespace overt
