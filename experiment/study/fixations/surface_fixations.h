/// Fixations of a trial on the surface: each re-projected sample by sample through the frames lit meanwhile.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "experiment/analysis/gaze_cone.h"
#include "experiment/clock_map.h"
#include "experiment/gaze_event.h"
#include "experiment/maps/light_pictures.h"
#include "experiment/scene/object_scale.h"
#include "experiment/study/fixations/placed_samples.h"
#include "experiment/study/fixations/surface_ways.h"
#include "experiment/study/results/study_options.h"

namespace overt {

/// Standard deviation of a kernel, in millimetres of the object, at a place of this depth in the mesh's unit:
/// what is farther away is seen smaller.
inline double sigma_mm(const KernelWidth& width, const ObjectScale& scale, double depth) {
    return width.is_mm ? width.value : width.value * scale.mm_per_deg * depth / scale.axis_depth;
}

/// Where a trial's fixations are to be found.
struct FixationContext {
    const StudyOptions& options;
    std::span<const PlacedSample> samples; ///< of one eye, by time
    const std::optional<ClockMap>& clock_map;
    SessionTime onset;
    double presentation_s = 0.0;
    std::span<const ObjectPose> angles;      ///< by PoseIndex
    const std::optional<ObjectScale>& scale; ///< nothing without a known camera
    bool has_surface = false;
    /// Of a session that knows of no stimulus: its fixations are told with their places on the screen alone,
    /// and no frame needs to have been lit.
    bool has_stimulus = true;
    bool has_mesh = false;                   ///< points have triangles
    SurfaceWays* ways = nullptr;             ///< along the mesh; null without one, or without a scale
    const SurfaceLookup* lookup = nullptr;   ///< for the gaze cone; may be null
    const GazeCone* cone = nullptr;          ///< the same
    bool is_accuracy_known = false;          ///< the cone is as wide as a validation says
    const ScreenGeometry* screen = nullptr;  ///< for the error of the look-up; null: it is not reckoned
    const LightScores* light = nullptr;      ///< of the stimulus; null: not known
    const ShownPictures* pictures = nullptr; ///< of the stimulus's motion; with `light`
    /// Of the presentation in one of several slots: fixations in no frame of it are others', and left out.
    bool has_other_slots = false;
};

/// A fixation of the events with the samples that are its own. Those that ended before the onset, or began
/// after the presentation's end, or lie in other slots, are not the presentation's: nothing.
std::optional<StudyFixation> surface_fixation(const GazeEvent& event, const FixationContext& context);

/// Index range of the samples from one time to another, both in it.
std::pair<std::size_t, std::size_t> samples_between(std::span<const PlacedSample> samples, TrackerTime from,
                                                    TrackerTime to);

} // namespace overt
