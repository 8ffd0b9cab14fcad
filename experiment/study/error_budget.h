/// How far the places of a map's fixations can be trusted, in millimetres on the surface.
#pragma once

#include "experiment/study/read/study_reader.h"

namespace overt {

/// Sets StudyMap::error and StudyMap::euclidean_leak of all maps on one object that have fixations:
///
/// - accuracy: StudyFixation::cone_mm, where a validation was made before the trial;
/// - precision: RMS-S2S of the trial divided by the root of 2, which is the standard deviation of a sample if
///   the noise of successive samples is independent, converted at the fixation's depth;
/// - look-up: StudyFixation::lut_mm;
/// - timing: the bound on the error of the samples' times, divided by the root of 3 (a rectangular
///   distribution, GUM 4.3.7), times the speed of the surface at the fixation's place: its distance from the
///   axis times the speed of the turn, from the frames shown during it and one before and after.
///
/// The Euclidean leak is that of a Gaussian in space on the coarse surface, fixation by fixation.
void add_error_budget(StudyResults& results, int object, const ObjectSurface& surface);

/// How fast the surface moved under a fixation, in mm/s; 0 where the object stood, nothing where it is not
/// known which frames were shown or how large they are.
std::optional<double> surface_speed_mm_s(const StudyFixation& fixation, const StudyTrial& trial,
                                         const StudyObject& object);

} // namespace overt
