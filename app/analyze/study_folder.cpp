#include "app/analyze/study_folder.h"

#include <algorithm>

#include <fmt/format.h>

#include "app/analyze/study_surfaces.h"
#include "app/cli/interruption.h"
#include "app/cli/progress_bar.h"
#include "experiment/base/error.h"
#include "experiment/report/report_page.h"
#include "experiment/report/surface_files.h"
#include "experiment/report/volume_maps.h"
#include "experiment/study/analyze_study.h"
#include "experiment/study/tables/study_tables.h"
#include "render/figures/study_figures.h"

namespace overt {

namespace {

/// Does the work with a progress bar.
template <class Work> auto with_progress(const Work& work) {
    ProgressBar bar;
    auto results = work([&](std::string_view what, int done, int all) {
        bar.update(what, done, all);
        Interruption::check("The analysis");
    });
    bar.finish();
    return results;
}

} // namespace

StudyResults analyzed(std::span<const std::filesystem::path> sessions, const StudyOptions& options) {
    return with_progress([&](const StudyProgress& progress) {
        return analyze_study(sessions, StudySurfaces(), options, progress);
    });
}

StudyShard shard_of(std::span<const std::filesystem::path> sessions, const Shard& which,
                    const StudyOptions& options) {
    StudyShard shard{which.number, which.count, {}, reading_parameters(options), {}};
    std::vector<std::filesystem::path> own;
    for (std::size_t i = 0; i < sessions.size(); ++i) {
        const std::filesystem::path session = std::filesystem::weakly_canonical(sessions[i]);
        if (std::ranges::find(shard.sessions, session.string()) != shard.sessions.end())
            throw InputError(fmt::format("{}: this session was named twice.", session.string()));
        shard.sessions.push_back(session.string());
        if (static_cast<int>(i % static_cast<std::size_t>(which.count)) == which.number - 1)
            own.push_back(session);
    }
    if (!own.empty())
        shard.read = with_progress([&](const StudyProgress& progress) {
            return read_sessions(own, StudySurfaces(), options, progress);
        });
    return shard;
}

StudyResults analyzed_shards(std::span<const std::filesystem::path> folders, const StudyOptions& options) {
    std::vector<StudyShard> shards;
    std::vector<std::string> names;
    for (const std::filesystem::path& folder : folders) {
        shards.push_back(read_shard(folder));
        names.push_back(folder.string());
    }
    std::vector<ReadSession> read = joined_shards(std::move(shards), names, options);
    return with_progress([&](const StudyProgress& progress) {
        return analyze_study(join_sessions(std::move(read), StudySurfaces(), options, progress), options,
                             progress);
    });
}

StudyFolder::StudyFolder(const std::filesystem::path& directory, bool overwrite)
    : folder_(directory, overwrite, [](const std::string& file) {
          return is_study_table(file) || file == "report.html" || file == "figures" || file == "meshes" ||
                 file == "volumes";
      }) {}

void StudyFolder::publish(const StudyResults& results, TableFormat format, const StudyExtras& extras) {
    write_study_tables(results, folder_.path(), format);
    write_figures(results, folder_.path() / "figures");
    if (extras.meshes)
        write_surfaces(results, folder_.path() / "meshes");
    if (extras.volumes)
        write_volumes(results, folder_.path() / "volumes");
    write_report(results, folder_.path() / "report.html");
    folder_.publish();
}

} // namespace overt
