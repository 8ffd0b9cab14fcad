#include "app/cli/command_options.h"

#include <cmath>
#include <cstdint>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/diagnostics.h"
#include "experiment/base/text_number.h"

namespace overt {

namespace {

/// CLI11's own checks of these name the largest double there is.
CLI::Validator number_check(const char* name, const char* wish, bool (*holds)(double)) {
    return {[=](const std::string& given) {
                double value = 0.0;
                const bool is_good =
                    CLI::detail::lexical_cast(given, value) && std::isfinite(value) && holds(value);
                return is_good ? std::string() : fmt::format("'{}' is not a number {}", given, wish);
            },
            name};
}

} // namespace

CLI::Validator above_zero() {
    return number_check("POSITIVE", "above 0", [](double value) { return value > 0.0; });
}

CLI::Validator not_negative() {
    return number_check("NONNEGATIVE", "of 0 or above", [](double value) { return value >= 0.0; });
}

CLI::Validator seed_number() {
    return {[](const std::string& given) {
                return number_in<std::uint64_t>(given)
                           ? std::string()
                           : fmt::format("'{}' is not a whole number from 0 to {}", given, UINT64_MAX);
            },
            ""};
}

CLI::Validator seconds_up_to_an_hour() {
    return number_check("", "of seconds from 0 to 3600",
                        [](double value) { return value >= 0.0 && value <= 3600.0; });
}

CLI::Validator one_of(std::vector<std::string> words) {
    std::string type = fmt::format("{{{}}}", fmt::join(words, ","));
    return {[words = std::move(words)](const std::string& given) {
                if (std::ranges::find(words, given) != words.end())
                    return std::string();
                const std::vector<std::string_view> known(words.begin(), words.end());
                return fmt::format("there is no \"{}\": {}", given, suggest_name(given, known));
            },
            std::move(type)};
}

CLI::Validator one_of_names(std::span<const std::string_view> names) {
    return one_of(std::vector<std::string>(names.begin(), names.end()));
}

void add_json_flag(CLI::App& command, bool& json) { command.add_flag("--json", json, "Print JSON"); }

void add_screen_options(CLI::App& command, bool& windowed, std::string& monitor,
                        const std::string& standard) {
    command.add_flag("--windowed", windowed, "A window instead of the whole screen");
    add_monitor_option(command, monitor, standard);
}

CLI::Option* add_monitor_option(CLI::App& command, std::string& monitor, const std::string& standard) {
    return option(
        command, "--monitor", monitor, "WHICH",
        fmt::format("The screen to take: its number as `overt doctor` lists them, or the name of its output "
                    "or of its EDID (default: {})",
                    standard));
}

void add_sessions_option(CLI::App& command, std::filesystem::path& sessions) {
    option(command, "--sessions", sessions, "DIR", "Folder of all sessions", shown_default);
}

void add_quality_option(CLI::App& command, std::optional<BakeQuality>& quality, const std::string& what,
                        BakeQuality least) {
    std::vector<std::pair<std::string, BakeQuality>> qualities;
    for (auto i = static_cast<std::size_t>(least); i < names_of<BakeQuality>.size(); ++i)
        qualities.emplace_back(names_of<BakeQuality>[i], static_cast<BakeQuality>(i));
    choice(command, "--quality", quality, "QUALITY", what, qualities);
}

void add_context_option(CLI::App& command, ContextChoice& context) {
    choice<ContextChoice>(
        command, "--context", context, "KIND",
        "OpenGL through auto (a window where there is a display, else EGL with a graphics processor, "
        "else OSMesa), window, egl or osmesa",
        {{"auto", std::nullopt},
         {"window", ContextKind::window},
         {"egl", ContextKind::egl},
         {"osmesa", ContextKind::osmesa}});
}

CLI::App& add_command(CLI::App& app, const std::string& name, const std::string& what,
                      const std::string& example) {
    CLI::App& command = *app.add_subcommand(name, what);
    command.footer("Example:\n  " + example + "\n");
    return command;
}

void run_when_chosen(CLI::App& command, ChosenCommand& chosen, ChosenCommand run) {
    command.callback([&chosen, run = std::move(run)] { chosen = run; });
}

void add_frame_option(CLI::App& command, std::optional<int>& frame, const std::string& what) {
    command
        .add_option_function<std::string>(
            "--frame",
            [&frame](const std::string& given) {
                if (given != "all")
                    frame = std::stoi(given);
            },
            what)
        ->required()
        ->check(CLI::IsMember({"all"}) | CLI::Range(0, 9999))
        ->type_name("K|all");
}

} // namespace overt
