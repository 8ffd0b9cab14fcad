/// Maps in space as files: the paper's voxels, and its second way, a table from object coordinates to values.
#pragma once

#include <filesystem>

#include "experiment/study/results/study_results.h"

namespace overt {

/// Writes for each map by duration, into `folder` (made if it is not there), a volume (.nrrd, ms of fixation
/// per mm^3 and trial) and a look-up table (.cube, the share of its highest value), and index.csv: file,
/// object, title, kernel's sigma in mm, highest value, bounds of the table in mm. The Gaussian in space
/// has the mean sigma of the map's fixations, whatever kernel the surface's maps have. Coordinates are the
/// object's own, in its millimetres (object_scale.h). Gives the number of maps. Throws RecordError.
int write_volumes(const StudyResults& results, const std::filesystem::path& folder);

} // namespace overt
