#include "app/session/session_messages.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/counted.h"
#include "experiment/base/error.h"
#include "experiment/base/whole_file.h"
#include "experiment/protocol/all_stimuli.h"
#include "experiment/record/read/session_faults.h"
#include "experiment/session/missed_in_words.h"

namespace overt {

void say_before(const Protocol& protocol, const Schedule& schedule, const GlDescription& graphics,
                const RunOptions& options) {
    fmt::print("{}: observer {} (number {}), {}, seed {}\n",
               protocol.title.empty() ? protocol.name : protocol.title, schedule.observer.label,
               schedule.observer.number, counted(schedule.trials.size(), "trial"), schedule.seed);
    fmt::print("display: {} ({}), {}\n", name_of(graphics.kind), graphics.renderer,
               options.virtual_time ? "in virtual time" : "in real time");
    const std::string_view tracker = name_of(protocol.tracker.kind);
    if (tracker != "simulated")
        fmt::print("tracker: {}\n", tracker);
    else if (!options.simulate_observer)
        fmt::print("tracker: simulated; the gaze in this session is made by the program, not measured\n");
    for (const FurtherTrackerSettings& further : protocol.further_trackers)
        fmt::print("further tracker {}: {}\n", further.id, name_of(further.kind));
}

void say_frames(const StimulusLibrary& library, bool to_people) {
    const std::vector<Stimulus> rendered = library.cache().rendered_stimuli();
    if (rendered.empty())
        return;
    fmt::print("frames: {}\n", library.source_of(rendered.front()));
    if (to_people && library.quality_of_frames(rendered.front()).level == BakeQuality::preview)
        fmt::print(stderr, "risk: frames: previews have half the resolution and few light paths: they are "
                           "for trial runs, not for observers whose data count\n");
}

void say_risks(const std::vector<ScreenFinding>& findings) {
    for (const ScreenFinding& finding : findings)
        if (finding.weight == ScreenFinding::Weight::risk)
            fmt::print(stderr, "risk: {}: {}\n", finding.what, finding.finding);
}

namespace {

/// What the operator should know of an attempt before the next.
std::vector<std::string> remarks_on(const TrialOutcome& outcome, double drift_limit_deg,
                                    double gaze_lost_limit, bool has_tracker, bool is_timing_unproven) {
    using enum TrialOutcome::Afterwards;
    std::vector<std::string> remarks;
    if (outcome.missed_refreshes > 0)
        remarks.push_back(missed_in_words(outcome.missed_refreshes, !is_timing_unproven));
    if (outcome.drift && outcome.drift->value > drift_limit_deg)
        remarks.push_back(fmt::format("the drift check found {:.2f} deg, more than {}", outcome.drift->value,
                                      drift_limit_deg));
    const bool has_checked =
        std::ranges::find(outcome.steps, "drift_check", &AttemptStep::kind) != outcome.steps.end();
    if (has_tracker && has_checked && outcome.shown_refreshes > 0 && !outcome.drift)
        remarks.emplace_back("the drift check found no eye");
    if (outcome.gaze && 1.0 - outcome.gaze->share() > gaze_lost_limit)
        remarks.push_back(fmt::format("only {:.1f} % of its gaze came", 100.0 * outcome.gaze->share()));
    if (outcome.failure.empty())
        return remarks;
    const bool counts = outcome.status == TrialOutcome::Status::completed;
    remarks.push_back(fmt::format("{}: {}", outcome.failure,
                                  counts                               ? "counts as it is"
                                  : outcome.afterwards == now          ? "comes again now"
                                  : outcome.afterwards == end_of_block ? "comes again at the end of the block"
                                                                       : "does not come again"));
    return remarks;
}

} // namespace

TrialProgress::TrialProgress(const Protocol& protocol, const Schedule& schedule, bool has_tracker,
                             bool is_timing_unproven)
    : protocol_(&protocol), schedule_(&schedule), total_(static_cast<int>(schedule.trials.size())),
      has_tracker_(has_tracker), is_timing_unproven_(is_timing_unproven) {
    bar_.update("trials", 0, total_);
}

void TrialProgress::enter(SessionPhase phase, int trial) {
    const auto& trials = schedule_->trials;
    const auto found = std::ranges::find(trials, trial, &Trial::index);
    std::string text(name_of(phase));
    if (found != trials.end())
        text = fmt::format("trial {}, {}: {}", trial + 1, text,
                           protocol_->tasks[static_cast<std::size_t>(found->task)].question);
    bar_.remark(std::move(text));
}

void TrialProgress::operator()(const Trial& trial, const TrialOutcome& outcome, int done) {
    bar_.update("trials", done, total_);
    const std::vector<std::string> remarks =
        remarks_on(outcome, protocol_->tracker.drift_limit_deg, protocol_->repeat.gaze_lost_limit,
                   has_tracker_, is_timing_unproven_);
    if (remarks.empty())
        return;
    bar_.make_room();
    fmt::print(stderr, "trial {} ({}, {}): {}\n", trial.index + 1,
               protocol_->tasks[static_cast<std::size_t>(trial.task)].id,
               stimulus_in_words(*protocol_, trial.stimulus), fmt::join(remarks, ", "));
}

namespace {

/// Each device's in a line. What cannot be read is said by whoever reads it next: the session is over.
void say_faults(const std::filesystem::path& folder) {
    try {
        for (const std::string& line : summary_of(faults_of(SessionRecord(folder))))
            fmt::print(stderr, "{}\n", line);
    } catch (const Error& error) {
        fmt::print(stderr, "{}\n", error.what());
    }
}

/// A number where real vertical blanks tell it, or where time itself is made up.
std::string said_of_missed(int missed, std::string_view timing, bool virtual_time) {
    if (timing == "none")
        return virtual_time ? missed_in_words(missed, true) + ", as simulated"
                            : std::string("missed refreshes: there was no screen");
    return timing == "unproven" ? std::string("missed refreshes: unproven") : missed_in_words(missed, true);
}

} // namespace

void say_after(const RunOptions& options, const SessionResult& result, const LostRows& lost,
               const Schedule& schedule, const std::filesystem::path& folder, std::string_view timing) {
    if (lost.flips + lost.samples > 0)
        fmt::print(stderr, "the disk was too slow: {} and {} were not recorded\n",
                   counted(lost.flips, "flip"), counted(lost.samples, "sample"));
    const int planned = static_cast<int>(schedule.trials.size());
    const bool is_short = !result.aborted && result.completed_trials < planned;
    fmt::print("{} of {} completed{}, {}\nsession: {}\n", result.completed_trials, counted(planned, "trial"),
               is_short ? fmt::format(", {} skipped", planned - result.completed_trials) : "",
               said_of_missed(result.missed_refreshes, timing, options.virtual_time), folder.string());
    say_faults(folder);
    if (!options.print_session_to.empty())
        write_to(options.print_session_to, folder.string() + "\n");
    if (result.aborted)
        fmt::print(stderr, "the session ended early: {}{}\n", result.reason,
                   result.is_opened || result.completed_trials > 0
                       ? "; overt run with --resume goes on with it"
                       : "");
}

} // namespace overt
