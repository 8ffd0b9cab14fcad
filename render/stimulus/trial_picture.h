/// One picture that explains a trial: a frame as the observer saw it, its hidden map, and the gaze on the
/// surface.
#pragma once

#include <span>
#include <string>

#include "experiment/maps/coordinate_maps.h"
#include "render/image/linear_image.h"

namespace overt {

struct TrialPictureContent {
    LinearImage frame; ///< linear, of the pose shown
    const Mesh* mesh = nullptr;
    const CoordinateMaps* maps = nullptr;
    PoseIndex pose;
    std::span<const glm::dvec3> gaze_on_surface; ///< object coordinates of the trial's samples
    double kernel_sigma = 1.0;                   ///< of the density, in the mesh's unit
    std::string frame_caption, map_caption, gaze_caption;
};

/// Three panels side by side with their captions; linear, to be written with write_srgb_png.
LinearImage draw_trial_picture(const TrialPictureContent& content);

/// A map as colours: red, green and blue are the object's x, y and z within its bounding box, in linear
/// light; black off the object.
LinearImage map_as_colours(const CoordinateMaps& maps, const Mesh& mesh, PoseIndex pose);

} // namespace overt
