/// Sessions read into one study: trials, fixations on the surface, data quality.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "experiment/maps/surface_point.h"
#include "experiment/record/read/session_record.h"
#include "experiment/study/read/object_surface.h"
#include "experiment/study/read/trial_reader.h"
#include "experiment/study/results/study_groups.h"
#include "experiment/study/results/study_options.h"

namespace overt {

/// The lookup of a session's object in a view, or null if it has no surface; with a mesh it is a
/// CoordinateMaps. `session` counts the study's sessions. What it gave is used until the next call. Throws
/// InputError or RecordError if files are missing or damaged, which the study then says.
using SurfaceFor = std::function<const SurfaceLookup*(const SessionRecord& record, std::size_t session,
                                                      const ViewedObject& viewed)>;

/// Told what is being done and how much of it is: work is in pieces of unequal length.
using StudyProgress = std::function<void(std::string_view what, int done, int total)>;

struct ReadStudy {
    StudyResults results;                ///< sessions, objects, trials, fixations, quality, traces, remarks
    std::vector<ObjectSurface> surfaces; ///< by object
    LevelLists levels;                   ///< tasks, objects, materials and blocks as protocols have them
};

/// What is read from a session's samples: nearly all the work of a study, and none of it concerns others.
struct ReadSession {
    std::filesystem::path session; ///< absolute
    std::string state;             ///< of the recording: another text if it went on since
    std::string events;            ///< see StudySession
    std::vector<ReadTrial> trials; ///< as the session has them; those that do not count are empty
};

/// Reads the samples of some of a study's sessions, for join_sessions(). Throws as read_study does.
std::vector<ReadSession> read_sessions(std::span<const std::filesystem::path> sessions,
                                       const SurfaceFor& surface_for, const StudyOptions& options,
                                       const StudyProgress& progress);

/// The study of sessions that were read by read_sessions() with the same options, here or elsewhere: the same
/// as read_study() of them, to the bit. They must lie where they lay. Throws InputError if one has gone on
/// since, and as read_study does.
ReadStudy join_sessions(std::vector<ReadSession> read, const SurfaceFor& surface_for,
                        const StudyOptions& options, const StudyProgress& progress);

/// Reads all trials that count. Object after object, so that only one's maps are in memory; within one,
/// sessions on all processors. The result does not depend on how many. Throws InputError if a folder is no
/// session or is given twice, RecordError for a damaged one.
ReadStudy read_study(std::span<const std::filesystem::path> sessions, const SurfaceFor& surface_for,
                     const StudyOptions& options, const StudyProgress& progress);

} // namespace overt
