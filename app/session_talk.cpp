#include "app/session_talk.h"

#include <fstream>

#include <fmt/format.h>

#include "experiment/error.h"

namespace overt {

void say_before(const Protocol& protocol, const Schedule& schedule, const GlDescription& graphics,
                const RunOptions& options) {
    fmt::print("{}: observer {} (number {}), {} trials, seed {}\n",
               protocol.title.empty() ? protocol.name : protocol.title, schedule.observer.label,
               schedule.observer.number, schedule.trials.size(), schedule.seed);
    fmt::print("display: {} ({}), {}\n", name_of(graphics.kind), graphics.renderer,
               options.virtual_time ? "in virtual time" : "in real time");
    if (!options.simulate_observer)
        fmt::print("tracker: simulated; the gaze in this session is nobody's\n");
}

void say_frames(const StimulusLibrary& library) {
    const std::vector<Condition> rendered = library.rendered_stimuli();
    if (!rendered.empty())
        fmt::print("frames: {}\n", library.source_of(rendered.front()));
}

void say_risks(const std::vector<ScreenFinding>& findings) {
    for (const ScreenFinding& finding : findings)
        if (finding.weight == ScreenFinding::Weight::risk)
            fmt::print(stderr, "risk: {}: {}\n", finding.what, finding.finding);
}

TrialProgress::TrialProgress(const Protocol& protocol, int total) : protocol_(&protocol), total_(total) {
    bar_.update("trials", 0, total_);
}

void TrialProgress::operator()(const Trial& trial, const TrialOutcome& outcome, int done) {
    const auto name = [](const auto& list, int index) { return list[static_cast<std::size_t>(index)].id; };
    bar_.update("trials", done, total_);
    if (outcome.missed_refreshes > 0) {
        bar_.finish();
        fmt::print(stderr, "trial {} ({}, {}, {}): {} refreshes missed\n", trial.index + 1,
                   name(protocol_->tasks, trial.task), name(protocol_->sculptures, trial.condition.sculpture),
                   name(protocol_->materials, trial.condition.material), outcome.missed_refreshes);
    }
}

void say_after(const RunOptions& options, const SessionResult& result, const LostRows& lost,
               const Schedule& schedule, const std::filesystem::path& folder) {
    if (lost.flips + lost.samples > 0)
        fmt::print(stderr, "the disk was too slow: {} flips and {} samples were not recorded\n", lost.flips,
                   lost.samples);
    fmt::print("{} of {} trials completed, {} refreshes missed\nsession: {}\n", result.completed_trials,
               schedule.trials.size(), result.missed_refreshes, folder.string());
    if (!options.print_session_to.empty()) {
        std::ofstream file(options.print_session_to);
        file << folder.string() << "\n";
        if (!file.flush())
            throw RecordError(fmt::format("{}: cannot be written", options.print_session_to.string()));
    }
    if (result.aborted)
        fmt::print(stderr, "the session ended early: {}{}\n", result.reason,
                   result.completed_trials > 0 ? "; overt run with --resume goes on with it" : "");
}

} // namespace overt
