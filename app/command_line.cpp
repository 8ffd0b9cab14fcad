#include "app/command_line.h"

#include <algorithm>
#include <cstdio>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "app/analyze/analyze_commands.h"
#include "app/bench/bench_commands.h"
#include "app/check/check_commands.h"
#include "app/cli/command_options.h"
#include "app/cli/line_faults.h"
#include "app/cli/old_spellings.h"
#include "app/cli/this_program.h"
#include "app/display/display_commands.h"
#include "app/doctor/doctor_commands.h"
#include "app/import/import_commands.h"
#include "app/manual/known_words.h"
#include "app/manual/manual_commands.h"
#include "app/power/power_command.h"
#include "app/record/record_commands.h"
#include "app/replay/replay_commands.h"
#include "app/session/crash_guard.h"
#include "app/session/session_commands.h"
#include "app/stimuli/stimulus_commands.h"
#include "app/tracker/tracker_commands.h"
#include "app/watch/watch_commands.h"
#include "experiment/base/diagnostics.h"

namespace overt {

namespace {

const char* const synopsis =
    "Eye-tracking experiments on animated 3D objects, from a protocol file to statistics on the surface.";

const char* const exit_codes = "Exit codes: 0 done, 1 failed, 2 bad input.\n"
                               "Frames, maps and objects are kept in $OVERT_CACHE (default: ~/.cache/overt).";

/// What is called as a command and is none: help, or a word that was mistyped. The exit code, or nothing
/// where it is a command.
std::optional<int> answer_to_no_command(const CLI::App& app, int argc, char** argv) {
    const std::vector<const CLI::App*> commands = app.get_subcommands({});
    const auto called = [&](std::string_view word) {
        const auto found = std::ranges::find(commands, word, &CLI::App::get_name);
        return found == commands.end() ? nullptr : *found;
    };
    if (argc < 2 || argv[1][0] == '-' || called(argv[1]))
        return std::nullopt;
    const bool is_help = argv[1] == std::string_view("help");
    const char* const word = is_help && argc > 2 ? argv[2] : argv[1];
    if (const CLI::App* command = is_help && argc == 2 ? &app : called(word)) {
        fmt::print("{}", command == &app ? app.help() : command->help(app.get_name()));
        return 0;
    }
    std::vector<std::string> names;
    for (const CLI::App* command : commands)
        names.push_back(command->get_name());
    const std::vector<std::string_view> known(names.begin(), names.end());
    fmt::print(stderr, "overt: there is no command \"{}\"; {}\n", word, suggest_name(word, known));
    return 2;
}

/// A flag that is given a value ("--tfce=3") is refused, and not read as something else.
void let_flags_have_no_values(CLI::App& app) {
    for (CLI::Option* option : app.get_options())
        if (option->get_items_expected_max() == 0)
            option->disable_flag_override();
    for (CLI::App* below : app.get_subcommands({}))
        let_flags_have_no_values(*below);
}

} // namespace

int run_command_line(int argc, char** argv) {
    const std::vector<std::string> given(argv + std::min(argc, 1), argv + argc);
    if (answer_shell(given))
        return 0;
    if (!given.empty() && given.front() == close_crashed_word)
        return close_crashed_session(given);
    CLI::App app(synopsis, "overt");
    app.set_version_flag("-V,--version", version_text(), "Print the version of the program and end");
    app.require_subcommand(1);
    app.footer(exit_codes);
    app.get_formatter()->column_width(34);
    ChosenCommand chosen;
    for (const auto add_commands :
         {add_check_commands, add_session_commands, add_watch_commands, add_record_commands,
          add_import_commands, add_replay_commands, add_analyze_command, add_replicate_command,
          add_power_command, add_stimulus_commands, add_tracker_commands, add_display_commands,
          add_doctor_command, add_bench_commands, add_manual_commands})
        add_commands(app, chosen);
    let_flags_have_no_values(app);

    if (const std::optional<int> answer = answer_to_no_command(app, argc, argv))
        return *answer;
    std::vector<std::string> words = with_new_spellings(given);
    std::ranges::reverse(words); // as CLI11 takes them
    try {
        app.parse(std::move(words));
    } catch (const CLI::ParseError& error) {
        // Help and version arrive here too; all else is bad input.
        if (error.get_exit_code() == 0)
            return app.exit(error);
        for (const std::string& fault : line_faults(app, error))
            fmt::print(stderr, "{}\n", fault);
        return 2;
    }
    return chosen();
}

} // namespace overt
