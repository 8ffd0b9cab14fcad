#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/record/export_formats.h"
#include "app/record/recorded_surface.h"
#include "experiment/base/counted.h"
#include "experiment/record/tables/table_export.h"

namespace overt {
namespace {

class Tables final : public ExportFormat {
  public:
    void add_options(CLI::App& command) override {
        command
            .add_option(
                "--cone-deg", cone_deg_,
                "Add the probability that the gaze was on the object, and on each of its parts, for a "
                "tracker that is so far off on average (a usual accuracy: 0.5); in tables")
            ->type_name("DEG")
            ->check(CLI::Range(0.0, 20.0));
    }

    std::string write(const ExportRequest& request) const override {
        // A cone asks for many places around each sample.
        RecordedSurfaces surfaces(request.record, RecordedSurfaces::Keep::last,
                                  cone_deg_ ? CoordinateMaps::Use::many_lookups
                                            : CoordinateMaps::Use::few_lookups);
        TableExportOptions options;
        options.format = format_named(request.format);
        options.overwrite = request.overwrite;
        if (cone_deg_)
            options.cone_accuracy = Degrees{*cone_deg_};
        options.progress = request.progress;
        const TableExportCounts counts = export_tables(
            request.record, [&](const ViewedObject& viewed) { return surfaces.lookup_of(viewed); },
            request.folder, options);
        const auto share = [&](std::int64_t part) {
            return counts.samples > 0
                       ? 100.0 * static_cast<double>(part) / static_cast<double>(counts.samples)
                       : 0.0;
        };
        return fmt::format("{}, {}, {}: {:.1f} % on the object, {:.1f} % without gaze, "
                           "{} that the planned times would have put on another frame\nexport: {}\n",
                           counted(counts.trials, "trial"), counted(counts.flips, "refresh", "refreshes"),
                           counted(counts.samples, "sample"), share(counts.samples_on_object),
                           share(counts.samples_without_gaze), counts.samples_off_plan,
                           request.folder.string());
    }

    std::string write_pooled(std::string_view format, const std::vector<std::filesystem::path>& sessions,
                             const std::filesystem::path& folder) const override {
        std::vector<ParticipantRow> rows;
        for (const std::filesystem::path& session : sessions)
            rows.push_back(participant_row(SessionRecord(session)));
        return fmt::format("participants: {}\n",
                           write_participants(rows, folder, format_named(format)).string());
    }

  private:
    static TableFormat format_named(std::string_view name) {
        for (const TableFormat format : {TableFormat::csv, TableFormat::jsonl})
            if (name == ending_of(format))
                return format;
        return TableFormat::tsv;
    }

    std::optional<double> cone_deg_;
};

} // namespace

std::unique_ptr<ExportFormat> table_format() { return std::make_unique<Tables>(); }

} // namespace overt
