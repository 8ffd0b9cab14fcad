#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/record/export_formats.h"
#include "experiment/base/counted.h"
#include "experiment/record/asc/asc_export.h"

namespace overt {
namespace {

class Asc final : public ExportFormat {
  public:
    void add_options(CLI::App& command) override {
        command.add_flag("--fractional-times", fractional_times_,
                         "Times with their microseconds, for MNE above 1000 Hz; PyGazeAnalyser reads whole "
                         "milliseconds only; in asc");
        command.add_flag(
            "--opensesame-messages", opensesame_messages_,
            "Messages start_trial, end_trial, start_phase, end_phase and var, too, which eyelinkparser "
            "(of OpenSesame) cuts trials by; in asc");
    }

    std::string write(const ExportRequest& request) const override {
        const AscExportCounts counts = export_asc(request.record, request.folder,
                                                  {.overwrite = request.overwrite,
                                                   .fractional_times = fractional_times_,
                                                   .opensesame_messages = opensesame_messages_,
                                                   .progress = request.progress});
        std::string said;
        if (counts.sittings_without_samples > 0)
            said = fmt::format("{} without samples: those whose events were not imported have no file\n",
                               counted(counts.sittings_without_samples, "sitting"));
        return said + fmt::format("{} at trials, {}, {}\nexport: {}\n", counted(counts.trials, "attempt"),
                                  counted(counts.samples, "sample"), counted(counts.files, "file"),
                                  request.folder.string());
    }

  private:
    bool fractional_times_ = false, opensesame_messages_ = false;
};

} // namespace

std::unique_ptr<ExportFormat> asc_format() { return std::make_unique<Asc>(); }

} // namespace overt
