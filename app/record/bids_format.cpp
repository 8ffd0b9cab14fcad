#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/record/export_formats.h"
#include "app/record/recorded_surface.h"
#include "experiment/record/bids/bids_export.h"

namespace overt {
namespace {

class Bids final : public ExportFormat {
  public:
    void add_options(CLI::App& command) override {
        command.add_flag(
            "--with-answers", with_answers_,
            "Copy the spoken answers into sourcedata, though a voice tells who somebody is; in bids");
    }

    std::string write(const ExportRequest& request) const override {
        // Trials of all objects come in turn.
        RecordedSurfaces surfaces(request.record, RecordedSurfaces::Keep::all,
                                  CoordinateMaps::Use::few_lookups);
        const BidsExportCounts counts = export_bids(
            request.record, [&](const ViewedObject& viewed) { return surfaces.lookup_of(viewed); },
            request.folder, {request.overwrite, with_answers_, request.progress});
        std::string said;
        for (const std::string& remark : counts.remarks)
            said += remark + '\n';
        return said + fmt::format("runs: {}, recordings of an eye: {}, samples: {}\ndataset: {}\n",
                                  counts.runs, counts.recordings, counts.samples, request.folder.string());
    }

  private:
    bool with_answers_ = false;
};

} // namespace

std::unique_ptr<ExportFormat> bids_format() { return std::make_unique<Bids>(); }

} // namespace overt
