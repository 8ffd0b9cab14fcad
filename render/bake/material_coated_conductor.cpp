/// Polished metal under a bumpy coloured coat.
#include "render/bake/material_model.h"

namespace overt {

namespace {

/// The bumps spread what the metal mirrors.
LightProbe mirrored(const LightProbe& probe, const MaterialSettings&) {
    return blurred_by_ggx(probe, 0.05, {512, 256});
}

} // namespace

template <> const MaterialModel& material_model<MaterialKind::coated_conductor>() {
    static constexpr MaterialModel model{.scatter = nullptr,
                                         .density = nullptr,
                                         .take = nullptr,
                                         .layers = nullptr,
                                         .scatters = false,
                                         .path_cost = 7.8,
                                         .live = {LiveApproximation::Shading::coated_metal, mirrored,
                                                  [](const MaterialSettings&) { return 0.0f; }}};
    return model;
}

} // namespace overt
