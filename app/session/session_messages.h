/// The messages of `overt run` in the operator's terminal.
#pragma once

#include <filesystem>
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

/// How the frames that are shown were made.
void say_frames(const StimulusLibrary& library);

/// What may change the signal on its way to the screen, to standard error.
void say_risks(const std::vector<ScreenFinding>& findings);

/// Prints where the session stands after each trial.
class TrialProgress {
  public:
    /// `has_tracker`: drifts are checked. The protocol must outlive this.
    TrialProgress(const Protocol& protocol, int total, bool has_tracker);
    /// `done`: trials that were completed and count.
    void operator()(const Trial& trial, const TrialOutcome& outcome, int done);
    void finish() { bar_.finish(); }

  private:
    const Protocol* protocol_;
    int total_;
    bool has_tracker_;
    ProgressBar bar_;
};

/// How it ended and where it lies, also into the file of --print-session-to. Throws RecordError if that
/// cannot be written.
void say_after(const RunOptions& options, const SessionResult& result, const LostRows& lost,
               const Schedule& schedule, const std::filesystem::path& folder);

} // namespace overt
