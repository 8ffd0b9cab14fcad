/// A session of what another program presented and another recorded: rows as a session of our own has them.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiment/flip_report.h"
#include "experiment/record/foreign/foreign_asc.h"
#include "experiment/record/foreign/foreign_gaze.h"
#include "experiment/record/foreign/logged_trials.h"
#include "experiment/record/foreign/shared_markers.h"
#include "experiment/record/resumption.h"
#include "experiment/record/session_header.h"

namespace overt {

/// What is asked under a task first, and of which kind (answer_kinds.h); empty: the protocol asks nothing.
struct AskedAnswer {
    std::string id, kind;
};

/// A logged trial with what the protocol calls it, and with its refreshes.
struct ForeignTrial {
    Trial trial;
    LoggedTrial logged;
    SessionTime onset, end;
    std::optional<SessionTime> responded;
    std::vector<FlipRecord> flips;
    std::vector<SlotFlip> slot_flips;
    SessionTime from, until; ///< whose samples are the trial's
};

struct ForeignPlan {
    std::vector<ForeignTrial> trials;
    ClockRelation clocks;
    std::vector<std::string> remarks; ///< whole sentences, those of the clocks among them
    std::vector<ToldValidation> validations = {};
};

/// Finds for each logged trial what the protocol calls it: task, entries of lists, slots, levels of its own;
/// and what was lit at each refresh: by the log of frames, or as the protocol plans it from the onset.
/// `header` has the protocol's lists and maps, and no trials. `may_have_others`: trials whose stimulus the
/// protocol does not have are left out with a remark, as the media of a whole recording may be. Throws
/// InputError at FILE:LINE.
ForeignPlan plan_foreign_trials(const SessionHeader& header, const TrialLog& log, const std::string& log_file,
                                const GazeSurvey& gaze, const std::optional<std::vector<LoggedFrame>>& frames,
                                bool may_have_others);

struct ForeignCounts {
    std::int64_t samples = 0, outside = 0; ///< of samples between trials, which are left out
};

/// Writes all rows of the one sitting into a session file that has its header and no rows. `asked`: by task.
/// Throws RecordError and InputError.
ForeignCounts write_foreign_rows(const std::filesystem::path& session_file, const Sitting& sitting,
                                 const ForeignPlan& plan, const ForeignGaze& gaze,
                                 const std::vector<AskedAnswer>& asked, const std::string& source_text);

} // namespace overt
