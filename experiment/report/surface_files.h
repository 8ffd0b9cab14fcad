/// The maps of a study as coloured meshes.
#pragma once

#include <filesystem>

#include "experiment/study/results/study_results.h"

namespace overt {

/// Writes a .glb and a .ply of each map by duration and of each difference map into `folder`, which is made
/// if it is not there, and index.csv, a line for each file. All maps have one colour scale, from 0 to the
/// highest density of any; difference maps have one from minus to plus their largest value. Vertices that
/// were never visible are grey. Throws RecordError. Gives how many meshes were written.
int write_surfaces(const StudyResults& results, const std::filesystem::path& folder);

} // namespace overt
