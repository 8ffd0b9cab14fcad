/// The messages of `overt run` in the operator's terminal.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "app/cli/progress_bar.h"
#include "app/session/session_commands.h"
#include "experiment/record/write/session_store.h"
#include "experiment/session/session.h"
#include "render/stimulus/stimulus_library.h"
#include "render/window/screen_check.h"

namespace overt {

/// Which session begins, and on which display.
void say_before(const Protocol& protocol, const Schedule& schedule, const GlDescription& graphics,
                const RunOptions& options);

/// How the frames that are shown were made. Where a person would be shown previews, that is said as a risk.
void say_frames(const StimulusLibrary& library, bool to_people);

/// What may change the signal on its way to the screen, to standard error.
void say_risks(const std::vector<ScreenFinding>& findings);

/// Prints where the session stands after each trial.
class TrialProgress {
  public:
    /// `has_tracker`: drifts are checked. The protocol must outlive this.
    /// Of the trials in the order of `schedule`, which must outlive this as well.
    /// `is_timing_unproven`: missed refreshes are counted by times that nothing proves.
    TrialProgress(const Protocol& protocol, const Schedule& schedule, bool has_tracker,
                  bool is_timing_unproven);
    /// `done`: trials that were completed and count.
    void operator()(const Trial& trial, const TrialOutcome& outcome, int done);
    /// The session's phase now, with its trial or -1; the question of that trial is said with it.
    void enter(SessionPhase phase, int trial);
    void finish() { bar_.finish(); }

  private:
    const Protocol* protocol_;
    const Schedule* schedule_;
    int total_;
    bool has_tracker_, is_timing_unproven_;
    ProgressBar bar_;
};

/// How it ended and where it lies, also into the file of --print-session-to. `timing`:
/// RecordedDisplay::timing, without whose proof no number of missed refreshes is said. Throws RecordError if
/// that cannot be written.
void say_after(const RunOptions& options, const SessionResult& result, const LostRows& lost,
               const Schedule& schedule, const std::filesystem::path& folder, std::string_view timing);

} // namespace overt
