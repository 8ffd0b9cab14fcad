/// The landmarks by which an object is brought to a template.
#pragma once

#include <map>
#include <string>

#include <glm/glm.hpp>

#include "experiment/study/results/study_results.h"
#include "experiment/study/results/template_rows.h"

namespace overt {

/// Places of an object by their names, in mm from its origin.
using LandmarksByName = std::map<std::string, glm::dvec3>;

/// The places that the choice names of an object that has a mesh and mm_per_unit: points of its lists, each
/// called list.point, and rows of a table. Where the choice names neither, the middles of its named areas: of
/// their triangles by area.
LandmarksByName landmarks_of(const StudyObject& object, const TemplateChoice& choice);

} // namespace overt
