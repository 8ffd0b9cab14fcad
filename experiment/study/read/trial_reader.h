/// One trial of a session, read for a study.
#pragma once

#include <vector>

#include "experiment/record/read/session_record.h"
#include "experiment/study/fixations/surface_fixations.h"
#include "experiment/study/fixations/trial_presentation.h"
#include "experiment/study/read/trial_keys.h"
#include "experiment/study/results/study_options.h"

namespace overt {

struct ReadTrial {
    StudyTrial trial; ///< session and object are not set
    std::vector<StudyFixation> fixations;
    StudyTrace trace;
    std::int64_t samples = 0;
    bool had_both_eyes = false;
};

struct TrialSurface {
    const SurfaceLookup* lookup = nullptr;
    bool has_mesh = false;
    SurfaceWays* ways = nullptr; ///< null without a mesh or a scale
    std::optional<ObjectScale> scale;
    const LightScores* light = nullptr; ///< of the trial's stimulus; null: not known
};

/// `validations` by their times. Throws RecordError.
ReadTrial read_trial(const SessionRecord& record, const TrialRecord& trial, const TrialKeys& keys,
                     std::span<const RecordedAccuracy> validations, const TrialSurface& surface,
                     const StudyOptions& options);

} // namespace overt
