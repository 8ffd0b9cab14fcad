#include "app/session/session_commands.h"

#include "app/cli/command_options.h"
#include "app/cli/library_option.h"
#include "experiment/ports/tracker_kinds.h"

namespace overt {

void add_session_commands(CLI::App& app, ChosenCommand& chosen) {
    const auto [command, options] =
        add_command(app, chosen, run_session, "run", "Runs a session",
                    "overt run protocols/overt_2019.toml --observer 07\n"
                    "  overt run protocols/overt_2019.toml --observer 07 --resume\n"
                    "  overt run protocols/overt_2019.toml --observer 07 --simulate-observer "
                    "1 --virtual-time --context osmesa");
    command.add_option("PROTOCOL", options.protocol, "Protocol file (TOML)")->required();
    option(command, "--observer", options.observer, "ID",
           "Who sits there: letters and digits; the digits at the end are the observer's number",
           must_be_given);
    option(command, "--session", options.session_number, "N",
           "Number of the session (default: the next free one)", above_zero());
    command.add_flag("--another-person", options.is_another_person,
                     "This observer is not the one whose label differs in case or leading zeros only");
    choice<ResumePolicy>(command, "--resume", options.resume, "POLICY",
                         "Go on with this observer's interrupted session (with --session that one, else the "
                         "last): its interrupted trial is done again (redo, the default), skipped (skip), or "
                         "its block begins again (restart-block)",
                         {{"redo", ResumePolicy::redo},
                          {"skip", ResumePolicy::skip},
                          {"restart-block", ResumePolicy::restart_block}})
        ->expected(0, 1)
        ->default_str("redo");
    option(command, "--seed", options.seed, "SEED",
           "Seed of the order and of all that is simulated (default: the protocol's, or a new one)",
           seed_number());
    option(command, "--simulate-observer", options.simulate_observer, "SEED",
           "Let a simulated observer look and answer");
    option(command, "--observer-field", options.observer_fields, "ID=VALUE",
           "Fills in a field of the observer's form, as age=31; once for each field. A simulated observer "
           "fills in the rest from its seed",
           one_each_time);
    choice<AskAt>(command, "--ask-at", options.ask_at, "WHERE",
                  "Where the rest of the form is filled in: window (the terminal if there is none), "
                  "terminal, or nobody, which refuses a session that lacks a required field",
                  {{"window", AskAt::window}, {"terminal", AskAt::terminal}, {"nobody", AskAt::nobody}});
    option(command, "--simulate-operator", options.operator_keys, "KEY",
           "A key that an operator presses in a simulated observer's session, as \"stimulus@3+0.5=skip,2\": "
           "the phase, the trial, seconds after the phase began, the key, and the answer to the question "
           "that follows; once for each key. Or what the observer does, as \"response screen@2+0.5=press 7\" "
           "(docs/sitting.md)",
           one_each_time);
    option(command, "--tracker", options.tracker, "KIND",
           "Kind of eye tracker, instead of the protocol's [tracker] kind",
           one_of_names(names_of<TrackerKind>));
    option(command, "--address", options.tracker_address, "TEXT",
           "Where the tracker is, instead of [tracker] address; of \"replay\", the recording");
    add_library_option(command);
    command.add_flag("--virtual-time", options.virtual_time,
                     "Run as fast as the machine can, on a clock of its own");
    command.add_flag(
        "!--no-pictures", options.draws_stimuli,
        "Neither read nor draw the stimuli, in a session without a screen: the record is the same, "
        "and says so");
    add_screen_options(command, options.windowed, options.monitor,
                       "[display] monitor, or the only one with the protocol's resolution and rate");
    add_sessions_option(command, options.sessions);
    option(command, "--trials", options.trials, "N", "Only the first N trials, to try a protocol",
           above_zero());
    option(command, "--print-session-to", options.print_session_to, "FILE",
           "Write the session's path to this file, for scripts");
    choice<MapTime>(command, "--maps", options.maps, "WHEN",
                    "Draw the hidden maps live while their frames are shown, or prepared before (auto: live "
                    "on a graphics processor)",
                    {{"auto", MapTime::automatic}, {"live", MapTime::live}, {"prepared", MapTime::prepared}});
    command.add_flag("--verify-output", options.verify_output,
                     "Decode every page before the first trial, compare it with its prediction, and "
                     "record the result with the hash of what is sent");
    option(command, "--faults", options.faults, "FILE",
           "Try a session with a display and a simulated eye tracker that do wrong what this file (TOML) "
           "says: late "
           "pictures, skipped refreshes, jitter of time stamps; silence, gaps, a tracker that is unplugged");
    command
        .add_option_function<std::string>(
            "--operator-socket",
            [&options = options](const std::string& path) {
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
    option(command, "--pin", options.processor, "CPU", "Run the session's thread on this processor only",
           not_negative());
    option(command, "--refresh-check", options.refresh_check_s, "S",
           "How long the refresh of a real screen is measured before the session; less for a trial run, 0 "
           "not at all",
           CLI::Range(0.0, 600.0), shown_default);
    add_quality_option(command, options.quality,
                       "What the stimuli have at least, instead of what the protocol asks for",
                       BakeQuality::live);
    add_context_option(command, options.context);
}

} // namespace overt
