#include "app/check/check_commands.h"

#include <fmt/ranges.h>

#include "app/check/shipped_protocols.h"
#include "app/cli/command_options.h"

namespace overt {

namespace {

void add_check(CLI::App& app, ChosenCommand& chosen) {
    const auto [command, options] = add_command(app, chosen, run_check, "check",
                                                "Everything that can be known before an observer sits down",
                                                "overt check protocols/overt_2019.toml --observer 07");
    command.add_option("PROTOCOL", options.protocol, "Protocol file (TOML)")->required();
    CLI::Option* const one =
        option(command, "--observer", options.observer, "ID", "Show this observer's order of trials");
    command.add_flag("--all-observers", options.all_observers, "Show the order of each planned observer")
        ->excludes(one);
    option(command, "--answer-time", options.answer_time_s, "S",
           "Seconds an answer is taken to last, for the session's length", shown_default,
           seconds_up_to_an_hour());
    option(command, "--seed", options.seed, "SEED",
           "Show the orders that this seed gives, as the record of a session has it", seed_number());
    command.add_flag("--frames", options.frames,
                     "Read every frame, and say how much of its light the display cannot show");
    option(command, "--screens", options.screens, "DIR",
           "Write a picture of each screen that a session shows between stimuli into this folder");
    add_json_flag(command, options.json);
}

void add_new(CLI::App& app, ChosenCommand& chosen) {
    const auto [command, options] =
        add_command(app, chosen, run_new, "new", "Writes a protocol to begin with, every key explained",
                    "overt new my_experiment.toml --short\n  overt new my_study.toml --from gloss_scaling");
    command.add_option("PROTOCOL", options.protocol, "File to write (TOML)")->required();
    CLI::Option* const is_short =
        command.add_flag("--short", options.is_short, "Only the lines that matter, without the other keys");
    std::vector<std::string> lines;
    for (const ShippedProtocol& one : shipped_protocols())
        lines.push_back(fmt::format("{}: {}", one.name, one.what));
    command
        .add_option("--from", options.from,
                    fmt::format("Begin from one that comes with overt. {}", fmt::join(lines, "; ")))
        ->type_name("NAME")
        ->excludes(is_short);
}

void add_schema(CLI::App& app, ChosenCommand& chosen) {
    CLI::App& command = add_command(app, "schema", "Prints the JSON Schema of protocol files, for editors",
                                    "overt schema > protocol.schema.json");
    run_when_chosen(command, chosen, [] { return run_schema(); });
}

} // namespace

void add_check_commands(CLI::App& app, ChosenCommand& chosen) {
    add_check(app, chosen);
    add_new(app, chosen);
    add_schema(app, chosen);
}

} // namespace overt
