#include <fmt/format.h>

#include "experiment/protocol/keys/key_rows.h"

namespace overt::key_rows {

namespace {

constexpr std::string_view units[] = {"mm", "cm", "m", "in", "own"};
constexpr std::string_view axes[] = {"x", "y", "z", "-x", "-y", "-z"};

/// The keys that the entries of all lists have, and after them the list's own.
template <class Entry> std::vector<Key> entry_keys(std::vector<Key> own, bool is_never_empty = false) {
    std::vector<Key> keys{
        {"id", member_of<Entry>(&ListEntry::id),
         identifier().left_out(is_never_empty ? "of the only entry the list's name; else as it is called"
                                              : "as it is called"),
         "Short name, used in file names and tables. An entry is called by the value of its key `shipped`, "
         "`mesh`, `kind`, `probe` or `picture`, the ending of a file left out; without any, by its list."},
        {"title", member_of<Entry>(&ListEntry::title), left_out("the id"), "Name for figures and reports."},
        {"columns", member_of<Entry>(&ListEntry::columns), left_out("none"),
         "What tables are to say of it besides, words or numbers: `{gloss=\"high\", size_cm=12}`. Each "
         "name is a factor, by which trials are ordered, limited and analysed as by the list itself."},
        {"series", member_of<Entry>(&ListEntry::series), left_out("one entry"),
         "Several entries in place of this one, which differ in the value of a key that takes a number, a "
         "word or a file: `{roughness=[0.02, 0.05, 0.1]}` makes three, with the ids ID-0.02 and so on, and "
         "a column of the key's name. Of several keys the first values belong together, then the second. "
         "`{mesh=\"shapes/*.ply\"}` stands for all files of the folder that fit, by their names; which those "
         "were is kept in the record."},
    };
    keys.insert(keys.end(), own.begin(), own.end());
    return keys;
}

} // namespace

std::vector<Key> area() {
    using A = AreaSettings;
    return {
        {"spheres", &A::spheres, left_out("none"), "Middle and radius of each sphere."},
        {"boxes", &A::boxes, left_out("none"),
         "Two corners of each box: the one with the smallest coordinates, and the one with the largest."},
        {"groups", &A::groups, left_out("none"),
         "Names of parts that the mesh file labels, such as the groups of an OBJ file, or that `labels` "
         "names."},
        {"planes", &A::planes, left_out("nothing is cut off"),
         "A point of each plane, and the direction in which the area lies."},
        {"rectangles", &A::rectangles, left_out("none"),
         "Of a `picture`: left, top, right and bottom of each rectangle, in pixels of the picture from its "
         "top left corner."},
        {"discs", &A::discs, left_out("none"),
         "Of a `picture`: x and y of the middle, and the radius, of each disc, likewise."},
    };
}

std::vector<Key> view() {
    using V = ViewSettings;
    return entry_keys<V>(
        {
            {"width_px", &V::width_px, range(8, 16384, "px"),
             "Width of the stimulus, shown pixel for pixel."},
            {"height_px", &V::height_px, range(8, 16384, "px"), "Height of the stimulus."},
            {"left_px", &V::left_px, range(0, 16384, "px").left_out("in the middle of the screen"),
             "Columns of the screen to the left of the stimulus."},
            {"top_px", &V::top_px, range(0, 16384, "px").left_out("in the middle of the screen"),
             "Rows of the screen above the stimulus."},
            {"centre_right_deg", &V::centre_right_deg, range(-80, 80, "deg").left_out("see `left_px`"),
             "Angle from the middle of the screen to the middle of the stimulus, positive to the right; to "
             "the "
             "nearest pixel."},
            {"centre_up_deg", &V::centre_up_deg, range(-80, 80, "deg").left_out("see `top_px`"),
             "The same upwards."},
            {"vertical_fov_deg", &V::vertical_fov_deg,
             range(0.1, 170, "deg").left_out("the angle under which the observer sees the image"),
             "The camera's full angle over the height of the image."},
            {"margin", &V::margin, range(0, 0.45),
             "Share of the image left free on each side where the camera is fitted to an object."},
            {"camera_position", &V::camera_position, left_out("fitted to each object"),
             "Where the camera stands, in the unit of the mesh."},
            {"camera_target", &V::camera_target, left_out("the middle of the bounding box"),
             "What the camera looks at."},
            {"two_eyes", &V::two_eyes,
             "With `[stereo]`, whether each eye sees the object from its own place; `false`: both see it "
             "from "
             "the middle, as a picture in the plane of the screen. Of two views, one of each kind, stereo is "
             "a factor."},
        },
        true);
}

std::vector<Key> light() {
    using L = LightSettings;
    return entry_keys<L>(
        {
            {"probe", &L::probe,
             "\"gallery\" for a hall with windows, lamps and a low sun, in which gloss is seen best, "
             "\"overcast\" for a cloudy sky, \"dark\" for none, or a latitude-longitude picture of the "
             "surroundings (EXR or HDR, linear Rec. 709, +y up)."},
            {"exposure", &L::exposure, range(1e-6, 1e6),
             "Factor from the probe's radiance to the display's white."},
            {"rotation_deg", &L::rotation_deg, range(-360, 360, "deg"),
             "Turns the surroundings about the vertical, with their sun and lamps."},
            {"unit_cd_m2", &L::unit_cd_m2,
             range(1e-6, 1e9, "cd/m2").left_out("1 with `dark`; else not known, and needed by sun and lamps"),
             "The luminance that the probe's 1 stands for. Then `exposure` = 1 / N shows N of these as the "
             "display's white."},
            {"sun_lux", &L::sun_lux, range(0, 1e6, "lux").left_out("no sun but what the probe has"),
             "Illuminance by a sun that is added to the probe, on a surface that faces it; the real one "
             "gives "
             "100,000 lx from a clear sky."},
            {"sun_azimuth_deg", &L::sun_azimuth_deg, range(-360, 360, "deg"),
             "Where the sun stands: 0 behind the observer, 90 to the observer's right, 180 behind the "
             "object."},
            {"sun_elevation_deg", &L::sun_elevation_deg, range(-90, 90, "deg"), "How high."},
            {"sun_radius_deg", &L::sun_radius_deg, range(0.01, 45, "deg"),
             "Half the angle that it fills: the larger, the softer its shadows, at the same illuminance."},
            {"sun_colour", &L::sun_colour, range(0, 1),
             "Linear red, green and blue (Rec. 709) of its light; only their proportions count."},
            {"lamps", &L::lamps, left_out("none"), "Ids of `[[lamp]]`s that shine besides."},
            {"sum", &L::sum, range(0, 1e6).left_out("none"),
             "In place of all these keys but `exposure`: other lights of this list, each times a number, "
             "`{ key = 1, fill = 0.25 }`. Nothing is rendered for it: the frames of those are added up."},
        },
        true);
}

std::vector<Key> lamp() {
    using L = LampSettings;
    return {
        {"id", &L::id, identifier().required(), "Short name, by which lights name it."},
        {"shape", &L::shape, "What shines. A rectangle and a disc do to the side that they face."},
        {"luminance_cd_m2", &L::cd_m2, range(1e-6, 1e9, "cd/m2").required(), "Its luminance."},
        {"colour", &L::colour, range(0, 1),
         "Linear red, green and blue (Rec. 709) of its light; only their proportions count."},
        {"position", &L::position, required(),
         "Its middle, [x, y, z]: x to the right of the front view, y away from it, z up."},
        {"faces", &L::faces, left_out("the centre of the object's box"),
         "The place that a rectangle or disc is turned to. Its width is level."},
        {"width", &L::width, range(0, 1e6), "Of a rectangle."},
        {"height", &L::height, range(0, 1e6), "Of a rectangle."},
        {"radius", &L::radius, range(0, 1e6), "Of a disc or sphere."},
    };
}

std::vector<Key> background() {
    using B = BackgroundSettings;
    return entry_keys<B>(
        {
            {"grey", &B::grey, range(0, 1).left_out("that of `[display] background`"),
             "Linear grey, 1 being the display's white."},
            {"colour", &B::colour, range(0, 1).left_out("see `grey`"),
             "Linear red, green and blue of the display, 1 being each at its fullest."},
            {"picture", &B::picture, left_out("see `grey`"),
             "A picture behind the object, by its path from the protocol's folder: EXR or HDR, linear, or "
             "PNG, JPEG or TIFF, sRGB, of Rec. 709 colours of which white is the display's white. It is "
             "made as large as it must be to cover the image, about its middle."},
        },
        true);
}

std::vector<Key> motion() {
    using M = MotionSettings;
    using A = Animation;
    using O = ObserverTurn;
    constexpr O M::*turn = &M::by_observer;
    return entry_keys<M>(
        {
            {"kind", member_of<M>(&A::kind),
             explanation_of_kinds<MotionKind>("What the object does, while the light may turn with any.")},
            {"frame_count", member_of<M>(&A::frame_count), range(1, 10000),
             "Frames of the animation; with `cycle` the last closes the loop, being the first again."},
            {"frame_rate_hz", member_of<M>(&A::frame_rate_hz), range(0.1, 1000, "Hz"),
             "Frames per second, if the refresh rate is a whole multiple of it; see `display.refresh_hz`."},
            {"amplitude_deg", member_of<M>(&A::amplitude), range(0, 180, "deg"),
             "Largest turn to each side of `angle_deg`, where the object turns to and fro."},
            {"angle_deg", member_of<M>(&A::angle), range(-360, 360, "deg"),
             "Where a still object stands, or from where it turns: counter-clockwise from the front view, "
             "seen from above."},
            {"light_amplitude_deg", member_of<M>(&A::light_amplitude), range(0, 180, "deg"),
             "Largest turn of the surroundings to each side of where `[light]` has them, as a sine in step "
             "with that of `turn`."},
            {"light_turns", member_of<M>(&A::light_turns), range(-100, 100),
             "Full turns of the surroundings while the frames go by once, at one speed; negative: "
             "clockwise."},
            {"turns", member_of<M>(&A::turns), range(-100, 100),
             "Of `turntable` and `orbit`: full turns while the frames go by once; negative: clockwise."},
            {"axis", member_of<M>(&A::axis), left_out("the vertical"),
             "About which the object turns, [x, y, z]: x to the right of the front view, y away from it, z "
             "up. "
             "The turn by `angle_deg` comes before."},
            {"pivot", member_of<M>(&A::pivot), left_out("the centre of the object's box"),
             "A point of the axis, from the centre of the object's box, in the unit of the mesh."},
            {"rest_share", member_of<M>(&A::rest_share), range(0, 0.99),
             "Of `trapezoid`: share of the time that the object rests at its two ends, together."},
            {"ease", member_of<M>(&A::ease),
             "Of `triangle` and `trapezoid`: at one speed from end to end, or slowly out of one and into the "
             "other, with the least jerk."},
            {"angles_deg", member_of<M>(&A::angles_deg), range(-360, 360, "deg").left_out("none"),
             "Of `steps`: where the object stands, one after the other, for as many frames each, from "
             "`angle_deg`."},
            {"waves", member_of<M>(&A::waves), range(-360, 360).left_out("none"),
             "Of `waves`: each sine's amplitude in degrees, its whole periods while the frames go by once, "
             "and "
             "its phase in degrees: `[[20, 1, 0], [5, 3, 90]]`."},
            {"approach_mm", member_of<M>(&A::approach), range(-1e6, 1e6),
             "Of `approach`: how far the object comes nearer, towards the front, in the unit of the mesh."},
            {"keyframes", member_of<M>(&A::keyframes), left_out("none"),
             "Of `keyframes`: a table of places by the time, a CSV file by its path from the protocol's "
             "folder. "
             "Its columns: t_s; x, y, z in the unit of the mesh and qw, qx, qy, qz of a rotation from the "
             "front "
             "view, or angle_deg; light_deg. Only t_s is needed."},
            {"between", member_of<M>(&A::between),
             "What is between two of its rows: the former, or a straight way at one speed."},
            {"recorded", member_of<M>(&A::recorded), left_out("none"),
             "Of `recorded`: tables of how observers turned objects, as `courses` of `overt export --format "
             "tsv`, by their paths from the protocol's folder. Several, or one of several observers: the "
             "observers of this session have them in turn, by their numbers."},
            {"matched_by", member_of<M>(&A::matched_by),
             "Of `recorded`: whether a trial shows again one with the same stimulus (but for the motion) in "
             "the same slot, in the order of the recording where there are several, or the one with its own "
             "number."},
            {"playback", member_of<M>(&A::playback),
             "The frames hold a whole period of the sine, or one sweep from end to end that is played forth "
             "and "
             "back."},
            {"duration_s", member_of<M>(&A::duration_s), range(0.01, 3600, "s"),
             "Length of one presentation at `frame_rate_hz`, a whole number of frames."},
            {"when_late", member_of<M>(&A::when_late),
             "What becomes of the animation when a picture comes late: it keeps time and drops the frames "
             "whose "
             "time has passed, or it keeps all frames and ends later. Either way the record names each "
             "refresh "
             "that was missed."},
            {"step_deg", turn, &O::step, range(0.05, 180, "deg"),
             "Of observer: from one pose to the next. Each pose is a picture that is rendered and kept."},
            {"from_deg", turn, &O::from, range(-360, 360, "deg"),
             "Of observer: how far clockwise it can be turned, from the front view; a whole number of steps "
             "before `to_deg`."},
            {"to_deg", turn, &O::to, range(-360, 720, "deg"),
             "Of observer: how far counter-clockwise. 360 deg after `from_deg` it goes all round."},
            {"elevation_step_deg", turn, &O::elevation_step,
             range(0, 90, "deg").left_out("0: it turns about the vertical alone"),
             "Of observer: from one elevation to the next. Each turn is a pose at each elevation, so that "
             "there are as many pictures as turns times elevations."},
            {"elevation_from_deg", turn, &O::elevation_from, range(-90, 90, "deg"),
             "Of observer: the lowest elevation, a turn about the horizontal line to the observer's right. "
             "At positive ones the object is seen more from above. It comes up at 0, or as near as there is "
             "one."},
            {"elevation_to_deg", turn, &O::elevation_to, range(-90, 90, "deg"),
             "Of observer: the highest, a whole number of steps above."},
            {"start",
             turn,
             &O::start,
             {},
             "Of observer: whether it comes up in the pose nearest to `angle_deg`, or in one that is drawn "
             "for "
             "each trial. In further steps of a trial it stands as it was left."},
            {"with",
             turn,
             &O::with,
             {},
             "Of observer: turned by dragging with the mouse and by its wheel, by held keys, or by either."},
            {"keys", turn, &O::keys, left_out("left, right, and with elevations up, down"),
             "Of observer: the key that turns the front to the left, and the one that turns it to the "
             "right; with elevations also those that take it up and down."},
            {"speed_deg_s", turn, &O::speed_deg_s, range(1, 1000, "deg/s"),
             "Of observer: how fast it turns while a key is held. It stops when the key is let go."},
            {"drag_deg", turn, &O::drag_deg, range(1, 3600, "deg"),
             "Of observer: how far a drag over the width of its image turns it, or a drag as long up or "
             "down. "
             "The wheel turns it by a pose."},
            {"simulated_turn_deg", turn, &O::simulated_turn_deg, range(0, 720, "deg"),
             "Of observer: standard deviation of the turns that a simulated observer makes by its keys, one "
             "after the other."},
            {"simulated_pause_s", turn, &O::simulated_pause_s, range(0.01, 60, "s"),
             "Of observer: for how long a simulated observer looks between two turns, in the median; "
             "log-normal."},
        },
        true);
}

std::vector<Key> object() {
    using S = ObjectSettings;
    return entry_keys<S>({
        {"shipped", &S::shipped, left_out("see `mesh` and `lut`"),
         "An object that overt makes itself, with the areas head, body and plinth: \"muse\", \"runner\" or "
         "\"scholar\"; or one of 24 novel shapes with the areas trunk, crest, left and right: \"shape-01\" "
         "to \"shape-24\"."},
        {"mesh", &S::mesh, left_out("see `shipped` and `lut`"),
         "A PLY, OBJ, STL or glTF file (.gltf, .glb) of triangles, by its path from the protocol's folder. "
         "See docs/objects.md."},
        {"up", &S::up, one_of(axes).left_out("\"z\", and \"y\" of glTF"),
         "The axis of the mesh file that points up."},
        {"scale", &S::scale, range(1e-9, 1e9), "Factor on the coordinates of the mesh file."},
        {"unit", &S::unit, one_of(units).left_out("\"mm\", and \"m\" of glTF"),
         "Unit of the mesh file's coordinates times `scale`. Surface points, maps and the camera are in "
         "millimetres, whatever it is; with \"own\", for a mesh whose unit is unknown, in the file's, and "
         "every export says so."},
        {"labels", &S::labels, left_out("the labels of the mesh file, if it has any"),
         "A text file with a whole number for each triangle of the mesh, or for each vertex: which part it "
         "belongs to. Lines `# part 1 rim` name parts. Or lines `# colour #ff8000 rim` alone: parts are "
         "painted on the mesh, or on a copy of it that a line `# colours painted.glb` names. Or an "
         "annotation "
         "(.annot) or a label (.label) of FreeSurfer. Each part is an area, as are the groups of a mesh "
         "file; "
         "beside `areas` both hold, and a triangle may belong to several. See docs/objects.md."},
        {"parts_by", &S::parts_by, left_out("\"group\", and \"material\" of glTF"),
         "What of the mesh file divides it into parts, each of which is an area: its groups (`g` and `o` of "
         "OBJ, the nodes of glTF), or its materials (`usemtl` of OBJ, the materials of glTF)."},
        {"weld_tolerance", &S::weld_tolerance, range(0, 0.01),
         "Vertices of the mesh that are no farther apart than this share of the diagonal of its box are one: "
         "what some programs write for a corner differs by rounding. 0: only those at the very same place."},
        {"picture", &S::picture, left_out("see `mesh`"),
         "Instead of a shape, a flat picture, by its path from the protocol's folder, of the size of the "
         "stimulus "
         "(`[view]`), which it fills, shown as it is, without light: PNG, JPEG or TIFF, sRGB of Rec. 709 "
         "colours, or EXR or HDR, linear, 1 being the display's white. With # for the digits of a number, "
         "the pictures of a movie, for a motion of the kind \"movie\"; without, one picture all the time. "
         "Its surface is that of the screen, in "
         "millimetres from the lower left corner, so that maps, areas and measures of gaze are as for other "
         "objects. A protocol that has nothing but pictures needs no `[[material]]`."},
        {"picture_first_number", &S::picture_first_number, range(0, 1000000),
         "Number of the first picture of a movie."},
        {"lut", &S::lut, left_out("maps are made from the mesh"),
         "Instead of a mesh, for an object whose `[[frames]]` another program rendered: the "
         "coordinate-encoded maps that it made of them, with # for the digits of the number: "
         "\"maps/frame_####.png\". See docs/coordinate_maps.md."},
        {"lut_first_number", &S::lut_first_number, range(0, 1000000), "Number of the first map's file."},
        {"lut_scale", &S::lut_scale, range(65535, 65536).left_out("from the JSON file beside each map"),
         "Code of the far side of the box: 65535 for colours from 0 to 1 saved with 16 bits, 65536 for the "
         "paper's formula."},
        {"lut_min", &S::lut_min, left_out("from the JSON file beside each map"),
         "Corner of the box that the maps are coded by, with the smallest coordinates."},
        {"lut_max", &S::lut_max, left_out("from the JSON file beside each map"),
         "Corner of the box with the largest coordinates."},
    });
}

namespace {

/// Of all kinds of material; it stays as long as the program.
std::string_view looks_of_kinds() {
    static const std::string text = [] {
        std::string all;
        for (const MaterialKindRow& row : material_kinds)
            all += fmt::format("{}`{}` {}", all.empty() ? "What it looks like: " : ", ", row.name, row.looks);
        return all + ".";
    }();
    return text;
}

} // namespace

std::vector<Key> material() {
    using M = MaterialSettings;
    return entry_keys<M>({
        {"kind", &M::kind, one_of(names_in<material_kinds>).required(), looks_of_kinds()},
        {"metal", &M::metal,
         "\"Au\" for gold, \"Ag\" for silver, or a table of another conductor: a CSV file with the columns "
         "wavelength_nm, n and k, by its path from the protocol's folder."},
        {"roughness", &M::roughness,
         range(0.001, 1).left_out(
             "0.13; of `own` as the object's file has it, and of glass and translucent bodies none"),
         "GGX alpha of a rough metal, plastic or glass, or of the surface of a translucent body; of "
         "`metallic-roughness` and `own` its square root, "
         "as "
         "other programs have it. Of `own` it stands everywhere in place of what the file says."},
        {"roughness_as", &M::roughness_as,
         "Whether the `roughness` of a plastic, glass or translucent body is the GGX alpha, or its root."},
        {"anisotropy", &M::anisotropy, range(0, 1),
         "Of a rough metal: how much rougher it is across its scratches than along them, as glTF has it: "
         "alpha along is that of `roughness`, across it that + (1 - that) times the square of this."},
        {"brushed", &M::brushed,
         "Where the scratches run: around the object's vertical, as on a lathe, or upward. Highlights are "
         "long "
         "across them."},
        {"multiple_scattering", &M::multiple_scattering, left_out("false, as frames always were"),
         "Of a rough metal: whether the light counts that leaves by several micro-mirrors, too. Without it "
         "rough metals are too dark: by 4 % at a roughness of 0.13, by 38 % at 0.6."},
        {"ior", &M::ior, range(1.01, 3),
         "Index of refraction of the clear surface of a plastic, of what is no metal, of translucent "
         "bodies, and of glass, there for the yellow light of 587.6 nm."},
        {"body", &M::body,
         "What `reflectance` is of: of the light that comes out of a plastic, as a colour measured on it is, "
         "or "
         "of the pigment inside, from which less comes out, and deeper coloured."},
        {"metallic", &M::metallic, range(0, 1).left_out("0; of `own` as the object's file has it"),
         "Share of a metal of the colour `reflectance`; the rest is plastic."},
        {"clear_coat", &M::clear_coat, range(0, 1), "Share of the surface under a clear coat, of index 1.5."},
        {"clear_coat_roughness", &M::clear_coat_roughness, range(0, 1),
         "Root of the GGX alpha of that coat."},
        {"coat_ior", &M::coat_ior, range(1, 4), "Index of refraction of the coat."},
        {"coat_absorbance", &M::coat_absorbance, range(0, 100),
         "Optical depth of the coat in red, green and blue, for one pass of its nominal thickness."},
        {"coat_thickness", &M::coat_thickness, range(0.0001, 0.1),
         "Nominal thickness of the coat, as share of half the object's height."},
        {"coat_bump", &M::coat_bump, range(0, 0.2),
         "Height of the coat's bumps, as share of half the object's height; the coat is nowhere thinner "
         "than a tenth of its nominal thickness."},
        {"coat_bump_width", &M::coat_bump_width, range(0.005, 2),
         "From one bump to the next, as share of half the object's height."},
        {"coat_seed", &M::coat_seed, range(0, 2147483647), "Another number, other bumps."},
        {"reflectance", &M::reflectance,
         range(0, 1).left_out("[0.5, 0.5, 0.5]; of `own` as the object's file has it"),
         "Share of red, green and blue light that a matt surface returns, or the body of a plastic; the "
         "colour of `metallic-roughness`. Of `own` it stands everywhere in place of the file's colours."},
        {"base", &M::base,
         "Whose colour it has: `given`, its `reflectance`; or `own`, the colour that the object's file gives "
         "each place, in place of it. See docs/objects.md."},
        {"bumps", &M::bumps, left_out("`own` of `own` and with `base = \"own\"`, else `none`"),
         "The bumps that light meets: `none`, or those of the object's file (its normal map). They change no "
         "outline, and no place that gaze is found at."},
        {"of", &M::of, left_out("all"),
         "Of `own`: the file's materials, by their names, for which the keys here hold that stand in place "
         "of "
         "what the file says; all others stay as they are."},
        {"film_nm", &M::film_nm, range(1, 8000, "nm").left_out("no film"),
         "Thickness of a clear film on a metal, whose colours come of the light that goes to and fro in it: "
         "heat tints, oxide, soap."},
        {"film_ior", &M::film_ior, range(1, 4), "Index of refraction of that film."},
        {"abbe", &M::abbe, range(10, 120).left_out("one index for all light"),
         "Abbe number of glass: how far its index differs between colours; 64.2 for N-BK7, 25 for dense "
         "flint."},
        {"absorbance", &M::absorbance, range(0, 100),
         "Optical depth of glass in red, green and blue, over half the object's height."},
        {"scattering_per_mm", &M::scattering_per_mm, range(0, 1000),
         "How often red, green and blue light is scattered inside a translucent body, in a millimetre of its "
         "way; of an object with `unit = \"own\"` in one of its units. 1 by it is the mean length of a free "
         "flight. The default is marble."},
        {"absorption_per_mm", &M::absorption_per_mm, range(0, 1000),
         "How much of red, green and blue light is absorbed there, by Beer and Lambert's law. The share of "
         "light that a scattering leaves, the albedo, is scattering / (scattering + absorption)."},
        {"scattering_anisotropy", &M::scattering_anisotropy, range(-0.95, 0.95),
         "Mean cosine of the angle that a scattering turns light by (g of Henyey and Greenstein): 0 to all "
         "sides alike, 0.8 forward as in skin and milk, below 0 backward."},
        {"density", &M::density, range(1e-6, 1e6),
         "Factor on both `scattering_per_mm` and `absorption_per_mm`: how dense the medium is, in one "
         "number, "
         "which may be a series."},
    });
}

} // namespace overt::key_rows
