/// What the commands of the command line are put together from. Options live as long as the command that
/// reads them.
#pragma once

#include <algorithm>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "app/cli/chosen_command.h"
#include "app/cli/context_choice.h"
#include "experiment/protocol/protocol.h"

namespace overt {

/// A command with its example under its help.
CLI::App& add_command(CLI::App& app, const std::string& name, const std::string& what,
                      const std::string& example);

/// `run` is what `command` does.
void run_when_chosen(CLI::App& command, ChosenCommand& chosen, ChosenCommand run);

template <class Options> struct NewCommand {
    CLI::App& command;
    Options& options; ///< which live as long as it
};

/// A command that does `run` with the options that it was given.
template <class Given>
auto add_command(CLI::App& app, ChosenCommand& chosen, int (*run)(Given), const std::string& name,
                 const std::string& what, const std::string& example) {
    using Options = std::remove_cvref_t<Given>;
    const auto given = std::make_shared<Options>();
    CLI::App& command = add_command(app, name, what, example);
    run_when_chosen(command, chosen, [run, given] { return run(*given); });
    return NewCommand<Options>{command, *given};
}

// What an option may have besides its name, type and text, among them a check of what is given.
inline void must_be_given(CLI::Option& option) { option.required(); }
inline void shown_default(CLI::Option& option) { option.capture_default_str(); }
/// One value each time that it is given, of an option that may be given several times.
inline void one_each_time(CLI::Option& option) { option.allow_extra_args(false); }

inline void give(CLI::Option& option, void (*trait)(CLI::Option&)) { trait(option); }
inline void give(CLI::Option& option, const CLI::Validator& check) { option.check(check); }

/// An option for `value`. `type` is what the help says in place of a value; empty: by the type of `value`.
template <class Value, class... Traits>
CLI::Option* option(CLI::App& command, const std::string& name, Value& value, const std::string& type,
                    const std::string& text, const Traits&... traits) {
    CLI::Option* const added = command.add_option(name, value, text);
    if (!type.empty())
        added->type_name(type);
    (give(*added, traits), ...);
    return added;
}

/// A check for words of which one is to be given; what is none of them is told with what was probably meant.
CLI::Validator one_of(std::vector<std::string> words);

/// An option that is one of `choices`, by its name.
template <class Choice, class Value>
CLI::Option* choice(CLI::App& command, const std::string& name, Value& value, const std::string& type,
                    const std::string& text, const std::vector<std::pair<std::string, Choice>>& choices) {
    std::vector<std::string> names;
    for (const auto& [one, meaning] : choices)
        names.push_back(one);
    return command
        .add_option_function<std::string>(
            name,
            [&value, choices](const std::string& given) {
                value = std::ranges::find(choices, given, &std::pair<std::string, Choice>::first)->second;
            },
            text)
        ->check(one_of(names))
        ->type_name(type);
}

/// Checks for numbers, finite ones: above 0; 0 or above.
CLI::Validator above_zero();
CLI::Validator not_negative();

/// A check for the names of a table or an enumeration.
CLI::Validator one_of_names(std::span<const std::string_view> names);

// Options that several commands have, each with one name and one text.

/// --json
void add_json_flag(CLI::App& command, bool& json);

/// --windowed, --monitor; `standard`: what is taken if none is named.
void add_screen_options(CLI::App& command, bool& windowed, std::string& monitor,
                        const std::string& standard = "the only one");
CLI::Option* add_monitor_option(CLI::App& command, std::string& monitor, const std::string& standard);

/// --sessions
void add_sessions_option(CLI::App& command, std::filesystem::path& sessions);

/// --context
void add_context_option(CLI::App& command, ContextChoice& context);

/// --quality, `least` or better.
void add_quality_option(CLI::App& command, std::optional<BakeQuality>& quality, const std::string& what,
                        BakeQuality least);

/// Checks of seeds, whole numbers that 64 bits hold, and of what lasts up to an hour.
CLI::Validator seed_number();
CLI::Validator seconds_up_to_an_hour();

/// --frame K or all, required; `what` says what becomes of either.
void add_frame_option(CLI::App& command, std::optional<int>& frame, const std::string& what);

} // namespace overt
