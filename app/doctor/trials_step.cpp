/// The last step of the first day: the protocol's first trials as a session.
#include <algorithm>

#include <fmt/format.h>

#include "app/doctor/first_day_steps.h"
#include "app/session/session_commands.h"
#include "experiment/base/error.h"
#include "experiment/base/scratch_folder.h"
#include "experiment/base/whole_file.h"
#include "experiment/ports/tracker_kinds.h"
#include "experiment/record/read/session_record.h"
#include "experiment/record/verify/verification.h"

namespace overt {
namespace {

/// Whose sessions they are: a label that no study gives.
constexpr const char* rig_observer = "rig1";

/// Missed refreshes of one in a hundred are said as a risk before a session, too.
constexpr double most_missed_percent = 1.0;

RunOptions session_of(const FirstDay& day, const std::filesystem::path& place) {
    RunOptions run;
    run.protocol = day.options.protocol;
    run.observer = rig_observer;
    run.sessions = day.folder / "sessions";
    run.trials = day.options.trials;
    run.context = day.doctor_options().context;
    run.monitor = day.options.monitor;
    run.windowed = day.options.windowed;
    run.tracker = day.options.tracker;
    run.tracker_address = day.options.tracker_address;
    run.simulate_observer = day.options.simulate_observer;
    run.print_session_to = place;
    run.ask_at = AskAt::nobody;
    // Nobody sees pictures of a display that only keeps time.
    run.virtual_time = day.is_headless() && !row_of(day.protocol.tracker.kind).is_hardware();
    run.draws_stimuli = !day.is_headless();
    if (!day.is_headless() && !day.options.simulate_observer)
        run.ask_at = AskAt::window;
    return run;
}

} // namespace

RigStep measure_trials(const FirstDay& day) {
    if (day.is_headless() && !day.options.simulate_observer)
        return not_proved("There is no screen here at which an observer could answer.",
                          "repeat this step where a monitor is connected");
    const ScratchFolder scratch("overt-first-day");
    const std::filesystem::path place = scratch.path() / "session";
    const int code = run_session(session_of(day, place));
    if (!std::filesystem::exists(place))
        return not_proved("The session left no record.", "see what was said on the terminal");
    std::string folder = read_whole_file(place);
    while (!folder.empty() && folder.back() == '\n')
        folder.pop_back();
    const SessionRecord record(folder);
    const Verification verified = verify_session(folder);
    // A protocol may have fewer.
    const int wished = std::min(day.options.trials, static_cast<int>(record.header().schedule.trials.size()));
    int completed = 0;
    std::int64_t shown = 0, missed = 0;
    double gaze = 0.0;
    int with_gaze = 0;
    for (const TrialRecord& trial : record.trials()) {
        if (!trial.counts)
            continue;
        ++completed;
        shown += trial.outcome.shown_refreshes;
        missed += trial.outcome.missed_refreshes;
        if (trial.outcome.gaze) {
            gaze += trial.outcome.gaze->share();
            ++with_gaze;
        }
    }
    BenchFigures figures{
        at_least("trials that were completed", completed, "", wished),
        at_most("damaged places in the record", static_cast<double>(verified.damages.size()), "", 0.0),
        {"refreshes shown", static_cast<double>(shown), ""}};
    const bool is_unproven = record.header().is_timing_unproven();
    if (!is_unproven)
        figures.push_back(
            at_most("missed refreshes",
                    shown > 0 ? 100.0 * static_cast<double>(missed) / static_cast<double>(shown) : 100.0, "%",
                    most_missed_percent));
    if (with_gaze > 0)
        figures.push_back({"samples with gaze, mean of trials", 100.0 * gaze / with_gaze, "%"});
    RigStep step =
        judged(std::move(figures),
               fmt::format("{} trials of {} were completed{}.", completed, wished,
                           code == 0 ? "" : "; the session was broken off"),
               "see overt show of the session in the folder sessions beside this page, mend what it "
               "says, and repeat this step");
    if (is_unproven && step.verdict == StepVerdict::proved) {
        step.verdict = StepVerdict::not_proved;
        step.finding += " The protocol claims no proof of times ([display] timing = \"unproven\"), so that "
                        "how many refreshes were missed is not known.";
        step.remedy = "write timing = \"proven\" once the step screen is proved";
    }
    if (day.is_headless())
        return as_simulated(std::move(step), "the display, the observer and what has to do with them");
    if (day.options.simulate_observer)
        return as_simulated(std::move(step), "the observer");
    return row_of(day.protocol.tracker.kind).is_made_up ? as_simulated(std::move(step), "the eye tracker")
                                                        : step;
}

} // namespace overt
