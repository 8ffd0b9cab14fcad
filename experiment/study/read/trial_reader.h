/// One trial of a session, read for a study.
#pragma once

#include <vector>

#include "experiment/record/read/session_record.h"
#include "experiment/study/read/surface_fixations.h"
#include "experiment/study/read/trial_keys.h"
#include "experiment/study/results/study_options.h"

namespace overt {

/// What a session's events say of its trials' accuracy.
struct RecordedAccuracy {
    SessionTime at;
    double mean_deg = 0.0, worst_deg = 0.0;
};

struct ReadTrial {
    StudyTrial trial; ///< session and sculpture are not set
    std::vector<StudyFixation> fixations;
    StudyTrace trace; ///< empty if it was not asked for
    std::int64_t samples = 0;
    bool had_both_eyes = false;
};

struct TrialSurface {
    const SurfaceLookup* lookup = nullptr;
    const SurfaceGeometry* fine = nullptr; ///< null without a mesh
    const CoarseSurface* coarse = nullptr; ///< null without a mesh or a scale; so is the field on it
    GeodesicField* field = nullptr;
    std::optional<ObjectScale> scale;
    const LightScores* light = nullptr; ///< of the trial's stimulus; null: not known
};

/// `validations` by their times. Throws RecordError.
ReadTrial read_trial(const SessionRecord& record, const TrialRecord& trial, const TrialKeys& keys,
                     std::span<const RecordedAccuracy> validations, const TrialSurface& surface,
                     const StudyOptions& options, bool with_trace);

} // namespace overt
