/// What a recording's eye tracker delivered, trial by trial.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiment/base/scratch_folder.h"
#include "experiment/ports/eye_tracker.h"
#include "experiment/record/read/session_record.h"

namespace overt {

/// One attempt at a trial.
struct ReplayedTrial {
    std::int64_t attempt_id = 0;      ///< in the record
    std::optional<TrackerTime> onset; ///< of the presentation; nothing: the recording does not tell it
    std::optional<Degrees> drift;     ///< that its drift check found
    std::string object, material;     ///< empty: the recording does not tell them
    std::vector<TrackerItem> items;   ///< in the order of their times
};

class ReplaySource {
  public:
    /// A session's folder, or an EyeLink recording (ASC), which is imported into a folder that goes with
    /// this. Throws InputError if it is neither or has no gaze, RecordError if it cannot be read.
    explicit ReplaySource(const std::filesystem::path& recording);

    const SessionRecord& record() const { return *record_; }
    Eye eye() const { return eye_; }
    bool both_eyes() const { return both_eyes_; }
    bool tells_events() const {
        return tells_events_;
    } ///< fixations, saccades and blinks of the tracker's own

    /// The tracker's clock in the first of the recordings.
    const ClockMap& clock() const { return *clock_; }

    /// The n-th attempt at a trial that has samples, from 1; the last for a larger number; nothing if there
    /// is none. Reads its samples.
    std::optional<ReplayedTrial> attempt_at(int trial, int number) const;

    /// The n-th set-up, from 1; the last for a larger number; nothing if the recording tells of none.
    std::optional<RecordedCalibration> calibration(int number) const;

  private:
    std::unique_ptr<ScratchFolder> imported_; ///< of an ASC file
    std::unique_ptr<SessionRecord> record_;
    std::optional<ClockMap> clock_;
    Eye eye_ = Eye::right;
    bool both_eyes_ = false, tells_events_ = false;
};

} // namespace overt
