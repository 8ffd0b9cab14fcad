#include "app/doctor/doctor_commands.h"

#include "app/cli/command_options.h"
#include "app/cli/library_option.h"
#include "app/display/display_commands.h"
#include "app/doctor/first_day.h"
#include "experiment/ports/tracker_kinds.h"

namespace overt {
namespace {

/// Two commands by one name: what there is, and what is proved of it.
struct GivenDoctor {
    DoctorOptions doctor;
    FirstDayOptions first_day;
    bool is_first_day = false, asks_nothing = false;
};

int run_given(const GivenDoctor& given) {
    if (!given.is_first_day)
        return run_doctor(given.doctor);
    FirstDayOptions day = given.first_day;
    day.protocol = given.doctor.protocol;
    day.sensor = given.doctor.sensor;
    day.context = given.doctor.context;
    day.windowed = given.doctor.windowed;
    day.monitor = given.doctor.monitor;
    day.seconds = given.doctor.seconds;
    day.json = given.doctor.json;
    day.asks = !given.asks_nothing;
    return run_first_day(day);
}

void add_first_day(CLI::App& command, GivenDoctor& given) {
    FirstDayOptions& day = given.first_day;
    CLI::Option* const first_day = command.add_flag("--first-day", given.is_first_day,
                                                    "Guide through all measurements of a new rig, and keep a "
                                                    "page of what is proved on it; a day that was "
                                                    "broken off is gone on with");
    for (const char* const other : {"--window", "--photodiode", "--report"})
        first_day->excludes(command.get_option(other));
    const auto of_first_day = [&](CLI::Option* option) { option->needs(first_day); };
    of_first_day(option(command, "--step", day.steps, "STEP", "Measure this step, again if it was done",
                        one_of(names_of_steps()), one_each_time));
    of_first_day(option(command, "--skip", day.skip, "STEP", "Leave this step open", one_of(names_of_steps()),
                        one_each_time));
    of_first_day(command.add_flag("--anew", day.anew, "Begin another first day; the earlier page is kept"));
    of_first_day(command.add_flag("--ask-nothing", given.asks_nothing,
                                  "Begin each step at once instead of waiting for Enter"));
    of_first_day(option(command, "--marker-sensor", day.marker_sensor, "PORT",
                        "Serial port of a sensor at the lines of the marker output, as of --sensor"));
    of_first_day(option(command, "--tracker", day.tracker, "KIND",
                        "Kind of eye tracker, instead of the protocol's [tracker] kind",
                        one_of_names(names_of<TrackerKind>)));
    of_first_day(option(command, "--address", day.tracker_address, "TEXT",
                        "Where the tracker is, instead of [tracker] address"));
    of_first_day(option(command, "--simulate-observer", day.simulate_observer, "SEED",
                        "Let a simulated observer look and answer: a rehearsal, which proves nothing",
                        seed_number()));
    of_first_day(option(command, "--clock-minutes", day.clock_minutes, "MIN",
                        "How long the tracker's clock is watched", CLI::Range(0.02, 60.0), shown_default));
    of_first_day(option(command, "--trials", day.trials, "N", "Trials of the last step", CLI::Range(1, 1000),
                        shown_default));
}

} // namespace

void add_doctor_command(CLI::App& app, ChosenCommand& chosen) {
    const auto [command, given] = add_command(
        app, chosen, run_given, "doctor", "What this machine offers for a session, and what is missing",
        "overt doctor --json\n"
        "  overt doctor protocols/overt_2019.toml --photodiode --sensor simulated "
        "--context osmesa\n"
        "  overt doctor --window --monitor 1 --seconds 30 --report rig.md\n"
        "  overt doctor protocols/overt_2019.toml --first-day --sensor /dev/ttyACM0");
    DoctorOptions& options = given.doctor;
    command.add_option("PROTOCOL", options.protocol,
                       "Protocol file (TOML): show the square of --photodiode as its sessions would, on its "
                       "screen, in its mode, through its display box and in its corner; or the protocol that "
                       "the rig of --first-day is for");
    add_json_flag(command, options.json);
    command.add_flag("--window", options.window,
                     "Show a dark screen, measure its refreshes, and say what may disturb their times");
    command.add_flag("--photodiode", options.photodiode,
                     "Show a square in a corner that changes, and compare what a sensor sees with the times "
                     "of the flips");
    option(command, "--sensor", options.sensor, "PORT",
           "Serial port of a light sensor that sends 1 and 0, or `simulated` (5 ms late, 0.2 ms jitter)");
    option(command, "--report", options.report, "FILE.md",
           "Write all that is found as a page to keep, with what --window and --photodiode measure and "
           "pictures of it");
    add_context_option(command, options.context);
    add_library_option(command);
    add_screen_options(command, options.windowed, options.monitor);
    option(command, "--seconds", options.seconds, "S", "How long to measure", CLI::Range(0.1, 3600.0),
           shown_default);
    add_first_day(command, given);
}

} // namespace overt
