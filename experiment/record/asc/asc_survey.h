/// What an ASC file holds, found by reading it once: what must be known before its rows can be written.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "experiment/record/asc/asc_files.h"

namespace overt {

/// Cuts a recording into trials. Where there are messages TRIALID, each begins a trial that lasts until its
/// TRIAL_RESULT, or without one until the next, and what is recorded before the first belongs to the first;
/// else each START begins one. Lines before all of that, and between a TRIAL_RESULT and the next TRIALID,
/// belong to none.
class AscTrialCutter {
  public:
    enum class By : std::uint8_t { trial_ids, recordings };
    explicit AscTrialCutter(By by) : by_(by) {}

    /// Gives true if a trial begins with this.
    bool take(const GazeEvent& event);
    bool take_sample();
    /// What was taken last came after the result of the last trial.
    bool is_after_trial() const { return is_after_; }
    /// From 0; -1 before the first.
    int trial() const { return trial_; }

  private:
    bool begin();
    By by_;
    int trial_ = -1;
    bool began_early_ = false; ///< before its TRIALID
    bool is_over_ = false, is_after_ = false;
};

/// The number in "TRIALID 12"; nothing if there is none.
std::optional<int> asc_trial_number(const GazeEvent& event);
bool is_trial_id(const GazeEvent& event);

struct AscSurvey : AscCounts {
    AscConventions conventions;           ///< for whoever reads the file again
    std::vector<AscReadShare> recordings; ///< as AscParser has them
    AscTrialCutter::By cut_by = AscTrialCutter::By::recordings;
    int trials = 0;
    std::vector<std::optional<int>> trial_numbers; ///< that their TRIALIDs name, cut by these
    AscFormat format;                              ///< at the file's end
    std::string header;
    std::int64_t samples = 0, samples_without_gaze = 0, events = 0;
    std::int64_t places = 0,
                 places_off_screen = 0;       ///< of samples; beyond the left or upper edge, or far beyond
    bool has_left = false, has_right = false; ///< of all recordings
    TrackerTime first, last;                  ///< of all lines
    double rate_hz = 0.0;                     ///< the highest that the file names, or by its closest samples
    std::optional<glm::ivec2> screen_px;
    std::optional<glm::dvec2> screen_mm;
    std::optional<double> viewing_distance_mm, refresh_hz;
    std::optional<glm::dvec2> px_per_deg;
    std::int64_t skipped_lines = 0;
};

/// "LINE: why: the line", which is cut short and of ASCII.
std::string skipped_line_text(std::int64_t line, std::string_view why, std::string_view text);

/// A line that could not be read: "FILE:LINE: why: the line".
using AscReport = std::function<void(const std::string&)>;

/// How a file is to be surveyed.
struct AscSurveyOptions {
    AscReport report; ///< told each line that is skipped; may be empty
    std::function<void(std::int64_t done, std::int64_t all)>
        progress; ///< in bytes that are read; may be empty
    /// What the file has in place of lost values; nothing: it is found.
    std::optional<std::string> missing;
    /// Of a recording's lines of samples, and of its lines of events, so large a share must be read.
    double least_read = 0.9;
    /// Samples of which the file does not say what they are, and that mostly lie off the screen, are gaze.
    bool is_gaze = false;
};

/// Reads the files twice. Throws InputError if they cannot be read, if they are no recording of an EyeLink
/// with gaze on a screen, if too little of a recording can be read, if two files do not belong together, or
/// if the tracker's clock began anew.
AscSurvey survey_asc(const AscFiles& files, const AscSurveyOptions& options);

using ByteProgress = std::function<void(std::int64_t done, std::int64_t all)>;
/// Progress of `readings` of the same files, after `before` others and as part of `all`.
ByteProgress part_of(const ByteProgress& progress, int before, int readings, int all);

} // namespace overt
