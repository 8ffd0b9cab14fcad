/// The gaze of one eye during one trial, each sample with the place where it met the surface.
#pragma once

#include <optional>
#include <vector>

#include "experiment/record/read/sample_counts.h"
#include "experiment/record/read/sample_join.h"

namespace overt {

struct PlacedSample {
    TrackerTime sampled_at;
    double time_s = 0.0; ///< since the presentation's onset; meaningless without a time
    ScreenPoint gaze;
    float pupil = 0.0f;
    bool has_gaze = false;
    bool has_time = false;
    int frame = -1; ///< lit then on the gaze's row; -1: none
    PoseIndex pose;
    bool is_on_surface = false;
    bool is_within_reach = false; ///< beside the surface, but no farther than the reach
    SurfacePoint surface; ///< meaningful in both cases: the point met, or the one seen at the nearest pixel
    bool has_place() const { return is_on_surface || is_within_reach; }
};

/// What a join found of a sample. `lookup` is null without a surface; it is the join's. A sample that misses
/// the object's picture by no more than `reach` (visual angle, 0: none) has the point seen at the centre
/// of the picture's nearest pixel.
PlacedSample placed_sample(const GazeSample& sample, const JoinedSample& joined, const SurfaceLookup* lookup,
                           SessionTime onset, Degrees reach);

struct PlacedSamples {
    std::vector<PlacedSample> samples; ///< of `eye`, by time
    Eye eye = Eye::right;
    bool had_both_eyes = false;       ///< of a binocular recording, one eye is taken
    SampleCounts counts;              ///< of all eyes, as the exported table of trials has them
    double clock_uncertainty_s = 0.0; ///< largest bound on the error of a sample's time
};

/// Reads the trial's samples in pieces, and places each as placed_sample() does. Of two eyes `preferred` is
/// taken if it has gaze. Throws RecordError.
PlacedSamples placed_samples(const SessionRecord& record, const TrialRecord& trial,
                             const std::optional<TrialLedger>& ledger, const SurfaceLookup* lookup,
                             SessionTime onset, Eye preferred, Degrees reach);

} // namespace overt
