#include "app/session/session_plan.h"

#include <iostream>
#include <random>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include "app/inputs/protocol_file.h"
#include "app/rig/rig.h"
#include "experiment/base/error.h"
#include "experiment/base/folder_lock.h"
#include "experiment/design/schedule.h"
#include "experiment/record/read/session_record.h"

namespace overt {

namespace {

std::uint64_t fresh_seed() {
    std::random_device device;
    return (std::uint64_t{device()} << 32) | device();
}

Schedule new_schedule(const RunOptions& options, const Protocol& protocol, const Observer& observer) {
    const std::uint64_t seed = options.seed             ? *options.seed
                               : protocol.schedule.seed ? *protocol.schedule.seed
                                                        : fresh_seed();
    Schedule schedule = make_schedule(protocol, observer, seed);
    if (options.trials && *options.trials < static_cast<int>(schedule.trials.size()))
        schedule.trials.resize(static_cast<std::size_t>(*options.trials));
    return schedule;
}

/// What became of a session, in words that follow its number.
std::string state_of_session(const std::filesystem::path& folder, bool& was_interrupted) {
    try {
        const SessionRecord record(folder);
        if (record.header().stimuli.empty())
            return "was imported";
        if (record.is_complete())
            return "is complete";
        if (observer_declined(record))
            return "was declined";
        if (FolderLock(folder, FolderLock::Patience::none).is_refused())
            return "is running now";
        was_interrupted = true;
        return "was interrupted";
    } catch (const Error&) {
        return "cannot be read"; // and is nothing to go on with
    }
}

/// A further session may have been meant to go on with the last one, or to be another observer's.
std::string say_earlier_sessions(const SessionPlace& place, std::optional<int> wanted) {
    std::vector<std::string> states;
    std::vector<int> interrupted;
    for (const int number : session_numbers(place)) {
        bool was_interrupted = false;
        states.push_back(fmt::format("session {} {}", number,
                                     state_of_session(session_path(place, number), was_interrupted)));
        if (was_interrupted)
            interrupted.push_back(number);
    }
    if (states.empty())
        return {};
    const int number = wanted.value_or(next_session_number(place));
    const std::string which =
        fmt::format("session {} of observer {}; {}", number, place.observer_label, fmt::join(states, ", "));
    const std::string remedy =
        interrupted.empty()
            ? "--resume would go on with an interrupted one, and there is none"
            : fmt::format("--resume --session {} goes on with that", fmt::join(interrupted, " or "));
    fmt::print(stderr, "this is {}: {}\n", which, remedy);
    return which;
}

/// The faults of --faults, or none. What is wrong with the file is printed, with its places.
SimulatedFaults read_faults_or_report(const std::filesystem::path& file) {
    if (file.empty())
        return {};
    Diagnostics diagnostics;
    const std::optional<SimulatedFaults> faults = read_fault_file(file, diagnostics);
    print_findings(diagnostics);
    if (!faults)
        throw FindingsPrinted(fmt::format("{}: no session was begun", file.string()));
    return *faults;
}

/// The form as far as it is filled in outside of the window. Throws InputError for what is missing where
/// it cannot be asked for.
/// `is_opened`: what is asked at the beginning is in the record already.
FieldValues fill_in_form(const Protocol& protocol, const RunOptions& options, bool is_opened) {
    const std::span<const ObserverFieldSettings> fields = protocol.observer_fields;
    FieldValues values = values_given(fields, options.observer_fields);
    if (options.simulate_observer)
        simulate_values(fields, values, *options.simulate_observer);
    const bool has_window = wants_window(options.context), has_terminal = ::isatty(STDIN_FILENO) == 1;
    const bool asks_in_window = options.ask_at == AskAt::window && has_window && !options.simulate_observer;
    if (!options.simulate_observer && has_terminal &&
        (options.ask_at == AskAt::terminal || (options.ask_at == AskAt::window && !has_window)))
        ask_for_values(is_opened ? std::span<const ObserverFieldSettings>() : fields, values, std::cin,
                       std::cerr);
    if (!asks_in_window)
        require_values(fields, values, is_opened);
    return values;
}

} // namespace

SessionPlan plan_session(const RunOptions& options, const SessionPlace& place, const Protocol& protocol,
                         const Observer& observer) {
    SessionPlan plan;
    if (options.resume)
        plan.resumed = take_up_session(options, place, protocol);
    else {
        check_session_place(place, options.session_number);
        plan.earlier_sessions = say_earlier_sessions(place, options.session_number);
    }
    plan.faults = read_faults_or_report(options.faults);
    plan.fields = fill_in_form(protocol, options, plan.resumed && plan.resumed->history.is_opened);
    if (observer.number > protocol.schedule.observers && !plan.resumed)
        fmt::print(stderr,
                   "observer {} has number {}, and [schedule] plans {}: what goes round over the observers "
                   "begins again with the first\n",
                   observer.label, observer.number, protocol.schedule.observers);
    plan.schedule = plan.resumed ? plan.resumed->header.schedule : new_schedule(options, protocol, observer);
    return plan;
}

std::uint64_t seed_of_simulated(const RunOptions& options, const SessionPlan& plan) {
    return options.simulate_observer.value_or(plan.schedule.seed);
}

} // namespace overt
