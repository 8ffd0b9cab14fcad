#include "app/replay/remade_session.h"

#include <algorithm>

#include <fmt/format.h>

#include "app/cli/progress_bar.h"
#include "app/record/recorded_order.h"
#include "app/replay/found_events.h"
#include "app/replay/session_copies.h"
#include "app/replay/stimuli_again.h"
#include "app/session/session_recording.h"
#include "experiment/base/bytes_in_words.h"
#include "experiment/base/counted.h"
#include "experiment/design/schedule.h"
#include "experiment/record/session_schema.h"

namespace overt {

namespace {

namespace fs = std::filesystem;

/// The order as protocol and seed give it now.
Schedule order_again(const SessionRecord& record, ReplayReport& report) {
    const SessionHeader& header = record.header();
    Schedule schedule = header.schedule;
    const RecordedOrder order = recorded_order(header);
    if (!order.why_not.empty()) {
        report.not_compared.push_back("the order of the trials: " + order.why_not);
        return schedule;
    }
    schedule.trials = order.again;
    report.compared.push_back(fmt::format("the order of {}, made again from protocol and seed",
                                          counted(order.again.size(), "trial")));
    return schedule;
}

/// Only the maps that the record has: one with live maps has those that were lit.
void keep_recorded_maps(const SessionHeader& recorded, SessionHeader& now) {
    std::erase_if(now.maps, [&](RecordedMap& map) {
        const auto same =
            std::find_if(recorded.maps.begin(), recorded.maps.end(), [&](const RecordedMap& other) {
                return other.viewed == map.viewed && other.pose == map.pose;
            });
        if (same != recorded.maps.end())
            map.made = same->made;
        return same == recorded.maps.end();
    });
}

/// What devices and a person gave, in files of the session's folder.
std::vector<std::string> files_of_devices(const fs::path& recorded, const fs::path& remade) {
    const std::vector<std::string> made = files_of_session(remade, false);
    std::vector<std::string> others;
    for (const std::string& file : files_of_session(recorded, false)) {
        const bool is_ours =
            file.starts_with("maps/") || file.starts_with("meshes/") || file.starts_with("stimuli/");
        if (!is_ours && std::find(made.begin(), made.end(), file) == made.end())
            others.push_back(file);
    }
    return others;
}

void add_files(const FileComparison& comparison, const char* what, ReplayReport& report) {
    report.compared.push_back(fmt::format("{}: {}, {}", what, counted(comparison.files, "file"),
                                          in_bytes(static_cast<double>(comparison.bytes))));
    report.files.insert(report.files.end(), comparison.differences.begin(), comparison.differences.end());
}

} // namespace

void remake_session(const RemakeRequest& request, ReplayReport& report) {
    const SessionRecord& record = request.record;
    const SessionHeader& header = record.header();
    const Experiment& experiment = request.experiment;
    const Schedule schedule = order_again(record, report);

    StimuliAgain stimuli(experiment, cache_without_maps(request.cache, request.work / "cache"),
                         request.context);
    const std::string no_frames = stimuli.prepare(record, experiment.protocol);
    const bool has_pictures = no_frames.empty() && fs::exists(record.directory() / "stimuli");
    SessionHeader now = make_session_header(experiment.protocol, schedule, experiment.objects,
                                            stimuli.library(), stimuli.context().description(),
                                            header.tracker, header.clock, true, no_frames.empty());
    now.session_number = header.session_number;
    now.display.timing = header.display.timing; // what the display proved cannot be found again
    keep_recorded_maps(header, now);
    SessionDirectory directory(
        {request.work / "sessions", header.protocol.name, header.schedule.observer.label},
        header.session_number);
    put_files(directory, now, experiment.objects, stimuli.library(), has_pictures);
    directory.publish();

    const fs::path recorded_file = request.work / "recorded.sqlite";
    const fs::path remade_file = directory.path() / session_file_name;
    copy_session_file(record.directory() / session_file_name, recorded_file);
    take_what_happened(recorded_file, remade_file, !no_frames.empty());
    const RecordComparison found = compare_records(recorded_file, remade_file);
    report.differences = found.differences;
    if (found.unknown_frames > 0)
        report.not_compared.push_back(pixels_not_known(found.unknown_frames));
    report.compared.push_back(fmt::format("what stands fixed before the first trial{}",
                                          no_frames.empty() ? ", with the hashes of all frames" : ""));
    if (!no_frames.empty())
        report.not_compared.push_back("the frames: " + no_frames);
    report.not_compared.emplace_back(
        "flips, samples, answers and events themselves, which display, tracker and observer gave");
    compare_found_events(record, experiment.protocol.events, report);
    if (!report.is_same())
        return;

    std::vector<std::string> left_out = files_of_devices(record.directory(), directory.path());
    if (!left_out.empty())
        report.not_compared.push_back(
            fmt::format("{} of devices in the session's folder", counted(left_out.size(), "file")));
    if (!has_pictures)
        for (const std::string& file : files_of_session(record.directory(), false))
            if (file.starts_with("stimuli/"))
                left_out.push_back(file);
    add_files(compare_session_files(record.directory(), directory.path(), left_out),
              has_pictures ? "meshes, hidden maps drawn again, and pictures"
                           : "meshes, and hidden maps drawn again",
              report);
    if (!report.is_same())
        return;
    if (record.trials().empty()) {
        report.not_compared.emplace_back("exports: the session has no trials to export");
        return;
    }
    take_map_files(record, directory.path());
    take_circumstances(recorded_file, remade_file);
    ProgressBar bar;
    add_files(compare_exports(record.directory(), directory.path(), request.work / "exports",
                              [&](int done, int all) { bar.update("exporting both", done, all); }),
              "exports in all formats, from the recorded flips and gaze on the maps that were drawn again",
              report);
    bar.finish();
}

} // namespace overt
