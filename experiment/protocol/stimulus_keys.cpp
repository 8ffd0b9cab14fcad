#include "experiment/protocol/key_rows.h"

namespace overt::key_rows {

namespace {

constexpr std::string_view units[] = {"mm", "cm", "m", "in", "own"};
constexpr std::string_view axes[] = {"x", "y", "z", "-x", "-y", "-z"};

Section head() {
    using S = SculptureSettings;
    return {.name = "head",
            .explanation = "Which part of a mesh is the head: inside any of the spheres, and in front of all "
                           "of the planes. Coordinates are those of the mesh file; with `lut`, those of the "
                           "maps.",
            .keys = {
                {{.name = "spheres",
                  .if_left_out = "the mesh has no head",
                  .explanation = "Middle and radius of each sphere."},
                 &S::head_spheres},
                {{.name = "planes",
                  .if_left_out = "nothing is cut off",
                  .explanation = "A point of each plane, and the direction in which the head lies."},
                 &S::head_planes},
            }};
}

} // namespace

Section view() {
    using V = ViewSettings;
    return {
        .name = "view",
        .explanation = "The image and its camera, the same for all stimuli. +z is up; a sculpture turns "
                       "about the vertical through the middle of its bounding box.",
        .keys =
            {
                {{.name = "width_px",
                  .unit = "px",
                  .low = 8,
                  .high = 16384,
                  .explanation = "Width of the stimulus, shown pixel for pixel."},
                 &V::width_px},
                {{.name = "height_px",
                  .unit = "px",
                  .low = 8,
                  .high = 16384,
                  .explanation = "Height of the stimulus."},
                 &V::height_px},
                {{.name = "left_px",
                  .unit = "px",
                  .low = 0,
                  .high = 16384,
                  .if_left_out = "in the middle of the screen",
                  .explanation = "Columns of the screen to the left of the stimulus."},
                 &V::left_px},
                {{.name = "top_px",
                  .unit = "px",
                  .low = 0,
                  .high = 16384,
                  .if_left_out = "in the middle of the screen",
                  .explanation = "Rows of the screen above the stimulus."},
                 &V::top_px},
                {{.name = "centre_right_deg",
                  .unit = "deg",
                  .low = -80,
                  .high = 80,
                  .if_left_out = "see `left_px`",
                  .explanation = "Angle from the middle of the screen to the middle of the stimulus, "
                                 "positive to the right; to the nearest pixel."},
                 &V::centre_right_deg},
                {{.name = "centre_up_deg",
                  .unit = "deg",
                  .low = -80,
                  .high = 80,
                  .if_left_out = "see `top_px`",
                  .explanation = "The same upwards."},
                 &V::centre_up_deg},
                {{.name = "vertical_fov_deg",
                  .unit = "deg",
                  .low = 0.1,
                  .high = 170,
                  .if_left_out = "the angle under which the observer sees the image",
                  .explanation = "The camera's full angle over the height of the image."},
                 &V::vertical_fov_deg},
                {{.name = "margin",
                  .low = 0,
                  .high = 0.45,
                  .explanation = "Share of the image left free on each side where the camera is fitted to "
                                 "a sculpture."},
                 &V::margin},
                {{.name = "camera_position",
                  .if_left_out = "fitted to each sculpture",
                  .explanation = "Where the camera stands, in the unit of the mesh."},
                 &V::camera_position},
                {{.name = "camera_target",
                  .if_left_out = "the middle of the bounding box",
                  .explanation = "What the camera looks at."},
                 &V::camera_target},
            },
        .home = &Protocol::view};
}

Section light() {
    using L = LightSettings;
    return {.name = "light",
            .explanation = "What surrounds the sculptures and is reflected in them.",
            .keys =
                {
                    {{.name = "probe",
                      .explanation =
                          "\"gallery\" for a hall with windows, lamps and a low sun, in which gloss is "
                          "seen best, \"overcast\" for a cloudy sky, or a latitude-longitude "
                          "picture of the surroundings (EXR or HDR, linear Rec. 709, +y up)."},
                     &L::probe},
                    {{.name = "exposure",
                      .low = 1e-6,
                      .high = 1e6,
                      .explanation = "Factor from the probe's radiance to the display's white."},
                     &L::exposure},
                    {{.name = "rotation_deg",
                      .unit = "deg",
                      .low = -360,
                      .high = 360,
                      .explanation = "Turns the surroundings about the vertical."},
                     &L::rotation_deg},
                },
            .home = &Protocol::light};
}

Section animation() {
    using A = Animation;
    return {
        .name = "animation",
        .explanation = "How the sculptures turn: to and fro about the vertical, as a sine.",
        .keys =
            {
                {{.name = "frame_count",
                  .low = 1,
                  .high = 10000,
                  .explanation = "Frames of the animation; with `cycle` the last closes the loop, being "
                                 "the first again."},
                 &A::frame_count},
                {{.name = "frame_rate_hz",
                  .unit = "Hz",
                  .low = 0.1,
                  .high = 1000,
                  .explanation = "Frames per second, if the refresh rate is a whole multiple of it; see "
                                 "`display.refresh_hz`."},
                 &A::frame_rate_hz},
                {{.name = "amplitude_deg",
                  .unit = "deg",
                  .low = 0,
                  .high = 180,
                  .explanation = "Largest turn to each side of the front view."},
                 &A::amplitude},
                {{.name = "playback",
                  .explanation = "The frames hold a whole period of the sine, or one sweep from end to end "
                                 "that is played forth and back."},
                 &A::playback},
                {{.name = "duration_s",
                  .unit = "s",
                  .low = 0.01,
                  .high = 3600,
                  .explanation = "Length of one presentation at `frame_rate_hz`, a whole number of frames."},
                 &A::duration_s},
                {{.name = "when_late",
                  .explanation = "What becomes of the animation when a picture comes late: it keeps time and "
                                 "drops the frames whose time has passed, or it keeps all frames and ends "
                                 "later. Either way the record names each refresh that was missed."},
                 &A::when_late},
            },
        .home = &Protocol::animation};
}

Section sculpture() {
    using S = SculptureSettings;
    return {
        .name = "sculpture",
        .explanation = "A thing to look at: one of the sculptures that overt makes itself (`shipped`), or "
                       "one of yours (`mesh`, or ready-made maps, `lut`). At least one.",
        .keys =
            {
                {{.name = "id",
                  .is_required = true,
                  .is_identifier = true,
                  .explanation = "Short name, used in file names and tables."},
                 &S::id},
                {{.name = "title", .if_left_out = "the id", .explanation = "Name for figures and reports."},
                 &S::title},
                {{.name = "shipped",
                  .if_left_out = "see `mesh` and `lut`",
                  .explanation =
                      "A sculpture that overt makes itself, its head being known: \"muse\", \"runner\" or "
                      "\"scholar\"."},
                 &S::shipped},
                {{.name = "mesh",
                  .if_left_out = "see `shipped` and `lut`",
                  .explanation = "A PLY, OBJ or STL file of triangles, by its path from the protocol's "
                                 "folder."},
                 &S::mesh},
                {{.name = "up", .choices = axes, .explanation = "The axis of the mesh file that points up."},
                 &S::up},
                {{.name = "scale",
                  .low = 1e-9,
                  .high = 1e9,
                  .explanation = "Factor on the coordinates of the mesh file."},
                 &S::scale},
                {{.name = "unit",
                  .choices = units,
                  .explanation =
                      "Unit of the mesh file's coordinates times `scale`. Surface points, maps and "
                      "the camera are in millimetres, whatever it is; with \"own\", for a mesh "
                      "whose unit is unknown, in the file's, and every export says so."},
                 &S::unit},
                {{.name = "labels",
                  .if_left_out = "the labels of the mesh file, if it has any",
                  .explanation = "A text file with a whole number for each triangle of the mesh, or for each "
                                 "vertex: which part it belongs to. Lines `# part 1 head` name parts. Not "
                                 "beside `head`."},
                 &S::labels},
                {{.name = "lut",
                  .if_left_out = "maps are made from the mesh",
                  .explanation = "Instead of a mesh, for a sculpture whose `[[frames]]` another program "
                                 "rendered: the coordinate-encoded maps that it made of them, with # for the "
                                 "digits of the number: \"maps/frame_####.png\". See "
                                 "docs/coordinate_maps.md."},
                 &S::lut},
                {{.name = "lut_first_number",
                  .low = 0,
                  .high = 1000000,
                  .explanation = "Number of the first map's file."},
                 &S::lut_first_number},
                {{.name = "lut_scale",
                  .low = 65535,
                  .high = 65536,
                  .if_left_out = "from the JSON file beside each map",
                  .explanation = "Code of the far side of the box: 65535 for colours from 0 to 1 saved with "
                                 "16 bits, 65536 for the paper's formula."},
                 &S::lut_scale},
                {{.name = "lut_min",
                  .if_left_out = "from the JSON file beside each map",
                  .explanation = "Corner of the box that the maps are coded by, with the smallest "
                                 "coordinates."},
                 &S::lut_min},
                {{.name = "lut_max",
                  .if_left_out = "from the JSON file beside each map",
                  .explanation = "Corner of the box with the largest coordinates."},
                 &S::lut_max},
            },
        .tables = {head()},
        .home = &Protocol::sculptures};
}

Section material() {
    using M = MaterialSettings;
    return {
        .name = "material",
        .explanation = "What every sculpture is made of in turn. At least one.",
        .keys =
            {
                {{.name = "id",
                  .is_required = true,
                  .is_identifier = true,
                  .explanation = "Short name, used in file names and tables."},
                 &M::id},
                {{.name = "title", .if_left_out = "the id", .explanation = "Name for figures and reports."},
                 &M::title},
                {{.name = "kind",
                  .choices = names_in<material_kinds>,
                  .is_required = true,
                  .explanation = "Polished metal, brushed metal, polished metal under a bumpy coloured "
                                 "coat, or a matt surface."},
                 &M::kind},
                {{.name = "metal",
                  .explanation = "\"Au\" for gold, \"Ag\" for silver, or a table of another conductor: a "
                                 "CSV file with the columns wavelength_nm, n and k, by its path from the "
                                 "protocol's folder."},
                 &M::metal},
                {{.name = "roughness",
                  .low = 0.001,
                  .high = 1,
                  .explanation = "GGX alpha of a rough conductor."},
                 &M::roughness},
                {{.name = "coat_ior", .low = 1, .high = 4, .explanation = "Index of refraction of the coat."},
                 &M::coat_ior},
                {{.name = "coat_absorbance",
                  .low = 0,
                  .high = 100,
                  .explanation = "Optical depth of the coat in red, green and blue, for one pass of its "
                                 "nominal thickness."},
                 &M::coat_absorbance},
                {{.name = "coat_thickness",
                  .low = 0.0001,
                  .high = 0.1,
                  .explanation = "Nominal thickness of the coat, as share of half the sculpture's height."},
                 &M::coat_thickness},
                {{.name = "coat_bump",
                  .low = 0,
                  .high = 0.2,
                  .explanation = "Height of the coat's bumps, as share of half the sculpture's height; the "
                                 "coat is nowhere thinner than a tenth of its nominal thickness."},
                 &M::coat_bump},
                {{.name = "coat_bump_width",
                  .low = 0.005,
                  .high = 2,
                  .explanation = "From one bump to the next, as share of half the sculpture's height."},
                 &M::coat_bump_width},
                {{.name = "coat_seed",
                  .low = 0,
                  .high = 2147483647,
                  .explanation = "Another number, other bumps."},
                 &M::coat_seed},
                {{.name = "reflectance",
                  .low = 0,
                  .high = 1,
                  .explanation = "Share of red, green and blue light that a matt surface returns."},
                 &M::reflectance},
            },
        .home = &Protocol::materials};
}

} // namespace overt::key_rows
