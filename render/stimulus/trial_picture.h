/// One picture that explains a trial: a frame as the observer saw it, its hidden map, and the gaze on the
/// surface.
#pragma once

#include <span>
#include <string>

#include "experiment/maps/surface_point.h"
#include "render/image/linear_image.h"

namespace overt {

struct TrialPictureContent {
    LinearImage frame;                      ///< linear, of the pose shown
    const SurfaceLookup* surface = nullptr; ///< be its maps of triangles or of coordinates
    Bounds bounds;                          ///< of the object
    PoseIndex pose;
    std::span<const glm::dvec3> gaze_on_surface; ///< object coordinates of the trial's samples
    double kernel_sigma = 1.0;                   ///< of the density, in the mesh's unit
    std::string frame_caption, map_caption, gaze_caption;
};

/// Three panels side by side with their captions, and the scale of the density; linear, to be written with
/// write_srgb_png.
LinearImage draw_trial_picture(const TrialPictureContent& content);

} // namespace overt
