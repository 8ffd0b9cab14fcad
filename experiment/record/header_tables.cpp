#include "experiment/record/header_tables.h"

namespace overt {

template <> inline constexpr std::array<const char*, 2> stored_words<ClockKind>{"steady", "virtual"};
template <> inline constexpr std::array<const char*, 2> stored_words<Eye>{"left", "right"};
template <> inline constexpr std::array<const char*, 2> stored_words<Playback>{"cycle", "ping-pong"};
template <> inline constexpr std::array<const char*, 2> stored_words<WhenLate>{"drop", "stretch"};
template <> inline constexpr std::array<const char*, 2> stored_words<MotionEase>{"none", "minimum-jerk"};

namespace {

using Header = SessionHeader;
using Display = RecordedDisplay;
using Screen = ScreenGeometry;
using Light = RecordedCharacterisation;
using Object = RecordedObject;

constexpr const char* only_row = "id INTEGER PRIMARY KEY CHECK (id = 1)";

/// What is recorded of a session as a whole: one value more is one line more, and the member that it names.
constexpr RowColumn<SessionHeader> session_columns[] = {
    column<&Header::protocol, &RecordedProtocol::name>("protocol_name", "the protocol's name"),
    column<&Header::protocol, &RecordedProtocol::title>("protocol_title", "its title"),
    column<&Header::protocol, &RecordedProtocol::text>("protocol_text", "the file, byte for byte"),
    column<&Header::protocol, &RecordedProtocol::sha256>("protocol_sha256", "SHA-256 of the text"),
    column<&Header::schedule, &Schedule::observer, &Observer::label>("observer_label", "names files"),
    column<&Header::schedule, &Schedule::observer, &Observer::number>("observer_number",
                                                                      "decides the rotation of materials"),
    column<&Header::session_number>("session_number", "which session of this observer, from 1"),
    column<&Header::schedule, &Schedule::seed>(
        "seed", "an unsigned 64-bit number in decimal text: SQLite's integers are signed"),
    column<&Header::started_utc>(
        "started_utc", "wall clock, ISO 8601; kept here, and exported only as the date of an ASC file"),
    column<&Header::clock>("clock", "`steady`, or `virtual` if time did not really pass"),
    column<&Header::program, &ProgramBuild::version>("program_version",
                                                     "version of the program that began the session"),
    column<&Header::program, &ProgramBuild::compiler>("compiler", "what it was compiled with"),
    column<&Header::program, &ProgramBuild::flags>("compiler_flags", "and how"),
    column<&Header::program, &ProgramBuild::commit>("commit_id", "of its source; empty if unknown"),
    column<&Header::graphics, &GraphicsSystem::context>("gl_context", "`window`, `egl` or `osmesa`"),
    column<&Header::graphics, &GraphicsSystem::vendor>("gl_vendor", "what OpenGL says of itself"),
    column<&Header::graphics, &GraphicsSystem::renderer>("gl_renderer", "likewise"),
    column<&Header::graphics, &GraphicsSystem::version>("gl_version", "likewise"),
    column<&Header::tracker, &TrackerDescription::name>("tracker_name", "name of the eye tracker"),
    column<&Header::tracker, &TrackerDescription::sample_rate_hz>(
        "tracker_rate_hz", "its samples to a second: granted, or measured "
                           "where the tracker's word was not taken"),
    column<&Header::tracker, &TrackerDescription::told_rate_hz>(
        "tracker_told_rate_hz", "what the tracker says of its rate, where that was measured; else 0", "0"),
    column<&Header::tracker, &TrackerDescription::eye>(
        "tracker_eye", "`left` or `right`; of both, the one that is analysed"),
    column<&Header::tracker, &TrackerDescription::both_eyes>("tracker_both_eyes", "1 if both are measured",
                                                             "0"),
    column<&Header::tracker, &TrackerDescription::model>(
        "tracker_model", "what the device says of itself; empty if nothing", "''"),
    column<&Header::further_tracker>(
        "further_tracker", "of the record of a further tracker, its id; empty in the session's own", "''"),
    column<&Header::display, &Display::screen, &Screen::screen_px, 0>("screen_width_px", "of the screen"),
    column<&Header::display, &Display::screen, &Screen::screen_px, 1>("screen_height_px", "of the screen"),
    column<&Header::display, &Display::screen, &Screen::screen_mm, 0>("screen_width_mm",
                                                                      "of the screen's picture"),
    column<&Header::display, &Display::screen, &Screen::screen_mm, 1>("screen_height_mm",
                                                                      "of the screen's picture"),
    column<&Header::display, &Display::screen, &Screen::viewing_distance_mm>("viewing_distance_mm",
                                                                             "from the eyes to the screen"),
    column<&Header::display, &Display::screen, &Screen::image_origin_px, 0>(
        "image_left_px", "where the stimulus stands on the screen"),
    column<&Header::display, &Display::screen, &Screen::image_origin_px, 1>("image_top_px", "likewise"),
    column<&Header::display, &Display::screen, &Screen::image_px, 0>("image_width_px", "of the stimulus"),
    column<&Header::display, &Display::screen, &Screen::image_px, 1>("image_height_px", "of the stimulus"),
    column<&Header::display, &Display::refresh_hz>("refresh_hz", "of the display, nominal; 0 if not known"),
    column<&Header::display, &Display::latency>("display_latency_ns",
                                                "from the vertical blank to the light of the first row"),
    column<&Header::display, &Display::output_mode>("output_mode", "by the protocol's word"),
    column<&Header::display, &Display::background>("background", "linear grey, 0 … 1 of the display's white"),
    column<&Header::display, &Display::timing>(
        "timing",
        "of the flips: `proven` by real vertical blanks, `unproven`, `none` in virtual time or "
        "without a screen; empty if not recorded",
        "''"),
    column<&Header::display, &Display::stereo>(
        "stereo",
        "how each eye had a picture of its own, `mirrors` or `frame-sequential`: the screen's columns "
        "are those of an eye's field then; empty: both had the same",
        "''"),
    column<&Header::display, &Display::interocular_mm>(
        "interocular_mm", "between the eyes that pictures are drawn for; else 0", "0"),
    column<&Header::animations, 0, &Animation::frame_count>("frame_count", "frames of the animation"),
    column<&Header::animations, 0, &Animation::frame_rate_hz>(
        "frame_rate_hz", "frames to a second, by the protocol; the display shows the nearest rate that its "
                         "own is a multiple of"),
    column<&Header::animations, 0, &Animation::amplitude>("amplitude_deg",
                                                          "turn to each side of the front view"),
    column<&Header::animations, 0, &Animation::playback>("playback", "`cycle` or `ping-pong`"),
    column<&Header::animations, 0, &Animation::duration_s>(
        "duration_s", "of one presentation, by the protocol, at that rate"),
    column<&Header::animations, 0, &Animation::when_late>(
        "when_late", "what becomes of the plan when a picture comes late: `drop` or `stretch`", "'drop'"),
};

/// What was known of the display's light.
constexpr RowColumn<RecordedCharacterisation> light_columns[] = {
    column<&Light::display>("display", "the display's name"),
    column<&Light::date>("date", "when it was measured"),
    column<&Light::instrument>("instrument", "with what"),
    column<&Light::sha256>("sha256", "SHA-256 of all its files"),
    column<&Light::black_xyz, 0>("black_x", "XYZ of the black (CIE 1931), cd/m²"),
    column<&Light::black_xyz, 1>("black_y", "likewise"),
    column<&Light::black_xyz, 2>("black_z", "likewise"),
    column<&Light::primaries_xyz, 0, 0>("red_x", "XYZ of red at full signal, without the black, cd/m²"),
    column<&Light::primaries_xyz, 0, 1>("red_y", "likewise"),
    column<&Light::primaries_xyz, 0, 2>("red_z", "likewise"),
    column<&Light::primaries_xyz, 1, 0>("green_x", "likewise of green"),
    column<&Light::primaries_xyz, 1, 1>("green_y", "likewise"),
    column<&Light::primaries_xyz, 1, 2>("green_z", "likewise"),
    column<&Light::primaries_xyz, 2, 0>("blue_x", "likewise of blue"),
    column<&Light::primaries_xyz, 2, 1>("blue_y", "likewise"),
    column<&Light::primaries_xyz, 2, 2>("blue_z", "likewise"),
};

/// A motion.
constexpr RowColumn<Animation> animation_columns[] = {
    column<&Animation::kind>("kind", "by the protocol's word"),
    column<&Animation::frame_count>("frame_count", "its frames"),
    column<&Animation::frame_rate_hz>("frame_rate_hz", "frames to a second, by the protocol"),
    column<&Animation::amplitude>(
        "amplitude_deg", "turn of the object to each side of `angle_deg`, where it turns to and fro"),
    column<&Animation::angle>("angle_deg", "from the front view"),
    column<&Animation::light_amplitude>("light_amplitude_deg", "turn of the light to each side"),
    column<&Animation::playback>("playback", "`cycle` or `ping-pong`"),
    column<&Animation::duration_s>("duration_s", "of one presentation, by the protocol"),
    column<&Animation::when_late>("when_late", "`drop` or `stretch`"),
    column<&Animation::by_observer, &ObserverTurn::step>(
        "step_deg", "of `observer`: from one pose to the next, in the order of its frames", "2"),
    column<&Animation::by_observer, &ObserverTurn::from>("from_deg", "likewise, the angle of the first", "0"),
    column<&Animation::by_observer, &ObserverTurn::to>(
        "to_deg", "likewise, how far it can be turned; 360 after the first: all round", "360"),
    column<&Animation::by_observer, &ObserverTurn::elevation_step>(
        "elevation_step_deg", "likewise, from one elevation to the next; 0: it has none", "0"),
    column<&Animation::by_observer, &ObserverTurn::elevation_from>("elevation_from_deg",
                                                                   "likewise, the lowest", "0"),
    column<&Animation::by_observer, &ObserverTurn::elevation_to>("elevation_to_deg", "likewise, the highest",
                                                                 "0"),
    column<&Animation::turns>("turns", "of `turntable` and `orbit`: while the frames go by once", "1"),
    column<&Animation::rest_share>("rest_share", "of `trapezoid`: of its time, at both ends together",
                                   "0.25"),
    column<&Animation::ease>("ease", "of `triangle` and `trapezoid`: `none` or `minimum-jerk`", "'none'"),
    column<&Animation::approach>("approach", "of `approach`: how far, in the unit of the mesh", "0"),
    column<&Animation::light_turns>("light_turns", "full turns of the light while the frames go by once",
                                    "0"),
};

/// An object, its camera in the first view, and the box by which its maps are coded.
constexpr RowColumn<RecordedObject> object_columns[] = {
    column<&Object::id>("id", "its id in the protocol"),
    column<&Object::title>("title", "its title"),
    column<&Object::mesh_sha256>("mesh_sha256", "SHA-256 of the mesh"),
    column<&Object::mesh_file>("mesh_file", "relative to the directory; empty if it has no mesh"),
    column<&Object::cameras, 0, &Camera::position, 0>(
        "camera_x", "where the camera stands; up is +z; without a mesh what ready-made maps say of it"),
    column<&Object::cameras, 0, &Camera::position, 1>("camera_y", "likewise"),
    column<&Object::cameras, 0, &Camera::position, 2>("camera_z", "likewise"),
    column<&Object::cameras, 0, &Camera::target, 0>("target_x", "where it looks"),
    column<&Object::cameras, 0, &Camera::target, 1>("target_y", "likewise"),
    column<&Object::cameras, 0, &Camera::target, 2>("target_z", "likewise"),
    column<&Object::cameras, 0, &Camera::vertical_fov>(
        "vertical_fov_deg", "full angle over the image's height; 0 if ready-made maps say nothing of it"),
    column<&Object::axis_point, 0>("axis_x", "a point of the vertical axis of the turn"),
    column<&Object::axis_point, 1>("axis_y", "likewise"),
    column<&Object::axis_point, 2>("axis_z", "likewise"),
    column<&Object::bounds, &Bounds::min, 0>("min_x", "the box by which maps are coded"),
    column<&Object::bounds, &Bounds::min, 1>("min_y", "likewise"),
    column<&Object::bounds, &Bounds::min, 2>("min_z", "likewise"),
    column<&Object::bounds, &Bounds::max, 0>("max_x", "its other corner"),
    column<&Object::bounds, &Bounds::max, 1>("max_y", "likewise"),
    column<&Object::bounds, &Bounds::max, 2>("max_z", "likewise"),
    column<&Object::unit>("unit",
                          "of all lengths of the object: `mm`; `own` if that of its mesh is "
                          "unknown; empty if not recorded",
                          "''"),
    column<&Object::origin, 0>(
        "origin_x",
        "of the object's coordinates in those of its mesh's file, turned and scaled as the "
        "protocol says: what has to be added to a place; 0 unless the mesh lies far from its "
        "file's origin",
        "0"),
    column<&Object::origin, 1>("origin_y", "likewise", "0"),
    column<&Object::origin, 2>("origin_z", "likewise", "0"),
    column<&Object::surface_sha256>("surface_sha256",
                                    "SHA-256 of how its surface looks by its file: colours, pictures, metal, "
                                    "roughness and bumps; empty where no material asks for it",
                                    "''"),
    column<&Object::surface_files>(
        "surface_files", "what says it: the mesh's file, then its pictures, with `; ` between them", "''"),
};

} // namespace

RowTable<SessionHeader> session_table() { return {"session", only_row, session_columns}; }
RowTable<RecordedCharacterisation> characterisation_table() {
    return {"characterisation", only_row, light_columns};
}
RowTable<Animation> animation_table() {
    return {"animation", "motion INTEGER PRIMARY KEY", animation_columns};
}
RowTable<RecordedObject> object_table() { return {"object", "object INTEGER PRIMARY KEY", object_columns}; }

} // namespace overt
