#include "app/check/check_commands.h"

#include "app/cli/command_options.h"

namespace overt {

namespace {

void add_check(CLI::App& app, ChosenCommand& chosen) {
    const auto given = std::make_shared<CheckOptions>();
    CheckOptions& options = *given;
    CLI::App& command = add_command(app, "check", "Everything that can be known before an observer sits down",
                                    "overt check protocols/overt_2019.toml --observer 07");
    command.add_option("PROTOCOL", options.protocol, "Protocol file (TOML)")->required();
    CLI::Option* const one =
        command.add_option("--observer", options.observer, "Show this observer's order of trials")
            ->type_name("ID");
    command.add_flag("--all-observers", options.all_observers, "Show the order of each planned observer")
        ->excludes(one);
    command
        .add_option("--answer-time", options.answer_time_s,
                    "Seconds an answer is taken to last, for the session's length")
        ->type_name("S")
        ->capture_default_str()
        ->check(seconds_up_to_an_hour());
    command
        .add_option("--seed", options.seed,
                    "Show the orders that this seed gives, as the record of a session has it")
        ->type_name("SEED")
        ->check(seed_number());
    command.add_flag("--frames", options.frames,
                     "Read every frame, and say how much of its light the display cannot show");
    command
        .add_option("--screens", options.screens,
                    "Write a picture of each screen that a session shows between stimuli into this folder")
        ->type_name("DIR");
    command.add_flag("--json", options.json, "Print JSON");
    run_when_chosen(command, chosen, [given] { return run_check(*given); });
}

void add_new(CLI::App& app, ChosenCommand& chosen) {
    const auto given = std::make_shared<NewOptions>();
    NewOptions& options = *given;
    CLI::App& command = add_command(app, "new", "Writes a protocol to begin with, every key explained",
                                    "overt new my_experiment.toml --short");
    command.add_option("PROTOCOL", options.protocol, "File to write (TOML)")->required();
    command.add_flag("--short", options.is_short, "Only the lines that matter, without the other keys");
    run_when_chosen(command, chosen, [given] { return run_new(*given); });
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
