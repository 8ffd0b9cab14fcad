#include "render/bake/microfacets.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace overt {

namespace {

constexpr float pi = std::numbers::pi_v<float>;

/// A place in the unit square to one in the unit disc, evenly and without tearing neighbours apart, so that
/// what is spread evenly stays so (Shirley and Chiu 1997, "A low distortion map between disk and square").
glm::vec2 disc_place(glm::vec2 place) {
    const float a = 2.0f * place.x - 1.0f, b = 2.0f * place.y - 1.0f;
    if (std::abs(a) > std::abs(b)) {
        const float turn = 0.25f * pi * (b / a);
        return {a * std::cos(turn), a * std::sin(turn)};
    }
    if (b == 0.0f)
        return {0.0f, 0.0f};
    const float turn = 0.25f * pi * (a / b);
    return {b * std::sin(turn), b * std::cos(turn)};
}

} // namespace

NormalFrame::NormalFrame(glm::vec3 of_normal) : normal(of_normal) {
    const float sign = std::copysign(1.0f, normal.z);
    const float a = -1.0f / (sign + normal.z), b = normal.x * normal.y * a;
    tangent = {1.0f + sign * normal.x * normal.x * a, sign * b, -sign * normal.x};
    bitangent = {b, sign + normal.y * normal.y * a, -normal.y};
}

NormalFrame::NormalFrame(glm::vec3 of_normal, glm::vec3 along) : NormalFrame(of_normal) {
    const glm::vec3 flat = along - glm::dot(along, normal) * normal;
    const float length = glm::length(flat);
    if (!(length > 1e-4f))
        return;
    tangent = flat / length;
    bitangent = glm::cross(normal, tangent);
}

float ggx_visible_share(glm::vec3 direction, GgxWidths alpha) {
    if (direction.z <= 0.0f)
        return 0.0f;
    const float x = alpha.along * direction.x, y = alpha.across * direction.y;
    return 2.0f / (1.0f + std::sqrt(1.0f + (x * x + y * y) / (direction.z * direction.z)));
}

float ggx_density(glm::vec3 micro_normal, GgxWidths alpha) {
    if (micro_normal.z <= 0.0f)
        return 0.0f;
    const float x = micro_normal.x / alpha.along, y = micro_normal.y / alpha.across;
    const float stretched = x * x + y * y + micro_normal.z * micro_normal.z;
    return 1.0f / (pi * alpha.along * alpha.across * stretched * stretched);
}

glm::vec3 ggx_visible_normal(glm::vec3 towards_eye, GgxWidths alpha, glm::vec2 place) {
    // Seen from a hemisphere of stretched mirrors, as for one width (there with alpha 1).
    const glm::vec3 eye =
        glm::normalize(glm::vec3(alpha.along * towards_eye.x, alpha.across * towards_eye.y, towards_eye.z));
    const glm::vec3 normal = ggx_visible_normal(eye, 1.0f, place);
    return glm::normalize(
        glm::vec3(alpha.along * normal.x, alpha.across * normal.y, std::max(1e-6f, normal.z)));
}

float ggx_visible_share(glm::vec3 direction, float alpha) {
    if (direction.z <= 0.0f)
        return 0.0f;
    const float cosine_squared = direction.z * direction.z;
    const float tan_squared = std::max(0.0f, 1.0f - cosine_squared) / cosine_squared;
    return 2.0f / (1.0f + std::sqrt(1.0f + alpha * alpha * tan_squared));
}

float ggx_density(glm::vec3 micro_normal, float alpha) {
    if (micro_normal.z <= 0.0f)
        return 0.0f;
    const float stretched =
        (micro_normal.x * micro_normal.x + micro_normal.y * micro_normal.y) / (alpha * alpha) +
        micro_normal.z * micro_normal.z;
    return 1.0f / (pi * alpha * alpha * stretched * stretched);
}

glm::vec3 ggx_visible_normal(glm::vec3 towards_eye, float alpha, glm::vec2 place) {
    // Stretched so that alpha is 1, the mirrors make a hemisphere; seen from the eye it is half a disc and
    // half an ellipse.
    const glm::vec3 eye =
        glm::normalize(glm::vec3(alpha * towards_eye.x, alpha * towards_eye.y, towards_eye.z));
    const float across = eye.x * eye.x + eye.y * eye.y;
    const glm::vec3 right =
        across > 0.0f ? glm::vec3(-eye.y, eye.x, 0.0f) / std::sqrt(across) : glm::vec3(1, 0, 0);
    const glm::vec3 up = glm::cross(eye, right);
    const glm::vec2 disc = disc_place(place);
    const float x = disc.x;
    const float share = 0.5f * (1.0f + eye.z);
    const float y = (1.0f - share) * std::sqrt(std::max(0.0f, 1.0f - x * x)) + share * disc.y;
    const glm::vec3 normal = x * right + y * up + std::sqrt(std::max(0.0f, 1.0f - x * x - y * y)) * eye;
    return glm::normalize(glm::vec3(alpha * normal.x, alpha * normal.y, std::max(1e-6f, normal.z)));
}

float ggx_mirror_density(glm::vec3 to_eye, glm::vec3 out, float alpha) {
    return ggx_visible_share(to_eye, alpha) * ggx_density(glm::normalize(to_eye + out), alpha) /
           (4.0f * to_eye.z);
}

glm::vec3 cosine_direction(glm::vec2 place) {
    const glm::vec2 disc = disc_place(place);
    return {disc.x, disc.y, std::sqrt(std::max(0.0f, 1.0f - glm::dot(disc, disc)))};
}

} // namespace overt
