/// The maps of a study as coloured meshes.
#pragma once

#include <filesystem>

#include "experiment/study/results/study_results.h"

namespace overt {

/// Writes a .glb and a .ply of each map by duration and of each difference map into `folder`, which is made
/// if it is not there, and index.csv, a line for each file. All maps have one colour scale, from 0 to the
/// highest density of any; difference maps have one from minus to plus their largest value. Vertices that
/// were never visible are grey.
///
/// Each file is in one space, the object's own (object_scale.h), in the unit that its format asks for: a .ply
/// in millimetres with densities per mm^2, a .glb in metres with densities per m^2. So density times area
/// adds up to the map's total in each, and it says its unit, and how large the object was shown.
///
/// Throws RecordError. Gives how many meshes were written.
int write_surfaces(const StudyResults& results, const std::filesystem::path& folder);

} // namespace overt
