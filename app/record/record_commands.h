/// The commands for recorded sessions: export, import, show, verify.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/chosen_command.h"
#include "app/cli/event_options.h"

namespace overt {

void add_record_commands(CLI::App& app, ChosenCommand& chosen);

/// `export`, whose options come from its formats.
void add_export(CLI::App& app, ChosenCommand& chosen);

struct ImportOptions {
    std::vector<std::filesystem::path> files; ///< one, or its samples and its events in two
    std::filesystem::path into; ///< a session whose gaze it becomes; empty: a session of its own
    std::filesystem::path out;
    std::filesystem::path sessions = "sessions";
    std::string observer; ///< empty: letters and digits of the file's name
    std::optional<int> session_number;
    bool is_another_person = false; ///< see SessionPlace
    std::string task = "imported";
    std::vector<double> screen_mm; ///< width and height, or empty
    std::optional<double> distance_mm;
    std::optional<std::string> missing; ///< in place of lost values; nothing: found in the file
    double least_read = 0.9;            ///< share of a recording's lines that must be read
    bool as_gaze = false;               ///< what the file does not say
    EventOptions events;
    std::filesystem::path print_session_to;
    bool json = false;
};
int run_import(const ImportOptions& options);

struct VerifyOptions {
    std::vector<std::filesystem::path> sessions;
    bool json = false;
};
int run_verify(const VerifyOptions& options);

struct ShowOptions {
    std::vector<std::filesystem::path> sessions;
    std::optional<int> trial;
    std::string slot; ///< of it; empty: the first that it shows something in
    std::filesystem::path picture;
    std::filesystem::path plot; ///< of the presentation's timing, SVG
    bool order = false;         ///< the order that was planned, made again from protocol and seed
    bool json = false;
};
int run_show(const ShowOptions& options);

} // namespace overt
