#include "app/command_line.h"

#include "app/command_line_groups.h"
#include "build_info.h"

namespace overt {

namespace {

const char* const synopsis =
    "Eye-tracking experiments on animated 3D objects, from a protocol file to points on the surface.";

const char* const exit_codes =
    "Exit codes: 0 done, 1 failed, 2 bad input.\n"
    "Frames, maps and sculptures are kept in $OVERT_CACHE (default: ~/.cache/overt).";

} // namespace

int run_command_line(int argc, char** argv) {
    CLI::App app(synopsis, "overt");
    app.set_version_flag("--version", std::string("overt ") + build::version);
    app.require_subcommand(1);
    app.footer(exit_codes);
    app.get_formatter()->column_width(34);
    ChosenCommand chosen;
    add_session_commands(app, chosen);
    add_record_commands(app, chosen);
    add_stimulus_commands(app, chosen);
    add_display_commands(app, chosen);
    add_machine_commands(app, chosen);

    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        // Help and version arrive here too, with code 0; all else is bad input.
        return app.exit(error) == 0 ? 0 : 2;
    }
    return chosen();
}

} // namespace overt
