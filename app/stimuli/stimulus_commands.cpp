#include "app/stimuli/stimulus_commands.h"

#include "app/cli/command_options.h"

namespace overt {

namespace {

void add_play(CLI::App& app, ChosenCommand& chosen) {
    const auto given = std::make_shared<PlayOptions>();
    PlayOptions& options = *given;
    CLI::App& command = add_command(
        app, "play", "Shows one animation, or one of its frames as a picture",
        "overt play protocols/overt_2019.toml --stimulus muse/smooth --frame 15 --picture frame.png");
    command.add_option("PROTOCOL", options.protocol, "Protocol file (TOML)")->required();
    command.add_option("--stimulus", options.stimulus, "SCULPTURE/MATERIAL by their ids")
        ->required()
        ->type_name("ID");
    command.add_option("--frame", options.frame, "Animation frame for --picture (default: 0)")
        ->type_name("K")
        ->check(not_negative());
    command.add_option("--picture", options.picture, "Write a PNG instead of opening a window")
        ->type_name("FILE");
    command.add_option("--duration", options.repeat_s, "How long to play")
        ->type_name("S")
        ->capture_default_str();
    command.add_flag("--live", options.live,
                     "Draw it now, as an approximation, to be turned with the mouse: drag to turn and tilt, "
                     "wheel to go nearer, left and right for the material, up and down for the sculpture, "
                     "space for the animation, Escape to end");
    add_context_option(command, options.context);
    run_when_chosen(command, chosen, [given] { return run_play(*given); });
}

void add_pick_head(CLI::App& app, ChosenCommand& chosen) {
    const auto given = std::make_shared<PickHeadOptions>();
    PickHeadOptions& options = *given;
    CLI::App& command = add_command(
        app, "pick-head",
        "Outlines the head of a mesh with the mouse and prints the key `head` for a protocol",
        "overt pick-head scan.ply --up y\n"
        "  overt pick-head scan.ply --sphere 0 -15 310 60 --plane 0 0 262 0 0 1 --picture head.png");
    command.add_option("MESH", options.mesh, "PLY, OBJ or STL")->required();
    command.add_option("--up", options.up, "Axis of the file that points up")
        ->check(CLI::IsMember({"x", "y", "z", "-x", "-y", "-z"}))
        ->capture_default_str();
    command.add_option("--unit", options.unit, "Unit of the file: mm, cm, m, in or own")
        ->check(CLI::IsMember({"mm", "cm", "m", "in", "own"}))
        ->capture_default_str();
    command
        .add_option("--sphere", options.spheres,
                    "A head to begin with, in the file's coordinates: inside this sphere, or another one")
        ->type_name("X Y Z R");
    command
        .add_option("--plane", options.planes,
                    "and in front of this plane: a point, and the direction in which the head lies")
        ->type_name("X Y Z TO_X TO_Y TO_Z");
    command
        .add_option("--picture", options.picture, "Write a PNG of the head that is given, without a window")
        ->type_name("FILE");
    command.add_option("--turn", options.turn_deg, "Turn of that picture's turntable, in degrees")
        ->type_name("DEG");
    add_context_option(command, options.context);
    run_when_chosen(command, chosen, [given] { return run_pick_head(*given); });
}

void add_bake(CLI::App& app, ChosenCommand& chosen) {
    const auto given = std::make_shared<BakeOptions>();
    BakeOptions& options = *given;
    CLI::App& command = add_command(
        app, "bake", "Renders the stimuli by spectral path tracing, and keeps each frame",
        "overt bake protocols/overt_2019.toml --quality standard\n"
        "  overt bake protocols/overt_2019.toml --only muse/rough --frames 0-30 --out frames --as spectra\n"
        "  overt bake protocols/overt_2019.toml --shard 3/16");
    command.add_option("PROTOCOL", options.protocol, "Protocol file (TOML)")->required();
    add_quality_option(
        command, options.quality,
        "preview, draft, standard or reference (default: the protocol's, or standard if it asks "
        "for no more than a preview)",
        {"preview", "draft", "standard", "reference"});
    command.add_option("--samples", options.samples, "Light paths through each pixel, instead of the usual")
        ->type_name("N")
        ->check(CLI::Range(1, 65536));
    command
        .add_option("--target-error", options.target_error_de,
                    "Leave a pixel when its standard error is below this colour difference")
        ->type_name("DE")
        ->check(CLI::Range(0.01, 100.0));
    command
        .add_option("--only", options.only,
                    "This stimulus, SCULPTURE/MATERIAL by their ids; may be given several times")
        ->type_name("ID");
    command.add_option("--frames", options.frames, "Frames of the animation: K, A-B or all")
        ->type_name("RANGE")
        ->capture_default_str();
    command
        .add_option("--shard", options.shard,
                    "The part of machine I of N, I from 1; they share the cache, or join their caches later")
        ->type_name("I/N");
    command
        .add_option("--out", options.out,
                    "Also write numbered frames: DIR/SCULPTURE_MATERIAL/frame_0000.exr, floats of 24 bits")
        ->type_name("DIR");
    command
        .add_option("--as", options.as,
                    "What is in those files: the display's linear light, XYZ, or 31 bins of radiance")
        ->check(CLI::IsMember({"display", "xyz", "spectra"}))
        ->capture_default_str();
    command.add_flag(
        "--png16", options.png16,
        "16-bit PNG of linear display light over the background, clipped, each with a JSON file, "
        "instead of EXR");
    command.add_flag("--half", options.half,
                     "EXR of half floats: smaller, but of 65,536 levels 7,169 are left");
    command.add_flag("--force", options.force, "Replace files that are there and were made otherwise");
    command.add_option("--sheet", options.sheet, "Also write a picture of all stimuli side by side")
        ->type_name("FILE.png");
    command
        .add_option("--strip", options.strip, "Also write a picture of frames of one stimulus side by side")
        ->type_name("FILE.png");
    command.add_flag("--dry-run", options.dry_run, "Only say what is to be done and how long it will take");
    add_context_option(command, options.context);
    command.add_flag("--json", options.json, "Print JSON");
    run_when_chosen(command, chosen, [given] { return run_bake(*given); });
}

void add_lut(CLI::App& app, ChosenCommand& chosen) {
    const auto given = std::make_shared<LutOptions>();
    LutOptions& options = *given;
    CLI::App& command = add_command(
        app, "lut", "Writes or checks coordinate-encoded maps: where on the surface each pixel lies",
        "overt lut protocols/overt_2019.toml --stimulus muse --frame 15 --out maps\n"
        "  overt lut protocols/overt_2019.toml --stimulus muse --frame all --check");
    command.add_option("PROTOCOL", options.protocol, "Protocol file (TOML)")->required();
    command
        .add_option("--stimulus", options.stimulus,
                    "SCULPTURE or SCULPTURE/MATERIAL by their ids; the map is the same for all materials")
        ->required()
        ->type_name("ID");
    add_frame_option(command, options.frame, "Animation frame, or all");
    command
        .add_option("--out", options.out,
                    "Folder to write to (default: luts/SCULPTURE; with --check nothing is written)")
        ->type_name("DIR");
    command
        .add_option("--format", options.format,
                    "exr: coordinates as floats; png16: 16-bit codes as colours, with a JSON sidecar; both")
        ->check(CLI::IsMember({"exr", "png16", "both"}))
        ->capture_default_str();
    command.add_option("--scale", options.scale, "Factor of 16-bit codes: 65535, or 65536 as in the paper")
        ->check(CLI::IsMember({65535, 65536}))
        ->capture_default_str();
    command.add_flag("--check", options.check,
                     "Compare with ray casting in double precision; exit code 1 if a target is missed");
    command.add_flag("--overwrite", options.overwrite, "Replace maps that are there");
    add_context_option(command, options.context);
    command.add_flag("--json", options.json, "Print JSON");
    run_when_chosen(command, chosen, [given] { return run_lut(*given); });
}

void add_reconstruct(CLI::App& app, ChosenCommand& chosen) {
    const auto given = std::make_shared<ReconstructOptions>();
    ReconstructOptions& options = *given;
    CLI::App& command = add_command(
        app, "reconstruct",
        "Writes what the maps show of the object: a surface of one frame, or a cloud of all",
        "overt reconstruct protocols/overt_2019.toml --stimulus muse --frame 15 --out muse_15.ply\n"
        "  overt reconstruct protocols/overt_2019.toml --stimulus muse --frame all --out muse_cloud.ply");
    command.add_option("PROTOCOL", options.protocol, "Protocol file (TOML)")->required();
    command
        .add_option("--stimulus", options.stimulus,
                    "SCULPTURE or SCULPTURE/MATERIAL by their ids; the maps are the same for all materials")
        ->required()
        ->type_name("ID");
    add_frame_option(
        command, options.frame,
        "Animation frame: the triangles between its pixels, cut at silhouettes and where one part hides "
        "another; or all: a cloud of the points that any frame shows");
    command.add_flag("--points", options.points, "A cloud of points also of one frame");
    command
        .add_option(
            "--spacing", options.spacing,
            "Keep one point in each cube of this size, in the unit of the mesh (default: the distance "
            "of neighbouring pixels)")
        ->type_name("SIZE")
        ->check(not_negative());
    command.add_option("--out", options.out, "File to write: .ply or .obj")->required()->type_name("FILE");
    command.add_flag("--overwrite", options.overwrite, "Replace a file that is there");
    add_context_option(command, options.context);
    command.add_flag("--json", options.json, "Print JSON");
    run_when_chosen(command, chosen, [given] { return run_reconstruct(*given); });
}

} // namespace

void add_stimulus_commands(CLI::App& app, ChosenCommand& chosen) {
    add_play(app, chosen);
    add_pick_head(app, chosen);
    add_bake(app, chosen);
    add_lut(app, chosen);
    add_reconstruct(app, chosen);
}

} // namespace overt
