/// What of an object a presentation shows, and for how long: the baseline of gaze that looks at all of the
/// picture alike.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "experiment/maps/coordinate_maps.h"
#include "experiment/study/results/study_results.h"

namespace overt {

struct Exposure {
    /// By vertex: see StudyObject.
    std::vector<float> seconds_visible;
    /// By vertex: seconds times pixels of the picture that show its triangles, shared among their corners.
    /// How long a place was visible, how large it was and how obliquely it was seen are all in it.
    std::vector<double> pixel_seconds;
    std::vector<double> part_pixel_seconds; ///< the same by PartIndex
};

/// Of presentations that show each pose for so long, `seconds` by PoseIndex. A vertex is visible in a pose if
/// a triangle that has it is at the centre of a pixel, or if it has a triangle that faces the camera and the
/// map shows no nearer surface at its place: small triangles may lie between the centres of pixels. There the
/// map's triangle is continued to the vertex's line of sight, no farther than its corners are, and surfaces
/// within two pixels' width of depth are taken as one. Uses all processors; does not depend on how many.
Exposure exposure_of(const CoordinateMaps& maps, std::span<const double> seconds);

/// Each area with its size, how long it is visible, and its share of the exposure and of the fixations; the
/// first row is the whole object. `px_mm2`: the area of the object, seen head-on in the depth of its axis,
/// that a pixel shows.
struct AreaExposure {
    const Exposure& exposure;
    const Mesh& mesh;
    double mm_per_unit = 1.0, px_mm2 = 1.0;
};
std::vector<ExposureRow> exposure_rows(const AreaExposure& of, int object, const Areas& areas);

} // namespace overt
