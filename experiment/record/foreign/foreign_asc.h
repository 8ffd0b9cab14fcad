/// Recordings of an EyeLink in their text form, as gaze of another program and as its log of trials.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiment/ports/validation.h"
#include "experiment/record/asc/asc_files.h"
#include "experiment/record/asc/asc_survey.h"
#include "experiment/record/foreign/foreign_gaze.h"
#include "experiment/record/foreign/logged_trials.h"

namespace overt {

/// Whether this is the text form of a recording of an EyeLink's, by its name (.asc) or its first line.
bool is_asc_file(const std::filesystem::path& file);

/// Samples and messages of a recording; its fixations, saccades and blinks are not taken. A message
/// "N SYNCTIME" or "N !V …" is told without its whole number N, by how many milliseconds it came too late, at
/// the time that it is about (Data Viewer's way). One thread.
class AscGaze {
  public:
    /// One file, or its samples and its events (edf2asc -s and -e). Throws InputError.
    AscGaze(const std::vector<std::filesystem::path>& files, const GazeReading& reading);

    /// Throws InputError as survey_asc() does, and if the recording's screen has other pixels than
    /// `screen_px`, by more than one.
    GazeSurvey survey(glm::dvec2 screen_px, const RowReport& report) const;
    /// In the order of the file.
    void read(const std::function<void(const ForeignItem&)>& take) const;

  private:
    AscFiles files_;
    GazeReading reading_;
};

/// Trials by the recording's messages. TRIALID (or OpenSesame's start_trial) begins one and TRIAL_RESULT
/// (end_trial, stop_trial) ends it; without any, each onset is a trial. Its onset is the first message that
/// begins with `columns.onset`, or with SYNCTIME, or with PRESENTATION_ONSET, and its end that with
/// `columns.end`, or PRESENTATION_OFFSET. What was shown is in its variables ("!V TRIAL_VAR NAME VALUE",
/// OpenSesame's "var NAME VALUE"): those that are called as one of `factors` or "stimulus" are taken, and
/// those that `columns.words`, `answer`, `response_time` (in `unit`, else ms) and `correct` name; without any
/// of these a picture that a message loads ("!V IMGLOAD", "!V VFRAME") is the stimulus. Trials without an
/// onset are left out with a remark. Throws InputError, with the words that messages begin with, if there is
/// no onset, or if no trial has a variable that is named.
TrialLog trials_in_messages(const GazeSurvey& gaze, const TrialColumns& columns,
                            const std::vector<std::string>& factors, const std::filesystem::path& file);

/// A validation that the tracker's own messages tell.
struct ToldValidation {
    TrackerTime at;
    ValidationResult found;
};

/// Validations of an EyeLink by its messages "!CAL VALIDATION … ERROR 0.33 avg. 0.58 max" and
/// "VALIDATE R 9POINT 0 RIGHT at 512,384 OFFSET 0.17 deg. -2.0,5.8 pix.", those of both eyes as one. Those
/// that were given up are left out. Offsets are gaze less target.
std::vector<ToldValidation> validations_in_messages(std::span<const GazeMark> marks);

} // namespace overt
