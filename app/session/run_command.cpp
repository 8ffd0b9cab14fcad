#include <fmt/format.h>

#include "app/cli/own_folders.h"
#include "app/cli/terminal_output.h"
#include "app/inputs/protocol_file.h"
#include "app/inputs/protocol_inputs.h"
#include "app/rig/operator_equipment.h"
#include "app/session/crash_guard.h"
#include "app/session/session_commands.h"
#include "app/session/session_messages.h"
#include "app/session/sitting_run.h"
#include "experiment/base/error.h"

namespace overt {

namespace {

/// What the command line says of the eye tracker replaces what the protocol says.
void take_tracker_of(const RunOptions& options, Protocol& protocol) {
    if (!options.tracker.empty())
        protocol.tracker.kind = tracker_kind_called(options.tracker);
    if (!options.tracker_address.empty())
        protocol.tracker.address = options.tracker_address;
    if (!options.tracker.empty() && !protocol.further_trackers.empty()) {
        fmt::print("further eye trackers are left out, for --tracker says which one there is\n");
        protocol.further_trackers.clear();
    }
}

void say_unfinished_manifest() {
    fmt::print(stderr,
               "the session is recorded, but its manifest is not finished, for another program has "
               "session.sqlite open, or the disk is full: afterwards overt run … --resume finishes it\n");
}

/// `again`: null for a session that is recorded for the first time.
int run_session_of(Experiment experiment, const RunOptions& options, const PresentingAgain* again) {
    take_tracker_of(options, experiment.protocol);
    const Protocol& protocol = experiment.protocol;
    const Observer observer = observer_labelled(options.observer);
    // What would refuse the session at its end is said before anything is drawn.
    const SessionPlace place{options.sessions, protocol.name, observer.label, options.is_another_person};
    if (options.resume && finish_manifest(options, place))
        return 0;
    const SessionPlan plan = plan_session(options, place, protocol, observer);
    std::optional<CrashGuard> guard; // until the devices are closed
    SessionEquipment equipment(experiment, options, plan, again ? again->cache : cache_folder());
    SittingRecord record(experiment, options, place, plan, equipment, again);
    guard.emplace(record.folder());
    const SessionResult result = run_sitting(protocol, options, plan, equipment, record, again);
    if (!record.close())
        say_unfinished_manifest();
    for (const std::string& warning : result.marker_warnings)
        fmt::print(stderr, "{}\n", warning);
    for (const std::string& warning : equipment.closing_warnings())
        fmt::print(stderr, "{}\n", warning);
    say_after(options, result, record.lost(), plan.schedule, record.folder(), record.header().display.timing);
    return result.aborted ? 1 : 0;
}

} // namespace

int run_session(const RunOptions& options) {
    output_is_only_told();
    observer_labelled(options.observer); // before anything is read
    if (options.verify_output && !options.draws_stimuli)
        throw InputError(
            "--verify-output decodes the pictures that --no-pictures leaves out: give one of them");
    if (options.operator_socket && !options.operator_socket->empty())
        check_socket_place(*options.operator_socket);
    return run_session_of(read_experiment_or_report(options.protocol, cache_folder(), InputDepth::everything),
                          options, nullptr);
}

int run_session_again(const Experiment& experiment, const RunOptions& options, const PresentingAgain& again) {
    return run_session_of(experiment, options, &again);
}

} // namespace overt
