#include "render/stimulus/frame_quality.h"

#include <fmt/format.h>

#include "experiment/protocol/keys/protocol_keys.h"
#include "render/bake/material_model.h"

namespace overt {

namespace {

/// Compressing and writing a pixel, by the same measure.
constexpr double writing_cost = 0.8;

} // namespace

FrameQuality quality_of(BakeQuality level, const BakingSettings& baking) {
    if (level != baking.least())
        return {level, {}, {}};
    return {level, baking.samples, baking.target_error_de};
}

std::string describe(const FrameQuality& quality) {
    std::string text(name_of(quality.level));
    if (quality.samples)
        text += fmt::format(" with {} samples", *quality.samples);
    if (quality.target_error_de)
        text += fmt::format("{} to {} Delta-E", quality.samples ? "," : "", *quality.target_error_de);
    return text;
}

BakeSettings bake_settings(const FrameQuality& quality, const BakingSettings& baking, MaterialKind material) {
    BakeSettings settings = settings_of(quality.level, material);
    settings.samples = quality.samples.value_or(settings.samples);
    settings.target_error_de = quality.target_error_de.value_or(0.0);
    settings.filter = baking.filter;
    settings.filter_width_px = baking.filter_width_px;
    settings.seed = baking.seed.value_or(0);
    return settings;
}

double expected_cost(const FrameQuality& quality, const Protocol& protocol, MaterialKind material) {
    const BakeSettings settings = bake_settings(quality, protocol.bake, material);
    const double pixels =
        static_cast<double>(protocol.views.front().width_px) * protocol.views.front().height_px;
    const double paths = settings.samples / static_cast<double>(settings.pixel_step * settings.pixel_step);
    return pixels * (paths * model_of(material).path_cost + writing_cost);
}

} // namespace overt
