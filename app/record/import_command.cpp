#include <algorithm>
#include <cctype>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/cli/interruption.h"
#include "app/cli/progress_bar.h"
#include "app/cli/this_program.h"
#include "app/inputs/session_folders.h"
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

nlohmann::ordered_json to_json(const AscReadShare& share) {
    nlohmann::ordered_json json;
    if (share.start)
        json["start_ms"] = share.start->time_since_epoch().count() / 1000;
    json["sample_lines"] = share.sample_lines;
    json["samples_read"] = share.samples_read;
    json["event_lines"] = share.event_lines;
    json["events_read"] = share.events_read;
    return json;
}

/// Lines before the first START count only if they are samples' or events'.
std::vector<AscReadShare> recordings_of(const AscSurvey& survey) {
    std::vector<AscReadShare> recordings;
    for (const AscReadShare& share : survey.recordings)
        if (share.start || share.sample_lines > 0 || share.event_lines > 0)
            recordings.push_back(share);
    return recordings;
}

nlohmann::ordered_json to_json(const AscImportSummary& summary) {
    const AscSurvey& survey = summary.survey;
    nlohmann::ordered_json recordings = nlohmann::ordered_json::array();
    for (const AscReadShare& share : recordings_of(survey))
        recordings.push_back(to_json(share));
    return {{"session", summary.session.string()},
            {"trials", summary.trials},
            {"samples", survey.samples},
            {"samples_without_gaze", survey.samples_without_gaze},
            {"events", survey.events},
            {"lines", survey.lines},
            {"skipped_lines", survey.skipped_lines},
            {"recordings", recordings},
            {"rate_hz", survey.rate_hz},
            {"remarks", summary.remarks}};
}

/// A line for each recording; of many only for those that were not read whole.
void print_recordings(const AscSurvey& survey) {
    constexpr std::size_t many = 12;
    const std::vector<AscReadShare> recordings = recordings_of(survey);
    std::size_t whole = 0;
    for (std::size_t i = 0; i < recordings.size(); ++i) {
        const AscReadShare& share = recordings[i];
        const bool is_whole =
            share.samples_read == share.sample_lines && share.events_read == share.event_lines;
        whole += is_whole;
        if (recordings.size() > many && is_whole)
            continue;
        fmt::print("recording {}{}: {} of {} samples' lines read, {} of {} events' lines\n", i + 1,
                   share.start ? fmt::format(", from {} ms", share.start->time_since_epoch().count() / 1000)
                               : std::string(),
                   share.samples_read, share.sample_lines, share.events_read, share.event_lines);
    }
    if (recordings.size() > many)
        fmt::print("{} of {} recordings: all of their samples' and events' lines read\n", whole,
                   recordings.size());
}

void print(const AscImportSummary& summary) {
    const AscSurvey& survey = summary.survey;
    if (survey.skipped_lines > shown_lines)
        fmt::print(stderr,
                   "… and {} more: all are events (\"line left out\") in the session and its tables\n",
                   counted(survey.skipped_lines - shown_lines, "line"));
    for (const std::string& remark : summary.remarks)
        fmt::print("{}\n", remark);
    print_recordings(survey);
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
                     options.observer.empty() ? label_from(options.files.front()) : options.observer,
                     options.is_another_person};
    request.session_number = options.session_number;
    request.out = options.out;
    if (options.screen_mm.size() == 2)
        request.screen_mm = glm::dvec2(options.screen_mm[0], options.screen_mm[1]);
    request.viewing_distance_mm = options.distance_mm;
    request.detect_events = options.events.detection();
    request.program = this_build();
    request.now_utc = utc_now();
    request.reading.missing = options.missing;
    request.reading.least_read = options.least_read;
    request.reading.is_gaze = options.as_gaze;
    request.reading.report = [&](const std::string& line) {
        if (reported++ < shown_lines)
            fmt::print(stderr, "{}\n", line);
    };
    request.reading.progress = [&](std::int64_t done, std::int64_t all) {
        constexpr std::int64_t kilobyte = 1024;
        bar.update("importing " + files.name() + ", kB", static_cast<int>(done / kilobyte),
                   static_cast<int>(all / kilobyte));
        Interruption::check("The import");
    };
    const AscImportSummary summary = options.into.empty()
                                         ? import_asc(files, request)
                                         : import_asc_into(files, session_in(options.into), request);
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
