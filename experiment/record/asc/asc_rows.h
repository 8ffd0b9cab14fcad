/// The lines of an ASC file as rows of a session file.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiment/record/asc/asc_survey.h"
#include "experiment/record/gaze_rows.h"

namespace overt {

/// One trial of the file, once it is over. A fixation, saccade or blink that spans its begin counts to it by
/// its end, and does not make it begin earlier.
struct AscTrialTimes {
    int trial = -1;                                          ///< in the file, from 0
    TrackerTime first;                                       ///< of its TRIALID, or of its first line
    std::map<std::string, TrackerTime, std::less<>> screens; ///< by the messages of asc_trial.h
    bool is_aborted = false;
};

/// Inserts samples and events while an AscParser reads.
class AscRows final : public AscListener {
  public:
    /// Under which trial_id the rows of a trial of the file go; nothing: they are left out.
    using TrialId = std::function<std::optional<std::int64_t>(int trial)>;

    /// Lines that cannot be read become events of the sitting. `trial_over` is told each trial after its last
    /// line, also those that are left out.
    AscRows(GazeRows& rows, int sitting, AscTrialCutter::By cut_by, TrialId trial_id,
            std::function<void(const AscTrialTimes&)> trial_over);

    void header(std::string_view) override {}
    void samples(std::span<const GazeSample> samples) override;
    void event(const GazeEvent& event) override;
    void malformed(std::int64_t line, std::string_view why, std::string_view text) override;
    /// After the parser's end.
    void end();

  private:
    void begin_trial();
    void follow_cutter(bool begins);
    void take_time(TrackerTime time);

    GazeRows& rows_;
    int sitting_;
    AscTrialCutter cutter_;
    TrialId trial_id_;
    std::function<void(const AscTrialTimes&)> trial_over_;
    std::optional<std::int64_t> into_ = 0; ///< the trial_id of what comes in
    AscTrialTimes times_;
    bool has_time_ = false, is_after_ = false;
};

} // namespace overt
