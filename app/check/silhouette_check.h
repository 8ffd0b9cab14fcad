/// Whether ready-made frames show the object where the hidden maps have it: if not, camera, angle or mesh
/// of the other program differ, and gaze would be projected to the wrong places.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "app/inputs/protocol_inputs.h"
#include "render/stimulus/stimulus_library.h"

namespace overt {

/// Two silhouettes held against one another, a byte each pixel, not 0 on the object.
struct SilhouetteMatch {
    double iou = 1.0;          ///< pixels in both over pixels in either; 1 if both are empty
    glm::dvec2 offset_px{0.0}; ///< from the map's middle of area to the frame's; y down
    double size_ratio = 1.0;   ///< of the square roots of areas, frame over map
    std::size_t both = 0, either = 0;
    double frame_share = 0.0; ///< of the picture that the frame's object covers
    /// What the first would be with the frame mirrored left to right, and turned upside down.
    double mirrored_iou = 1.0, upside_down_iou = 1.0;
};
SilhouetteMatch match_silhouettes(std::span<const std::uint8_t> frame, std::span<const std::uint8_t> map,
                                  int width_px);

/// Of one sequence of [[frames]].
struct SequenceSilhouette {
    std::string stimulus; ///< OBJECT/MATERIAL
    double iou = 1.0;     ///< of all frames together
    int worst_frame = 0;
    SilhouetteMatch worst;
};

/// What an animation has to reach in each frame; a pixel or two along an outline may be taken differently.
inline constexpr double least_silhouette_iou = 0.99;

/// Compares all frames of all sequences whose object has a mesh or ready-made maps, drawing maps that the
/// cache lacks. Adds a warning at the key for each that does not agree, naming its worst frame, and for each
/// that has neither alpha nor a background colour. Throws InputError, GraphicsError.
std::vector<SequenceSilhouette> check_silhouettes(const Experiment& experiment, StimulusLibrary& library,
                                                  Diagnostics& diagnostics);

std::string to_text(const std::vector<SequenceSilhouette>& sequences);
nlohmann::ordered_json to_json(const std::vector<SequenceSilhouette>& sequences);

} // namespace overt
