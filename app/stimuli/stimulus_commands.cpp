#include "app/stimuli/stimulus_commands.h"

#include "app/cli/command_options.h"

namespace overt {

namespace {

void add_play(CLI::App& app, ChosenCommand& chosen) {
    const auto [command, options] = add_command(
        app, chosen, run_play, "play", "Shows one animation, or one of its frames as a picture",
        "overt play protocols/overt_2019.toml --stimulus muse/smooth --frame 15 --picture frame.png");
    command.add_option("PROTOCOL", options.protocol, "Protocol file (TOML)")->required();
    option(command, "--stimulus", options.stimulus, "STIMULUS",
           "OBJECT/MATERIAL by their ids, then /LIGHT, /MOTION and /VIEW where there are several",
           must_be_given);
    option(command, "--frame", options.frame, "K", "Animation frame for --picture (default: 0)",
           not_negative());
    option(command, "--picture", options.picture, "FILE", "Write a PNG instead of opening a window");
    option(command, "--seconds", options.repeat_s, "S", "How long to play", shown_default);
    command.add_flag("--live", options.live,
                     "Draw it now, as an approximation, to be turned with the mouse: drag to turn and tilt, "
                     "wheel to go nearer, left and right for the material, up and down for the object, "
                     "space for the animation, Escape to end");
    add_context_option(command, options.context);
}

void add_pick_head(CLI::App& app, ChosenCommand& chosen) {
    const auto [command, options] = add_command(
        app, chosen, run_pick_head, "pick-head",
        "Outlines the head of a mesh with the mouse and prints the key `head` for a protocol",
        "overt pick-head scan.ply --up y\n"
        "  overt pick-head scan.ply --sphere 0 -15 310 60 --plane 0 0 262 0 0 1 --picture head.png");
    command.add_option("MESH", options.mesh, "PLY, OBJ, STL or glTF")->required();
    option(command, "--up", options.up, "", "Axis of the file that points up (z; of glTF y)",
           one_of({"x", "y", "z", "-x", "-y", "-z"}));
    option(command, "--unit", options.unit, "", "Unit of the file: mm, cm, m, in or own (mm; of glTF m)",
           one_of({"mm", "cm", "m", "in", "own"}));
    option(command, "--sphere", options.spheres, "X Y Z R",
           "A head to begin with, in the file's coordinates: inside this sphere, or another one");
    option(command, "--plane", options.planes, "X Y Z TO_X TO_Y TO_Z",
           "and in front of this plane: a point, and the direction in which the head lies");
    option(command, "--picture", options.picture, "FILE",
           "Write a PNG of the head that is given, without a window");
    option(command, "--turn", options.turn_deg, "DEG", "Turn of that picture's turntable, in degrees");
    add_context_option(command, options.context);
}

void add_paint_areas(CLI::App& app, ChosenCommand& chosen) {
    const auto [command, options] = add_command(
        app, chosen, run_paint_areas, "paint-areas",
        "Paints named areas on a mesh with a brush and writes the file `labels` of a protocol's object",
        "overt paint-areas scan.ply --area eyes,mouth\n"
        "  overt paint-areas scan.ply --labels scan_areas.txt --area nose      goes on\n"
        "  overt paint-areas scan.ply --area eye --dab eye -31 -70 240 12 --mirror eye --picture eyes.png\n"
        "In the window: left button paints, right button turns, wheel goes nearer, up and down make the "
        "brush "
        "larger and smaller, 1 to 9 and tab choose the area, 0 rubs out, g and s grow and shrink it, m "
        "paints the "
        "other side alike, backspace takes back, enter saves, Escape ends.");
    command.add_option("MESH", options.mesh, "PLY, OBJ, STL or glTF")->required();
    option(command, "--area", options.areas, "NAMES", "Areas to be painted, with commas")->delimiter(',');
    option(command, "--labels", options.labels, "FILE",
           "Labels to go on with, as an object's `labels` has them (default: those of the mesh file)");
    option(command, "--out", options.out, "FILE",
           "Where to write the labels (default: MESH_areas.txt beside it)");
    command.add_flag("--overwrite", options.overwrite, "Replace a file that is there");
    option(command, "--dab", options.dabs, "NAME X Y Z R",
           "Paint an area without a hand: about the place of the surface that is nearest to this one, with a "
           "brush of radius R, in the file's coordinates; once for each");
    option(command, "--mirror", options.mirrored, "NAME",
           "then paint an area alike on the other side of the middle, from left to right; once for each",
           one_each_time);
    option(command, "--up", options.up, "", "Axis of the file that points up (z; of glTF y)",
           one_of({"x", "y", "z", "-x", "-y", "-z"}));
    option(command, "--unit", options.unit, "", "Unit of the file: mm, cm, m, in or own (mm; of glTF m)",
           one_of({"mm", "cm", "m", "in", "own"}));
    option(command, "--picture", options.picture, "FILE", "Write a PNG of it, without a window");
    option(command, "--turn", options.turn_deg, "DEG", "Turn of that picture's turntable, in degrees");
    add_context_option(command, options.context);
}

void add_bake(CLI::App& app, ChosenCommand& chosen) {
    const auto [command, options] = add_command(
        app, chosen, run_bake, "bake", "Renders the stimuli by spectral path tracing, and keeps each frame",
        "overt bake protocols/overt_2019.toml --quality standard\n"
        "  overt bake protocols/overt_2019.toml --stimulus muse/rough --frames 0-30 --out frames --as "
        "spectra\n"
        "  overt bake protocols/overt_2019.toml --shard 3/16");
    command.add_option("PROTOCOL", options.protocol, "Protocol file (TOML)")->required();
    add_quality_option(command, options.quality,
                       "preview, draft, standard or reference (default: the protocol's, or standard if it "
                       "asks for no more than a preview)",
                       BakeQuality::preview);
    option(command, "--samples", options.samples, "N", "Light paths through each pixel, instead of the usual",
           CLI::Range(1, 65536));
    option(command, "--target-error", options.target_error_de, "DE",
           "Leave a pixel when its standard error is below this colour difference", CLI::Range(0.01, 100.0));
    option(command, "--stimulus", options.only, "STIMULUS",
           "Only this stimulus, OBJECT/MATERIAL by their ids, then /LIGHT, /MOTION and /VIEW where there are "
           "several; may be given several times");
    option(command, "--frames", options.frames, "RANGE", "Frames of the animation: K, A-B or all",
           shown_default);
    option(command, "--shard", options.shard, "I/N",
           "The part of machine I of N, I from 1; they share the cache, or join their caches later");
    option(command, "--out", options.out, "DIR",
           "Also write numbered frames: DIR/OBJECT_MATERIAL/frame_0000.exr, floats of 24 bits");
    option(command, "--as", options.as, "",
           "What is in those files: the display's linear light, XYZ, or 31 bins of radiance",
           one_of({"display", "xyz", "spectra"}), shown_default);
    command.add_flag(
        "--png16", options.png16,
        "16-bit PNG of linear display light over the background, clipped, each with a JSON file, "
        "instead of EXR");
    command.add_flag("--half", options.half,
                     "EXR of half floats: smaller, but of 65,536 levels 7,169 are left");
    command.add_flag("--overwrite", options.force, "Replace files that are there and were made otherwise");
    option(command, "--sheet", options.sheet, "FILE.png", "Also write a picture of all stimuli side by side");
    option(command, "--strip", options.strip, "FILE.png",
           "Also write a picture of frames of one stimulus side by side");
    command.add_flag("--dry-run", options.dry_run, "Only say what is to be done and how long it will take");
    add_context_option(command, options.context);
    add_json_flag(command, options.json);
}

void add_lut(CLI::App& app, ChosenCommand& chosen) {
    const auto [command, options] =
        add_command(app, chosen, run_lut, "lut",
                    "Writes or checks coordinate-encoded maps: where on the surface each pixel lies",
                    "overt lut protocols/overt_2019.toml --stimulus muse --frame 15 --out maps\n"
                    "  overt lut protocols/overt_2019.toml --stimulus muse --frame all --check");
    command.add_option("PROTOCOL", options.protocol, "Protocol file (TOML)")->required();
    option(command, "--stimulus", options.stimulus, "OBJECT",
           "OBJECT or OBJECT/MATERIAL by their ids; the map is the same for all materials and lights. With "
           "several views OBJECT/VIEW, with several motions the whole name",
           must_be_given);
    command.add_flag("--through", options.through,
                     "Where the line of sight leaves a body of clear glass, bent by Snell's law: needs "
                     "OBJECT/MATERIAL, and goes without --check");
    add_frame_option(command, options.frame, "Animation frame, or all");
    option(command, "--out", options.out, "DIR",
           "Folder to write to (default: luts/OBJECT; with --check nothing is written)");
    option(command, "--format", options.format, "",
           "exr: coordinates as floats; png16: 16-bit codes as colours, with a JSON sidecar; both",
           one_of({"exr", "png16", "both"}), shown_default);
    option(command, "--scale", options.scale, "", "Factor of 16-bit codes: 65535, or 65536 as in the paper",
           CLI::IsMember({65535, 65536}), shown_default);
    command.add_flag("--check", options.check,
                     "Compare with ray casting in double precision; exit code 1 if a target is missed");
    command.add_flag("--overwrite", options.overwrite, "Replace maps that are there");
    add_context_option(command, options.context);
    add_json_flag(command, options.json);
}

void add_reconstruct(CLI::App& app, ChosenCommand& chosen) {
    const auto [command, options] = add_command(
        app, chosen, run_reconstruct, "reconstruct",
        "Writes what the maps show of the object: a surface of one frame, or a cloud of all",
        "overt reconstruct protocols/overt_2019.toml --stimulus muse --frame 15 --out muse_15.ply\n"
        "  overt reconstruct protocols/overt_2019.toml --stimulus muse --frame all --out muse_cloud.ply");
    command.add_option("PROTOCOL", options.protocol, "Protocol file (TOML)")->required();
    option(command, "--stimulus", options.stimulus, "OBJECT",
           "OBJECT or OBJECT/MATERIAL by their ids; the maps are the same for all materials and lights. With "
           "several views OBJECT/VIEW",
           must_be_given);
    add_frame_option(
        command, options.frame,
        "Animation frame: the triangles between its pixels, cut at silhouettes and where one part hides "
        "another; or all: a cloud of the points that any frame shows");
    command.add_flag("--points", options.points, "A cloud of points also of one frame");
    option(command, "--spacing", options.spacing, "SIZE",
           "Keep one point in each cube of this size, in the unit of the mesh (default: the distance of "
           "neighbouring pixels)",
           not_negative());
    option(command, "--out", options.out, "FILE", "File to write: .ply or .obj", must_be_given);
    command.add_flag("--overwrite", options.overwrite, "Replace a file that is there");
    add_context_option(command, options.context);
    add_json_flag(command, options.json);
}

} // namespace

void add_stimulus_commands(CLI::App& app, ChosenCommand& chosen) {
    add_play(app, chosen);
    add_pick_head(app, chosen);
    add_paint_areas(app, chosen);
    add_bake(app, chosen);
    add_lut(app, chosen);
    add_reconstruct(app, chosen);
}

} // namespace overt
