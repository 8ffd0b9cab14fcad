#include <fmt/format.h>

#include "app/commands.h"
#include "app/progress_bar.h"
#include "app/recorded_surface.h"
#include "experiment/record/table_export.h"

namespace overt {

int run_export(const ExportOptions& options) {
    for (const std::filesystem::path& session : options.sessions) {
        const SessionRecord record(session);
        std::filesystem::path out =
            options.out.empty() ? record.directory() / ("export_" + options.format) : options.out;
        if (!options.out.empty() && options.sessions.size() > 1)
            out /= record.directory().filename();
        RecordedSurfaces surfaces(record);
        ProgressBar bar;
        TableExportOptions tables;
        tables.format = options.format == "csv" ? TableFormat::csv : TableFormat::tsv;
        tables.overwrite = options.overwrite;
        if (options.cone_deg)
            tables.cone_accuracy = Degrees{*options.cone_deg};
        tables.progress = [&](int done, int all) {
            bar.update("exporting " + record.directory().filename().string(), done, all);
        };
        const TableExportCounts counts = export_tables(
            record, [&](int sculpture) { return surfaces.lookup_of(sculpture); }, out, tables);
        bar.finish();
        const auto share = [&](std::int64_t part) {
            return counts.samples > 0
                       ? 100.0 * static_cast<double>(part) / static_cast<double>(counts.samples)
                       : 0.0;
        };
        fmt::print("{} trials, {} refreshes, {} samples: {:.1f} % on the sculpture, {:.1f} % without gaze, "
                   "{} that the planned times "
                   "would have put on another frame\nexport: {}\n",
                   counts.trials, counts.flips, counts.samples, share(counts.samples_on_object),
                   share(counts.samples_without_gaze), counts.samples_off_plan, out.string());
    }
    return 0;
}

} // namespace overt
