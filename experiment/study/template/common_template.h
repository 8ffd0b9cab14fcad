/// Gaze on several objects, brought to the surface of one of them.
#pragma once

#include "experiment/study/read/study_reader.h"
#include "experiment/study/results/study_options.h"

namespace overt {

/// Makes the study one of a single object, the template: each fixation, and each place that was pointed at,
/// comes to lie where it belongs on the template's surface (SurfaceBridge), with its kernel and its lengths
/// as much longer or shorter as the warp makes things on the whole. What was visible for how long is the mean
/// over the trials, each by its own object. All else of trials stays, the column `object` among it, so that
/// objects can be compared on the template. Reliefs stay those of their own objects. Does nothing without a
/// template in the options.
///
/// Sets StudyResults::template_fits. Throws InputError if no object is called so, if one that was shown has
/// no mesh, or if its landmarks do not make a warp.
void bring_to_template(ReadStudy& study, const StudyOptions& options);

} // namespace overt
