#include <algorithm>
#include <optional>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/record/export_formats.h"
#include "app/record/recorded_protocol.h"
#include "app/record/recorded_surface.h"
#include "experiment/base/counted.h"
#include "experiment/base/error.h"
#include "experiment/protocol/clear_glass.h"
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
        command.add_flag("--through", far_points_,
                         "Add where on the far side of bodies of clear glass the line of sight leaves; in "
                         "tables");
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
            options.further.cone_accuracy = Degrees{*cone_deg_};
        options.further.far_points = far_points_;
        std::vector<std::optional<double>> clear_glass;
        if (far_points_)
            clear_glass = clear_glass_of(request.record);
        options.progress = request.progress;
        const TableExportCounts counts = export_tables(
            request.record, [&](const ViewedObject& viewed) { return surfaces.lookup_of(viewed); },
            request.folder, options,
            [&](const ViewedObject& viewed, int material) {
                const std::optional<double>& index = item(clear_glass, material);
                return index ? surfaces.glass_of(viewed, *index) : nullptr;
            });
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

    /// By the place of each material of the session, the index of what is clear glass. Throws InputError if
    /// none is, or nobody knows.
    static std::vector<std::optional<double>> clear_glass_of(const SessionRecord& record) {
        const auto refuse = [&](const std::string& why) {
            return InputError(fmt::format("{}: --through: {}", record.directory().string(), why));
        };
        Diagnostics diagnostics;
        const std::optional<Protocol> protocol = recorded_protocol(record.header(), diagnostics);
        if (!protocol)
            throw refuse("its protocol, which says what is of glass, cannot be used by this version of the "
                         "program:\n" +
                         diagnostics.print());
        std::vector<std::optional<double>> indices;
        for (const ListEntry& recorded : record.header().materials) {
            const auto settings = std::ranges::find(protocol->materials, recorded.id, &MaterialSettings::id);
            indices.push_back(settings != protocol->materials.end() ? clear_glass_index(*settings)
                                                                    : std::nullopt);
        }
        if (std::ranges::none_of(indices, [](auto& index) { return index.has_value(); }))
            throw refuse("none of its materials is polished glass (`kind = \"glass\"` without `roughness`), "
                         "and through nothing else goes a line of sight");
        return indices;
    }

    std::optional<double> cone_deg_;
    bool far_points_ = false;
};

} // namespace

std::unique_ptr<ExportFormat> table_format() { return std::make_unique<Tables>(); }

} // namespace overt
