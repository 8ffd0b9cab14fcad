/// EyeLink recordings in their text form (ASC) made into sessions.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "experiment/events/event_thresholds.h"
#include "experiment/record/asc/asc_survey.h"
#include "experiment/record/session_directory.h"
#include "experiment/record/session_header.h"

namespace overt {

struct AscImportOptions {
    /// Whose session, and among which. The name of the protocol stands for the task.
    SessionPlace place;
    std::optional<int> session_number;
    std::filesystem::path out;                 ///< the session's folder itself; empty: by `place`
    std::optional<glm::dvec2> screen_mm;       ///< what the file says of it otherwise
    std::optional<double> viewing_distance_mm; ///< the same
    /// It is noted that fixations, saccades and blinks are to be found in the samples, by these thresholds.
    std::optional<ChosenThresholds> detect_events;
    ProgramBuild program;     ///< that imports
    std::string now_utc;      ///< for files without a date
    AscSurveyOptions reading; ///< how the file is read; its report and progress, too
};

struct AscImportSummary {
    std::filesystem::path session;
    AscSurvey survey;
    int trials = 0;
    std::vector<std::string> remarks; ///< whole sentences on what is not as in the file
};

/// Makes a session of a recording: its samples, its trials (see AscTrialCutter), its own events and messages.
/// The session's clock begins with the file's first line. What the file does not say (objects, questions)
/// stays empty; a viewing distance or screen size that nobody knows is 0. Memory does not grow with the file.
///
/// The session's directory appears when it is complete; nothing is overwritten. Throws InputError as
/// survey_asc() does or if there is a session at that place, RecordError if it cannot be written.
AscImportSummary import_asc(const AscFiles& files, const AscImportOptions& options);

/// Makes a copy of a session in which the gaze of one sitting is that of the file: that of the trials which
/// messages TRIALID name, in the order of their attempts. The sitting is the one that most of them fit. Where
/// the session's readings of the tracker's clock do not go with the file's times, the two are related by the
/// messages that say when a trial's screens came (see asc_trial.h). The session itself is left as it is.
///
/// `options.out` names the copy, or else it has the session's name in the folder FOLDER_imports beside the
/// FOLDER that the session lies in. Throws InputError as above,
/// or if no trial fits, or if nothing relates the clocks; RecordError.
AscImportSummary import_asc_into(const AscFiles& files, const std::filesystem::path& session,
                                 const AscImportOptions& options);

/// What every import keeps of its file besides rows.
GazeSource gaze_source_of(const AscFiles& files, const AscSurvey& survey);
/// Notes by which thresholds the sitting's events are to be found, if that was asked for, and says so in a
/// remark; else says how events are had where the file has none. `folder`: of the session, whose rows are all
/// there; `file`: for messages. Throws InputError if angles are unknown, or if there are no samples.
void note_detection(const std::filesystem::path& folder, int sitting, const std::string& file,
                    const AscImportOptions& options, AscImportSummary& summary);
/// Remarks on what no import keeps.
void add_asc_remarks(AscImportSummary& summary);

} // namespace overt
