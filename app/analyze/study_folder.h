/// A folder with all that a study gives: tables, figures and the report.
#pragma once

#include <filesystem>
#include <span>

#include "experiment/base/export_folder.h"
#include "experiment/record/tables/table_writer.h"
#include "experiment/study/study_options.h"

namespace overt {

/// Reads and reckons, with progress on the terminal. An Interruption has to live; Ctrl-C ends this with an
/// Error. Throws as analyze_study does.
StudyResults analyzed(std::span<const std::filesystem::path> sessions, const StudyOptions& options);

/// Whether coloured meshes of all maps are written, too, which take gigabytes for a large study.
enum class StudyMeshes : std::uint8_t { left_out, written };

class StudyFolder {
  public:
    /// Throws as ExportFolder does: an earlier study is replaced only with `overwrite`.
    StudyFolder(const std::filesystem::path& directory, bool overwrite);

    /// Writes everything and gives the folder its name. Throws RecordError.
    void publish(const StudyResults& results, TableFormat format, StudyMeshes meshes);

  private:
    ExportFolder folder_;
};

} // namespace overt
