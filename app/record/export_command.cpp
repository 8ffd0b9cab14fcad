#include <algorithm>

#include <fmt/format.h>

#include "app/cli/interruption.h"
#include "app/cli/progress_bar.h"
#include "app/record/record_commands.h"
#include "app/record/recorded_surface.h"
#include "experiment/base/counted.h"
#include "experiment/record/asc/asc_export.h"
#include "experiment/record/bids/bids_export.h"
#include "experiment/record/session_schema.h"
#include "experiment/record/tables/table_export.h"

namespace overt {

namespace {

/// With no dots and no separator at its end; the session file itself may be named.
std::filesystem::path folder_at(const std::filesystem::path& session) {
    const std::filesystem::path path = std::filesystem::absolute(session).lexically_normal();
    return path.has_filename() && path.filename() != session_file_name ? path : path.parent_path();
}

/// Where one of the sessions goes.
std::filesystem::path folder_of(const ExportOptions& options, const SessionRecord& record) {
    if (options.out.empty())
        return record.directory() / ("export_" + options.format);
    if (options.sessions.size() == 1)
        return options.out;
    // Observers of several protocols have folders of the same names.
    const std::filesystem::path folder = folder_at(record.directory());
    const auto namesakes =
        std::count_if(options.sessions.begin(), options.sessions.end(), [&](const auto& session) {
            const std::filesystem::path other = folder_at(session);
            return other.filename() == folder.filename() && other != folder;
        });
    return namesakes == 0 ? options.out / folder.filename()
                          : options.out / folder.parent_path().filename() / folder.filename();
}

std::function<void(int, int)> progress_on(ProgressBar& bar, const SessionRecord& record) {
    return
        [&bar, title = "exporting " + folder_at(record.directory()).filename().string()](int done, int all) {
            bar.update(title, done, all);
            Interruption::check("The export");
        };
}

void export_as_tables(const ExportOptions& options, const SessionRecord& record) {
    RecordedSurfaces surfaces(record);
    ProgressBar bar;
    TableExportOptions tables;
    tables.format = options.format == "csv"     ? TableFormat::csv
                    : options.format == "jsonl" ? TableFormat::jsonl
                                                : TableFormat::tsv;
    tables.overwrite = options.overwrite;
    if (options.cone_deg)
        tables.cone_accuracy = Degrees{*options.cone_deg};
    tables.progress = progress_on(bar, record);
    const std::filesystem::path out = folder_of(options, record);
    const TableExportCounts counts = export_tables(
        record, [&](int sculpture) { return surfaces.lookup_of(sculpture); }, out, tables);
    bar.finish();
    const auto share = [&](std::int64_t part) {
        return counts.samples > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(counts.samples)
                                  : 0.0;
    };
    fmt::print("{}, {}, {}: {:.1f} % on the sculpture, {:.1f} % without gaze, "
               "{} that the planned times would have put on another frame\nexport: {}\n",
               counted(counts.trials, "trial"), counted(counts.flips, "refresh", "refreshes"),
               counted(counts.samples, "sample"), share(counts.samples_on_object),
               share(counts.samples_without_gaze), counts.samples_off_plan, out.string());
}

void export_as_asc(const ExportOptions& options, const SessionRecord& record) {
    ProgressBar bar;
    const std::filesystem::path out = folder_of(options, record);
    const AscExportCounts counts =
        export_asc(record, out, {options.overwrite, options.fractional_times, progress_on(bar, record)});
    bar.finish();
    if (counts.sittings_without_samples > 0)
        fmt::print("{} without samples, and without a file\n",
                   counted(counts.sittings_without_samples, "sitting"));
    fmt::print("{} at trials, {}, {}\nexport: {}\n", counted(counts.trials, "attempt"),
               counted(counts.samples, "sample"), counted(counts.files, "file"), out.string());
}

void export_as_bids(const ExportOptions& options, const SessionRecord& record) {
    RecordedSurfaces surfaces(record);
    ProgressBar bar;
    const std::filesystem::path out =
        options.out.empty() ? record.directory() / "export_bids" : options.out; // one dataset of all
    const BidsExportCounts counts =
        export_bids(record, [&](int sculpture) { return surfaces.lookup_of(sculpture); }, out,
                    {options.overwrite, options.with_answers, progress_on(bar, record)});
    bar.finish();
    for (const std::string& remark : counts.remarks)
        fmt::print("{}\n", remark);
    fmt::print("runs: {}, recordings of an eye: {}, samples: {}\ndataset: {}\n", counts.runs,
               counts.recordings, counts.samples, out.string());
}

} // namespace

int run_export(const ExportOptions& options) {
    const Interruption interruption;
    for (const std::filesystem::path& session : options.sessions) {
        const SessionRecord record(session);
        if (options.format == "asc")
            export_as_asc(options, record);
        else if (options.format == "bids")
            export_as_bids(options, record);
        else
            export_as_tables(options, record);
    }
    return 0;
}

} // namespace overt
