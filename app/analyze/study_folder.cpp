#include "app/analyze/study_folder.h"

#include "app/analyze/study_surfaces.h"
#include "app/cli/interruption.h"
#include "app/cli/progress_bar.h"
#include "experiment/report/report_page.h"
#include "experiment/report/surface_files.h"
#include "experiment/study/analyze_study.h"
#include "experiment/study/study_tables.h"
#include "render/figures/study_figures.h"

namespace overt {

StudyResults analyzed(std::span<const std::filesystem::path> sessions, const StudyOptions& options) {
    ProgressBar bar;
    StudyResults results =
        analyze_study(sessions, StudySurfaces(), options, [&](std::string_view what, int done, int all) {
            bar.update(what, done, all);
            Interruption::check("The analysis");
        });
    bar.finish();
    return results;
}

StudyFolder::StudyFolder(const std::filesystem::path& directory, bool overwrite)
    : folder_(directory, overwrite, [](const std::string& file) {
          return is_study_table(file) || file == "report.html" || file == "figures" || file == "meshes";
      }) {}

void StudyFolder::publish(const StudyResults& results, TableFormat format, StudyMeshes meshes) {
    write_study_tables(results, folder_.path(), format);
    write_figures(results, folder_.path() / "figures");
    if (meshes == StudyMeshes::written)
        write_surfaces(results, folder_.path() / "meshes");
    write_report(results, folder_.path() / "report.html");
    folder_.publish();
}

} // namespace overt
