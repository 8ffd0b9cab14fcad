#include "app/session/session_commands.h"

#include "app/cli/command_options.h"
#include "experiment/ports/tracker_kinds.h"

namespace overt {

namespace {

const std::map<std::string, MapTime> map_times{
    {"auto", MapTime::automatic}, {"live", MapTime::live}, {"prepared", MapTime::prepared}};

const std::map<std::string, ResumePolicy> resume_policies{{"redo", ResumePolicy::redo},
                                                          {"skip", ResumePolicy::skip},
                                                          {"restart-block", ResumePolicy::restart_block}};

const std::map<std::string, AskAt> places_to_ask{
    {"window", AskAt::window}, {"terminal", AskAt::terminal}, {"nobody", AskAt::nobody}};

void add_run(CLI::App& app, ChosenCommand& chosen) {
    const auto given = std::make_shared<RunOptions>();
    RunOptions& options = *given;
    CLI::App& command = add_command(app, "run", "Runs a session",
                                    "overt run protocols/overt_2019.toml --observer 07\n"
                                    "  overt run protocols/overt_2019.toml --observer 07 --resume\n"
                                    "  overt run protocols/overt_2019.toml --observer 07 --simulate-observer "
                                    "1 --virtual-time --context osmesa");
    command.add_option("PROTOCOL", options.protocol, "Protocol file (TOML)")->required();
    command
        .add_option("--observer", options.observer,
                    "Who sits there: letters and digits; the digits at the end are the observer's number")
        ->required()
        ->type_name("ID");
    command
        .add_option("--session", options.session_number,
                    "Number of this sitting (default: the next free one)")
        ->type_name("N")
        ->check(above_zero());
    command
        .add_option_function<std::string>(
            "--resume",
            [&options](const std::string& policy) { options.resume = resume_policies.at(policy); },
            "Go on with this observer's interrupted session (with --session that one, else the last): its "
            "interrupted trial is done again (redo, the default), skipped (skip), or its block begins again "
            "(restart-block)")
        ->expected(0, 1)
        ->default_str("redo")
        ->check(CLI::IsMember({"redo", "skip", "restart-block"}))
        ->type_name("POLICY");
    command
        .add_option("--seed", options.seed,
                    "Seed of the order and of all that is simulated (default: the protocol's, or a new one)")
        ->type_name("N")
        ->check(seed_number());
    command
        .add_option("--simulate-observer", options.simulate_observer,
                    "Let a simulated observer look and answer")
        ->type_name("SEED");
    command
        .add_option("--observer-field", options.observer_fields,
                    "Fills in a field of the observer's form, as age=31; once for each field. A simulated "
                    "observer fills in the rest from its seed")
        ->type_name("ID=VALUE")
        ->allow_extra_args(false);
    command
        .add_option_function<std::string>(
            "--ask-at", [&options](const std::string& place) { options.ask_at = places_to_ask.at(place); },
            "Where the rest of the form is filled in: window (the terminal if there is none), terminal, or "
            "nobody, which refuses a session that lacks a required field")
        ->check(CLI::IsMember({"window", "terminal", "nobody"}))
        ->type_name("WHERE");
    command
        .add_option(
            "--simulate-operator", options.operator_keys,
            "A key that an operator presses in a simulated observer's session, as "
            "\"stimulus@3+0.5=skip,2\": the phase, the trial, seconds after the phase began, the key, and "
            "the answer to the question that follows; once for each key")
        ->type_name("KEY")
        ->allow_extra_args(false);
    command
        .add_option("--tracker", options.tracker,
                    "Kind of eye tracker, instead of the protocol's [tracker] kind")
        ->check(CLI::IsMember(
            std::vector<std::string>(names_of<TrackerKind>.begin(), names_of<TrackerKind>.end())))
        ->type_name("KIND");
    command
        .add_option("--tracker-address", options.tracker_address,
                    "Where it is, instead of [tracker] address; of \"replay\", the recording")
        ->type_name("TEXT");
    command.add_flag("--virtual-time", options.virtual_time,
                     "Run as fast as the machine can, on a clock of its own");
    command.add_flag(
        "!--no-pictures", options.draws_stimuli,
        "Neither read nor draw the stimuli, in a session without a screen: the record is the same, "
        "and says so");
    command.add_flag("--windowed", options.windowed, "A window instead of the whole screen");
    command
        .add_option(
            "--monitor", options.monitor,
            "The screen to take: its number as `overt doctor` lists them, or the name of its output or "
            "of its EDID (default: [display] monitor, or the only one with the protocol's resolution "
            "and rate)")
        ->type_name("WHICH");
    command.add_option("--sessions", options.sessions, "Folder for sessions")
        ->type_name("DIR")
        ->capture_default_str();
    command.add_option("--trials", options.trials, "Only the first N trials, for a rehearsal")
        ->type_name("N")
        ->check(above_zero());
    command
        .add_option("--print-session-to", options.print_session_to,
                    "Write the session's path to this file, for scripts")
        ->type_name("FILE");
    command
        .add_option_function<std::string>(
            "--maps", [&options](const std::string& time) { options.maps = map_times.at(time); },
            "Draw the hidden maps live while their frames are shown, or prepared before (auto: live on a "
            "graphics processor)")
        ->check(CLI::IsMember({"auto", "live", "prepared"}))
        ->type_name("WHEN");
    command.add_flag("--verify-output", options.verify_output,
                     "Decode every page before the first trial, compare it with its prediction, and "
                     "record the result with the hash of what is sent");
    command
        .add_option(
            "--faults", options.faults,
            "Rehearse with a display and a simulated eye tracker that do wrong what this file (TOML) says: "
            "late "
            "pictures, skipped refreshes, jitter of time stamps; silence, gaps, a tracker that is unplugged")
        ->type_name("FILE");
    command
        .add_option_function<std::string>(
            "--operator-socket",
            [&options](const std::string& path) {
                options.operator_socket =
                    path == "session" ? std::filesystem::path() : std::filesystem::path(path);
            },
            "Let `overt watch` connect to the session, by a socket for this user alone: in the session's "
            "folder (session, the default), or this file")
        ->expected(0, 1)
        ->default_str("session")
        ->type_name("FILE");
    command.add_flag("--realtime", options.realtime,
                     "Ask for real-time priority and locked memory; goes on if they are refused");
    command.add_option("--pin", options.processor, "Run the session's thread on this processor only")
        ->type_name("CPU")
        ->check(not_negative());
    command
        .add_option("--refresh-check", options.refresh_check_s,
                    "How long the refresh of a real screen is measured before the session; less for a "
                    "rehearsal, 0 not at all")
        ->type_name("SECONDS")
        ->check(CLI::Range(0.0, 600.0))
        ->capture_default_str();
    add_quality_option(command, options.quality,
                       "What the stimuli have at least, instead of what the protocol asks for",
                       {"live", "preview", "draft", "standard", "reference"});
    add_context_option(command, options.context);
    run_when_chosen(command, chosen, [given] { return run_session(*given); });
}

} // namespace

void add_session_commands(CLI::App& app, ChosenCommand& chosen) { add_run(app, chosen); }

} // namespace overt
