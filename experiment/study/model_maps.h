/// Maps of models, on the surfaces of a study's objects.
#pragma once

#include <string>
#include <vector>

#include "experiment/study/read/study_reader.h"
#include "experiment/study/results/study_options.h"

namespace overt {

/// Where a model says that gaze goes: a density on one object's surface.
struct ModelMap {
    std::string name; ///< its file's, without folders and ending
    int object = 0;
    std::vector<double> by_node; ///< of the surface, >= 0, on any scale
};

/// Each file of the options on the object that it names, or on each that it fits: whose surface has a vertex
/// of the file nearer than 2 % of its diagonal to 98 of 100 nodes. Places are in millimetres, as those of the
/// meshes that `overt analyze --meshes` writes, or in the unit of the object's own mesh. A node has the
/// number of the vertex that is nearest to it. Throws InputError for a file that cannot be read
/// (read_vertex_values), numbers below 0 or all 0, an object that there is not, and a file that fits none.
std::vector<ModelMap> model_maps(const StudyResults& results, const std::vector<ObjectSurface>& surfaces,
                                 const StudyOptions& options);

} // namespace overt
