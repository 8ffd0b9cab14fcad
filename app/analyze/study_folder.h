/// A folder with all that a study gives: tables, figures and the report.
#pragma once

#include <filesystem>
#include <span>

#include "app/cli/shard.h"
#include "experiment/base/export_folder.h"
#include "experiment/record/tables/table_writer.h"
#include "experiment/study/read/study_shard.h"
#include "experiment/study/results/study_options.h"

namespace overt {

/// Reads and reckons, with progress on the terminal. An Interruption has to live; Ctrl-C ends this with an
/// Error. Throws as analyze_study does.
StudyResults analyzed(std::span<const std::filesystem::path> sessions, const StudyOptions& options);

/// Reads that part of the study's sessions, with progress. Throws InputError if a session is named twice, and
/// as read_sessions does.
StudyShard shard_of(std::span<const std::filesystem::path> sessions, const Shard& which,
                    const StudyOptions& options);

/// The study of all its shards' folders, in any order: the same as analyzed() of its sessions. Throws as
/// read_shard, joined_shards and join_sessions do.
StudyResults analyzed_shards(std::span<const std::filesystem::path> folders, const StudyOptions& options);

/// What is written besides tables, figures and report: it can take gigabytes for a large study.
struct StudyExtras {
    bool meshes = false;  ///< each map as a coloured mesh
    bool volumes = false; ///< each map in space, as voxels and as a look-up table
};

class StudyFolder {
  public:
    /// Throws as ExportFolder does: an earlier study is replaced only with `overwrite`.
    StudyFolder(const std::filesystem::path& directory, bool overwrite);

    /// Writes everything and gives the folder its name. Throws RecordError.
    void publish(const StudyResults& results, TableFormat format, const StudyExtras& extras);

  private:
    ExportFolder folder_;
};

} // namespace overt
