/// What maps of an object are made with, and how large it seems.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiment/maps/surface_point.h"
#include "experiment/scene/object_scale.h"
#include "experiment/study/fixations/surface_ways.h"
#include "experiment/study/results/study_results.h"
#include "experiment/surface/hat_smoother.h"
#include "experiment/surface/surface_geometry.h"

namespace overt {

/// What maps of an object are made with.
struct ObjectSurface {
    std::unique_ptr<SurfaceGeometry> geometry; ///< null without a mesh, or without a known camera
    std::vector<double> areas_mm2;             ///< by vertex
    std::optional<ObjectScale> scale;
    /// For statistics over many maps, and ways along the surface; null without a geometry or a scale.
    std::unique_ptr<CoarseSurface> coarse;
    std::unique_ptr<SurfaceGeometry> coarse_geometry;
    /// Heat on the surface with the kernels of the counted fixations; null where all nodes are as good.
    std::unique_ptr<HatSmoother> hats;
    std::vector<double> pixel_seconds; ///< see Exposure
};

/// Gives the object its scale, mesh and parts, and a remark on what is missing, and makes what maps need.
/// `lookup`: of a session that has it; null if none has, for a `fault` if that is not empty.
void add_surface(const SurfaceLookup* lookup, const std::string& fault, StudyObject& object,
                 ObjectSurface& surface);

} // namespace overt
