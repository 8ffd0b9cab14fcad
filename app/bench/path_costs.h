/// What a path takes in each kind of material, by one that meets polished metal.
#pragma once

#include "app/cli/figures.h"
#include "experiment/stimulus/object.h"
#include "render/bake/spectral_light.h"

namespace overt {

/// Renders `object` of each kind in turn with polished metal, in pictures of a `view`'s size, and compares
/// processor times. What `overt check` reckons with (MaterialModel::path_cost) is to be within a factor of
/// two of them; processors and lights differ.
void measure_path_costs(BenchFigures& figures, const Object& object, const SpectralLight& light,
                        const SceneView& view);

} // namespace overt
