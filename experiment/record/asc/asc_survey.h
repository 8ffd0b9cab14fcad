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
    AscTrialCutter::By cut_by = AscTrialCutter::By::recordings;
    int trials = 0;
    std::vector<std::optional<int>> trial_numbers; ///< that their TRIALIDs name, cut by these
    AscFormat format;                              ///< at the file's end
    std::string header;
    std::int64_t samples = 0, samples_without_gaze = 0, events = 0;
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

/// Reads the files; each line that is skipped is reported. Throws InputError if it cannot be read, if it is
/// no recording of an EyeLink with gaze on a screen, or if the tracker's clock began anew in it.
AscSurvey survey_asc(const AscFiles& files, const AscReport& report,
                     const std::function<void(std::int64_t, std::int64_t)>& progress = {});

/// Progress of the first (0) or second (1) reading of the same files, as part of both.
using ByteProgress = std::function<void(std::int64_t done, std::int64_t all)>;
ByteProgress part_of(const ByteProgress& progress, int reading);

} // namespace overt
