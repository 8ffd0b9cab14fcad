/// The outer surface of a coat of lacquer.
#pragma once

#include <cstdint>

#include "experiment/scene/mesh.h"

namespace overt {

/// All lengths in the mesh's unit.
struct CoatShape {
    double thickness = 0.01;   ///< in the mean, along the normal of the surface below; above 0
    double bump_height = 0.01; ///< from valleys to tops, about
    double bump_width = 0.08;  ///< from one bump to the next, about; above 0
    std::uint64_t seed = 0;    ///< another seed: other bumps
};

/// Bumps of stucco: smooth noise of mean 0, mostly between -1/2 and 1/2, whose features are about 1 wide;
/// fixed by the seed.
double stucco(glm::dvec3 place, std::uint64_t seed);

/// The mesh with each vertex moved outwards along its mean normal by the coat's thickness and its bumps,
/// nowhere by less than a tenth of the thickness. A mesh too coarse for the bumps is divided first. In narrow
/// folds the surface may pass through itself.
Mesh coat_over(const Mesh& body, const CoatShape& shape);

} // namespace overt
