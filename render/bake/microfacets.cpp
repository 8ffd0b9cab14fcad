#include "render/bake/microfacets.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace overt {

namespace {

constexpr float pi = std::numbers::pi_v<float>;

} // namespace

NormalFrame::NormalFrame(glm::vec3 of_normal) : normal(of_normal) {
    const float sign = std::copysign(1.0f, normal.z);
    const float a = -1.0f / (sign + normal.z), b = normal.x * normal.y * a;
    tangent = {1.0f + sign * normal.x * normal.x * a, sign * b, -sign * normal.x};
    bitangent = {b, sign + normal.y * normal.y * a, -normal.y};
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
    const float radius = std::sqrt(place.x), turn = 2.0f * pi * place.y;
    const float x = radius * std::cos(turn);
    const float share = 0.5f * (1.0f + eye.z);
    const float y =
        (1.0f - share) * std::sqrt(std::max(0.0f, 1.0f - x * x)) + share * radius * std::sin(turn);
    const glm::vec3 normal = x * right + y * up + std::sqrt(std::max(0.0f, 1.0f - x * x - y * y)) * eye;
    return glm::normalize(glm::vec3(alpha * normal.x, alpha * normal.y, std::max(1e-6f, normal.z)));
}

glm::vec3 cosine_direction(glm::vec2 place) {
    const float radius = std::sqrt(place.x), turn = 2.0f * pi * place.y;
    return {radius * std::cos(turn), radius * std::sin(turn), std::sqrt(std::max(0.0f, 1.0f - place.x))};
}

} // namespace overt
