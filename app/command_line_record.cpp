#include "app/command_line_groups.h"

namespace overt {

namespace {

void add_export(CLI::App& app, ChosenCommand& chosen) {
    const auto given = std::make_shared<ExportOptions>();
    ExportOptions& options = *given;
    CLI::App& command =
        add_command(app, "export", "Writes sessions as tables for other tools",
                    "overt export sessions/overt_2019/sub-07_ses-01 --format tsv --out tables");
    command.add_option("SESSION", options.sessions, "Folders of sessions")->required();
    command.add_option("--format", options.format, "tsv, csv: tables with a dictionary of their columns")
        ->check(CLI::IsMember({"tsv", "csv"}))
        ->capture_default_str();
    command
        .add_option("--out", options.out,
                    "Folder to write to (default: export_FORMAT in the session; for several sessions a folder "
                    "each is made in it)")
        ->type_name("DIR");
    command
        .add_option("--cone-deg", options.cone_deg,
                    "Add the probability that the gaze was on the sculpture, and on each of its parts, for a "
                    "tracker that is so far off on average (a usual accuracy: 0.5)")
        ->type_name("DEG")
        ->check(CLI::Range(0.0, 20.0));
    command.add_flag("--overwrite", options.overwrite, "Replace an export that is there");
    run_when_chosen(command, chosen, [given] { return run_export(*given); });
}

void add_show(CLI::App& app, ChosenCommand& chosen) {
    const auto given = std::make_shared<ShowOptions>();
    ShowOptions& options = *given;
    CLI::App& command =
        add_command(app, "show", "What a session holds, and one trial as a picture",
                    "overt show sessions/overt_2019/sub-07_ses-01 --trial 3 --picture trial.png");
    command.add_option("SESSION", options.session, "Folder of a session")->required();
    command.add_option("--trial", options.trial, "Trial for --picture, counted from 1 (default: the first)")
        ->type_name("N")
        ->check(CLI::PositiveNumber);
    command
        .add_option("--picture", options.picture,
                    "Write a PNG: a frame, its map, and the gaze on the surface")
        ->type_name("FILE");
    command
        .add_option("--plot", options.plot,
                    "Write an SVG of the presentations' timing: intervals of refreshes, trial by trial")
        ->type_name("FILE");
    command.add_flag(
        "--order", options.order,
        "The planned order of trials, made again from the recorded protocol and seed; exit code 1 "
        "if that gives another");
    command.add_flag("--json", options.json, "Print JSON");
    run_when_chosen(command, chosen, [given] { return run_show(*given); });
}

} // namespace

void add_record_commands(CLI::App& app, ChosenCommand& chosen) {
    add_export(app, chosen);
    add_show(app, chosen);
}

} // namespace overt
