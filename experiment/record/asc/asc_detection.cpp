/// What an import notes of finding fixations, saccades and blinks in its samples.
#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/record/asc/asc_import.h"
#include "experiment/record/asc/imported_session.h"
#include "experiment/record/gaze_rows.h"
#include "experiment/record/read/session_record.h"
#include "experiment/record/read/settings_words.h"
#include "experiment/record/session_schema.h"

namespace overt {

void note_detection(const std::filesystem::path& folder, int sitting, const std::string& file,
                    const AscImportOptions& options, AscImportSummary& summary) {
    using From = SessionRecord::EventOrigin::From;
    SessionRecord record(folder);
    const SessionRecord::EventOrigin of_file = record.event_origin(sitting);
    if (!options.detect_events) {
        if (of_file.from == From::nobody && summary.survey.samples > 0)
            summary.remarks.push_back(
                record.gaze_angles(sitting)
                    ? "The file has no fixations, saccades and blinks. `overt analyze` finds them in the "
                      "samples; for exports give --detect-events, now or to `overt export`."
                    : "The file has no fixations, saccades and blinks, and none can be found in the samples, "
                      "because angles are unknown: give --screen-mm and --distance-mm.");
        return;
    }
    record.detect_events(*options.detect_events);
    const SessionRecord::EventOrigin found = record.event_origin(sitting);
    if (found.from == From::no_angles)
        throw InputError(fmt::format(
            "{}: fixations, saccades and blinks cannot be found in it, because angles are unknown: it says "
            "neither how large the screen is and how far away, nor the tracker's pixels per degree (RES at "
            "the "
            "end of a recording). Give --screen-mm W H and --distance-mm.",
            file));
    if (found.from != From::reading)
        throw InputError(
            fmt::format("{}: has no samples to find fixations, saccades and blinks in. Leave out "
                        "--detect-events.",
                        file));
    write_session_rows(folder / session_file_name, [&](SQLite::Database& database) {
        GazeRows(database).detection(sitting, found.detection);
    });
    summary.remarks.push_back(fmt::format(
        "Fixations, saccades and blinks are found in the samples{}, with {}.",
        of_file.from == From::tracker ? ", and those of the file stay on record but are not used" : "",
        settings_in_words(found.detection.parameters)));
}

} // namespace overt
