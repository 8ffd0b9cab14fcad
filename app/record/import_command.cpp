#include <algorithm>
#include <cctype>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/cli/interruption.h"
#include "app/cli/progress_bar.h"
#include "app/cli/this_program.h"
#include "app/record/record_commands.h"
#include "experiment/base/counted.h"
#include "experiment/base/error.h"
#include "experiment/base/json_text.h"
#include "experiment/base/whole_file.h"
#include "experiment/record/asc/asc_import.h"

namespace overt {

namespace {

/// So many of the lines that were skipped are shown.
constexpr int shown_lines = 20;

std::string label_from(const std::filesystem::path& file) {
    std::string label;
    for (const char c : file.stem().string())
        if (std::isalnum(static_cast<unsigned char>(c)))
            label += c;
    if (label.empty())
        throw InputError(fmt::format("{}: this name has no letters or digits to name the observer by: give "
                                     "--observer.",
                                     file.string()));
    return label;
}

nlohmann::ordered_json to_json(const AscImportSummary& summary) {
    const AscSurvey& survey = summary.survey;
    return {{"session", summary.session.string()},
            {"trials", summary.trials},
            {"samples", survey.samples},
            {"samples_without_gaze", survey.samples_without_gaze},
            {"events", survey.events},
            {"lines", survey.lines},
            {"skipped_lines", survey.skipped_lines},
            {"rate_hz", survey.rate_hz},
            {"remarks", summary.remarks}};
}

void print(const AscImportSummary& summary) {
    const AscSurvey& survey = summary.survey;
    if (survey.skipped_lines > shown_lines)
        fmt::print(stderr,
                   "… and {} more: all are events (\"line left out\") in the session and its tables\n",
                   counted(survey.skipped_lines - shown_lines, "line"));
    for (const std::string& remark : summary.remarks)
        fmt::print("{}\n", remark);
    fmt::print("{}: {} at {:g} Hz, {} of them without gaze; {}; {}; {} that could not be read and left out\n"
               "session: {}\n",
               counted(survey.lines, "line"), counted(survey.samples, "sample"), survey.rate_hz,
               survey.samples_without_gaze, counted(survey.events, "event or message", "events and messages"),
               counted(summary.trials, "trial"), counted(survey.skipped_lines, "line"),
               summary.session.string());
}

} // namespace

int run_import(const ImportOptions& options) {
    if (options.files.size() > 2)
        throw InputError(
            fmt::format("{}: one recording is one file, or two (its samples and its events), not {}: "
                        "import each recording by itself.",
                        options.files[2].string(), options.files.size()));
    const Interruption interruption;
    ProgressBar bar;
    int reported = 0;
    const AscFiles files = options.files.size() == 2 ? AscFiles(options.files[0], options.files[1])
                                                     : AscFiles(options.files.front());
    AscImportOptions request;
    request.place = {options.sessions, options.task,
                     options.observer.empty() ? label_from(options.files.front()) : options.observer};
    request.session_number = options.session_number;
    request.out = options.out;
    if (options.screen_mm.size() == 2)
        request.screen_mm = glm::dvec2(options.screen_mm[0], options.screen_mm[1]);
    request.viewing_distance_mm = options.distance_mm;
    request.detect_events = options.events.detection();
    request.program = this_build();
    request.now_utc = utc_now();
    request.report = [&](const std::string& line) {
        if (reported++ < shown_lines)
            fmt::print(stderr, "{}\n", line);
    };
    request.progress = [&](std::int64_t done, std::int64_t all) {
        constexpr std::int64_t kilobyte = 1024;
        bar.update("importing " + files.name() + ", kB", static_cast<int>(done / kilobyte),
                   static_cast<int>(all / kilobyte));
        Interruption::check("The import");
    };
    const AscImportSummary summary =
        options.into.empty() ? import_asc(files, request) : import_asc_into(files, options.into, request);
    bar.finish();
    if (!options.print_session_to.empty())
        write_to(options.print_session_to, summary.session.string() + "\n");
    if (options.json)
        fmt::print("{}", json_text(to_json(summary)));
    else
        print(summary);
    return 0;
}

} // namespace overt
