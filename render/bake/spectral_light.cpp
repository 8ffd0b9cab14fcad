#include "render/bake/spectral_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include "experiment/scene/viewing.h"
#include "render/bake/light_colour.h"

namespace overt {

namespace {

/// The probe as it stands in the file: it is turned when it is looked up, without being resampled.
LightProbe unturned_probe(LightSettings light) {
    light.rotation_deg = 0.0;
    return load_light_probe(light);
}

} // namespace

SpectralLight::SpectralLight(const LightSettings& light)
    : SpectralLight(unturned_probe(light), light.exposure, light.rotation_deg) {
    sources_ = light_sources(light);
}

SpectralLight::SpectralLight(const LightProbe& probe, double exposure, double rotation_deg)
    : size_(probe.radiance.size_px), stride_(size_.x + 2), exposure_(exposure), rotation_deg_(rotation_deg) {
    // One more texel on each side, so that a look-up needs no cases: the neighbour round the horizon, and
    // beyond a pole the texel of the same row on the far side.
    texels_.resize(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(size_.y + 2));
    for (int y = -1; y <= size_.y; ++y) {
        const bool beyond_pole = y < 0 || y == size_.y;
        const int row = std::clamp(y, 0, size_.y - 1), across = beyond_pole ? size_.x / 2 : 0;
        for (int x = -1; x <= size_.x; ++x) {
            texels_[static_cast<std::size_t>((y + 1) * stride_ + x + 1)] =
                probe.radiance.at((x + across + size_.x) % size_.x, row);
        }
    }
    aim_.emplace(probe);
    if (!aim_->pays())
        aim_.reset();
    for (std::size_t channel = 0; channel < 3; ++channel)
        basis_[channel] = Bins::of(light_basis()[channel]);
    if (probe.negative_texels > 0) {
        notes_.push_back(fmt::format("{} of {} texels of the probe held negative light; it counts as none",
                                     probe.negative_texels, size_.x * size_.y));
    }
}

float SpectralLight::share_of_turn(Degrees angle) const {
    const double turn = (rotation_deg_ + turn_deg_ - angle.value) / 360.0 + 0.5;
    return static_cast<float>(turn - std::floor(turn));
}

std::vector<LightSource> SpectralLight::sources_at(const ObjectPose& object) const {
    if (sources_.empty())
        return {};
    const glm::dmat3 turned(glm::rotate(glm::dmat4(1.0), to_radians({rotation_deg_ + turn_deg_}).value,
                                        glm::dvec3(0.0, 0.0, 1.0)));
    const glm::dmat3 object_from_world =
        glm::transpose(glm::dmat3(TurntablePose{glm::dvec3(0.0), object}.world_from_object()));
    return moved(sources_, object_from_world * turned, -(object_from_world * object.shift));
}

glm::vec3 SpectralLight::towards(glm::vec3 direction, float turn) const {
    constexpr float pi = std::numbers::pi_v<float>;
    float around = std::atan2(direction.x, direction.y) / (2.0f * pi) + turn; // -0.5 … 1.5
    around -= std::floor(around);
    const auto height = static_cast<float>(size_.y), width = static_cast<float>(size_.x);
    // +0.5: the middle of the texel in the corner of the padded picture is at -0.5 of the probe.
    const float u = around * width + 0.5f;
    const float v = std::acos(glm::clamp(direction.z, -1.0f, 1.0f)) / pi * height + 0.5f;
    const int column = std::min(static_cast<int>(u), size_.x), row = std::min(static_cast<int>(v), size_.y);
    const float right = u - static_cast<float>(column), down = v - static_cast<float>(row);
    const glm::vec4* upper = &texels_[static_cast<std::size_t>(row * stride_ + column)];
    const glm::vec4* lower = upper + stride_;
    const glm::vec4 above = upper[0] + right * (upper[1] - upper[0]);
    const glm::vec4 below = lower[0] + right * (lower[1] - lower[0]);
    return glm::vec3(above + down * (below - above));
}

} // namespace overt
