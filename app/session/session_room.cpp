#include "app/session/session_room.h"

#include <algorithm>
#include <cstdint>
#include <system_error>

#include <fmt/format.h>

#include "experiment/base/bytes_in_words.h"
#include "experiment/base/error.h"
#include "experiment/checks/design_report.h"
#include "experiment/checks/recording_size.h"

namespace overt {

namespace {

namespace fs = std::filesystem;

/// The files that are going to be copied, instead of what is assumed of them. Objects that are frames only
/// have none.
double bytes_of_maps(const StimulusLibrary& library) {
    double bytes = 0.0;
    for (const ViewedObject& viewed : all_viewed_objects(library.cache().protocol())) {
        for (int pose = 0; pose < library.cache().poses().count(); ++pose) {
            std::error_code missing;
            const std::uintmax_t size = fs::file_size(library.cache().map_file(viewed, {pose}), missing);
            bytes += missing ? 0.0 : static_cast<double>(size);
        }
    }
    return bytes;
}

RecordingSize still_to_record(const Experiment& experiment, const SessionPlan& plan,
                              const StimulusLibrary& library, bool with_prepared_maps) {
    const int all = static_cast<int>(plan.schedule.trials.size());
    const int done = plan.resumed ? plan.resumed->history.counted_trials : 0;
    RecordingSize size = recording_size(experiment.protocol, experiment.objects, std::max(0, all - done),
                                        DesignAssumptions().answer_s);
    if (with_prepared_maps)
        size.maps = bytes_of_maps(library);
    if (plan.resumed)
        size.maps = size.meshes = size.pictures = 0.0;
    return size;
}

} // namespace

void require_room(const Experiment& experiment, const SessionPlan& plan, const StimulusLibrary& library,
                  bool with_prepared_maps, const fs::path& sessions) {
    const RecordingSize size = still_to_record(experiment, plan, library, with_prepared_maps);
    fs::path folder = fs::absolute(sessions);
    while (!fs::exists(folder) && folder.has_relative_path())
        folder = folder.parent_path();
    std::error_code unknown;
    const fs::space_info room = fs::space(folder, unknown);
    if (unknown || static_cast<double>(room.available) >= size.total())
        return;
    throw RecordError(fmt::format(
        "{}: {} free, and the session will take about {}. Make room on the disk or name another folder with "
        "--sessions, then run it again. The session was not {}, and nothing was written.",
        folder.string(), in_bytes(static_cast<double>(room.available)), to_text(size),
        plan.resumed ? "resumed" : "begun"));
}

} // namespace overt
