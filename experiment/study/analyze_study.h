/// A study from its sessions: everything that tables, figures and the report show.
#pragma once

#include "experiment/study/read/study_reader.h"

namespace overt {

/// Reckons. Bad input that leaves something to say is said in the results: sessions of
/// different protocols, missing maps, groups without fixations, a single observer. Throws InputError for a
/// column that no trial has. The same study and options give the same results on any number of processors.
StudyResults analyze_study(ReadStudy study, const StudyOptions& options, const StudyProgress& progress);

/// The same of sessions that are read now. Throws as read_study does, too.
StudyResults analyze_study(std::span<const std::filesystem::path> sessions, const SurfaceFor& surface_for,
                           const StudyOptions& options, const StudyProgress& progress);

} // namespace overt
