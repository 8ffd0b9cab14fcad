#include "app/cli/line_faults.h"

#include <algorithm>
#include <string_view>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/diagnostics.h"

namespace overt {

namespace {

std::string called(const CLI::App& app) {
    return app.get_parent() ? fmt::format("{} {}", called(*app.get_parent()), app.get_name())
                            : app.get_name();
}

/// The command of the line: the last of those that stand one below the other.
const CLI::App& command_of(const CLI::App& app) {
    for (const CLI::App* below : app.get_subcommands())
        if (!below->get_name().empty())
            return command_of(*below);
    return app;
}

/// Long ones, with their dashes; those of groups, too.
void add_options(const CLI::App& command, std::vector<std::string>& to) {
    for (const CLI::Option* option : command.get_options())
        for (const std::string& name : option->get_lnames())
            to.push_back("--" + name);
    for (const CLI::App* group : command.get_subcommands({}))
        if (group->get_name().empty())
            add_options(*group, to);
}

std::vector<std::string> options_of(const CLI::App& command) {
    std::vector<std::string> names;
    add_options(command, names);
    return names;
}

std::vector<std::string> commands_of(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::App* below : command.get_subcommands({}))
        if (!below->get_name().empty() && !below->get_group().empty())
            names.push_back(below->get_name());
    return names;
}

/// The commands that have an option.
void find_owners(const CLI::App& command, const std::string& option, std::vector<std::string>& owners) {
    if (std::ranges::count(options_of(command), option) > 0)
        owners.push_back(called(command));
    for (const CLI::App* below : command.get_subcommands({}))
        if (!below->get_name().empty() && !below->get_group().empty())
            find_owners(*below, option, owners);
}

std::string_view without_dashes(std::string_view name) {
    return name.substr(std::min(name.find_first_not_of('-'), name.size()));
}

std::string unknown_option(const CLI::App& app, const CLI::App& command, const std::string& option) {
    const std::string said = fmt::format("{}: there is no option {}", called(command), option);
    std::vector<std::string> owners;
    find_owners(app, option, owners);
    if (!owners.empty())
        return fmt::format("{} here; it is one of {}", said, fmt::join(owners, ", "));
    const std::vector<std::string> names = options_of(command);
    std::vector<std::string_view> known;
    for (const std::string& name : names)
        known.push_back(without_dashes(name));
    if (const auto nearest = nearest_name(without_dashes(option), known))
        return fmt::format("{}: did you mean --{}?", said, *nearest);
    return fmt::format("{}: {} --help tells which there are", said, called(command));
}

std::string unknown_word(const CLI::App& command, const std::string& word) {
    const std::vector<std::string> names = commands_of(command);
    if (names.empty())
        return fmt::format("{}: \"{}\" is one word too many: {} --help tells what it takes", called(command),
                           word, called(command));
    const std::vector<std::string_view> known(names.begin(), names.end());
    return fmt::format("{}: there is no command \"{}\"; {}", called(command), word,
                       suggest_name(word, known));
}

/// "--tfce" of "tfce was given a disallowed flag override"; empty if that is no flag of the command.
std::string flag_of(const CLI::App& command, std::string_view text) {
    std::string name = fmt::format("--{}", without_dashes(text.substr(0, text.find(' '))));
    const CLI::Option* option = command.get_option_no_throw(name);
    return option && option->get_items_expected_max() == 0 ? name : std::string();
}

} // namespace

std::vector<std::string> line_faults(const CLI::App& app, const CLI::ParseError& error) {
    const CLI::App& command = command_of(app);
    std::vector<std::string> faults;
    bool has_unknown_option = false;
    for (const CLI::App* of = &command; of; of = of->get_parent()) {
        for (const std::string& word : of->remaining()) {
            const bool is_option = word.size() > 1 && word.front() == '-';
            // What follows an option that is not known may be its value.
            if (is_option)
                faults.push_back(unknown_option(app, *of, word.substr(0, word.find('='))));
            else if (!has_unknown_option)
                faults.push_back(unknown_word(*of, word));
            has_unknown_option |= is_option;
        }
    }
    const auto is = [&](CLI::ExitCodes code) { return error.get_exit_code() == static_cast<int>(code); };
    // Something that has to be there may be what was mistyped.
    const bool is_told = is(CLI::ExitCodes::ExtrasError) || is(CLI::ExitCodes::RequiredError);
    if (!faults.empty() && is_told)
        return faults;
    const std::vector<std::string> commands = commands_of(command);
    if (is(CLI::ExitCodes::RequiredError) && !commands.empty())
        faults.push_back(
            fmt::format("{}: a command has to follow: {}", called(command), fmt::join(commands, ", ")));
    else if (const std::string flag = flag_of(command, error.what());
             is(CLI::ExitCodes::ArgumentMismatch) && !flag.empty())
        faults.push_back(fmt::format("{}: {} takes no value", called(command), flag));
    else
        faults.push_back(fmt::format("{}: {}", called(command), error.what()));
    return faults;
}

} // namespace overt
