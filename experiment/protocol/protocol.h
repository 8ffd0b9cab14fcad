/// An experiment as its file states it: plain values, with the defaults that a key left out has. Which keys
/// there are, with their units, ranges and explanations, is in protocol_keys.cpp; how a file becomes this is
/// in experiment/checks/checked_protocol.h.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include <glm/glm.hpp>

#include "experiment/animation.h"
#include "experiment/base/enum_names.h"
#include "experiment/calibration/calibration_settings.h"
#include "experiment/colour/display_characterisation.h"
#include "experiment/events/event_settings.h"
#include "experiment/factors.h"
#include "experiment/gaze.h"
#include "experiment/keys/key_places.h"
#include "experiment/list_entry.h"
#include "experiment/ports/observer_field.h"
#include "experiment/ports/tracker_kinds.h"
#include "experiment/protocol/area_settings.h"
#include "experiment/protocol/design_settings.h"
#include "experiment/protocol/device_settings.h"
#include "experiment/protocol/material_kind.h"
#include "experiment/protocol/output_mode.h"
#include "experiment/protocol/point_settings.h"
#include "experiment/protocol/procedure_settings.h"
#include "experiment/protocol/protocol_sources.h"
#include "experiment/protocol/recorded_course.h"
#include "experiment/protocol/sitting_settings.h"
#include "experiment/protocol/slot.h"
#include "experiment/protocol/stereo.h"
#include "experiment/protocol/trial_table.h"
#include "experiment/screen_geometry.h"
#include "experiment/stimulus_lists.h"
#include "experiment/units.h"

namespace overt {

/// How the native modes spread what lies between two of their levels over neighbours and refreshes.
enum class Dithering : std::uint8_t { none, ordered, blue_noise };
template <>
inline constexpr auto names_of<Dithering> = enum_names<Dithering>("none", "ordered", "blue-noise");

/// How two neighbours become the one colour of a pair, in linear light.
enum class PairFilter : std::uint8_t { box, lanczos };
template <> inline constexpr auto names_of<PairFilter> = enum_names<PairFilter>("box", "lanczos");

/// Where a square for a photodiode stands.
enum class PatchCorner : std::uint8_t { none, top_left, top_right, bottom_left, bottom_right };
template <>
inline constexpr auto names_of<PatchCorner> = enum_names<PatchCorner>("none", "top-left", "top-right",
                                                                      "bottom-left", "bottom-right");

/// What a session on a screen in real time says of the times of its flips.
enum class TimingClaim : std::uint8_t {
    proven,  ///< it is refused where no real vertical blank tells them
    unproven ///< it runs, and its record says that nothing proves them
};
template <> inline constexpr auto names_of<TimingClaim> = enum_names<TimingClaim>("proven", "unproven");

/// The table on the disk of a Display++ or Bits# that leaves values as they are (Display++ user manual).
inline constexpr std::string_view linear_box_table = "13bitLinearLUT.txt";

/// What makes the display's light proportional to the signal, if anything does.
enum class LinearisedBy : std::uint8_t {
    unsaid,  ///< no session runs so on a real screen, unless its light was measured
    display, ///< the panel itself
    box,     ///< the display box, by the table `box_gamma_table`
    none     ///< nothing: overt corrects for `gamma`
};
template <>
inline constexpr auto names_of<LinearisedBy> = enum_names<LinearisedBy>("unsaid", "display", "box", "none");

/// [display]: the screen in front of the observer. Defaults: a Display++ as in the paper; its 698 mm are the
/// active width.
struct DisplaySettings {
    int width_px = 1920;
    int height_px = 1080;
    double refresh_hz = 120.0;
    double width_mm = 698.4;
    double height_mm = 392.9;
    double viewing_distance_mm = 1750.0;
    OutputMode output = OutputMode::color_plus_plus;
    Dithering dither = Dithering::none;       ///< of the native modes
    PairFilter pair_filter = PairFilter::box; ///< of the modes that join pixels in pairs
    /// Which of several monitors: the name of its output ("DP-1") or of its EDID, or its number from 1.
    /// Empty: the only one of this size and rate.
    std::string monitor;
    /// The box that reads mono++, color++ and bits++: "auto", "none", or its serial port.
    std::string box = "auto";
    /// So old may the proof be that the box receives the bytes that are drawn; 0: none is asked for.
    int video_check_days = 30;
    int onset_trigger = 0; ///< digital outputs that a presentation's first refresh raises, a bit each
    /// Exponent between signal and light; 1 for a display that linearises itself. Without a
    /// characterisation.
    double gamma = 1.0;
    LinearisedBy linearised_by = LinearisedBy::unsaid;
    std::string box_gamma_table{linear_box_table}; ///< a file on the box's disk
    std::filesystem::path characterisation_file;   ///< or empty; resolved against the protocol's folder
    std::optional<DisplayCharacterisation> characterisation; ///< what stands in it
    double latency_ms = 0.0;                                 ///< from vertical blank to the first row's light
    double background = 0.0;                                 ///< linear grey, 0 … 1 of the display's white
    double frame_store_mb = 1000.0; ///< what the frames of two stimuli may take on the graphics card
    TimingClaim timing = TimingClaim::proven;
    PatchCorner photodiode = PatchCorner::none; ///< a square that alternates with the animation frames
    int photodiode_px = 60;                     ///< side of it
    int tags_px = 0;                        ///< side of the AprilTags around the stimulus; 0: there are none
    double tags_light = 0.5;                ///< of their white modules, 0 … 1 of the display's white
    std::optional<double> background_cd_m2; ///< or its luminance, from which `background` is made
};

/// Which point of gaze is taken of a tracker that tells several.
enum class TrackedPoint : std::uint8_t {
    eyes, ///< each eye's own
    best  ///< the tracker's mean of both eyes, or that of the one that it finds
};
template <> inline constexpr auto names_of<TrackedPoint> = enum_names<TrackedPoint>("eyes", "best");

/// The unit in which a stream tells gaze.
enum class StreamUnit : std::uint8_t { as_told, px, normalized, percent };
template <>
inline constexpr auto names_of<StreamUnit> = enum_names<StreamUnit>("as-told", "px", "normalized", "percent");

/// What becomes of a trial whose drift check failed.
enum class DriftPolicy : std::uint8_t {
    note,        ///< it is presented, and the record says so
    retry,       ///< the target is shown again
    recalibrate, ///< the tracker is calibrated, and the trial begun anew
    reject       ///< it is not presented, and comes again as one that the operator rejected
};
template <>
inline constexpr auto names_of<DriftPolicy> = enum_names<DriftPolicy>("note", "retry", "recalibrate",
                                                                      "reject");

/// [tracker]
struct TrackerSettings {
    TrackerKind kind{}; ///< the first: simulated
    double rate_hz = 2000.0;
    std::string address; ///< of its host or stream; empty: what is usual for the kind
    bool outlet = false; ///< its samples are sent on by the Lab Streaming Layer
    TrackedPoint point = TrackedPoint::eyes;
    std::string surface = "screen"; ///< that a scene camera finds gaze on
    double least_confidence = 0.6;  ///< of a tracker that tells confidence: below, gaze is lost
    // Of a stream.
    std::vector<std::string> channels; ///< what they mean; empty: as the stream tells
    StreamUnit unit = StreamUnit::as_told;
    bool y_is_up = false;
    std::vector<double> missing; ///< numbers that stand for a value that there is not
    std::string eye = "right";   ///< "left", "right" or "both"
    bool measures_both_eyes() const { return eye == "both"; }
    /// The one that the analysis takes: of both, the right one.
    Eye analysed_eye() const { return eye == "left" ? Eye::left : Eye::right; }
    double drift_limit_deg = 2.0; ///< a drift check beyond this has failed
    DriftPolicy on_drift = DriftPolicy::note;
    int drift_checks = 3; ///< of a trial, with retry or recalibrate; after the last it is presented
    // How the simulated tracker differs from a perfect one.
    double simulated_noise_deg = 0.05;       ///< standard deviation of each sample
    double simulated_accuracy_deg = 0.3;     ///< standard deviation of a trial's constant offset
    double simulated_clock_drift_ppm = 40.0; ///< rate of its clock against the session's
};

/// [[further_tracker]]: one that records at the same time. Drift checks are the session's own tracker's.
struct FurtherTrackerSettings : TrackerSettings {
    std::string id;
};

/// Who calibrates the eye tracker.
enum class CalibratedBy : std::uint8_t {
    automatic, ///< the tracker where it can, else the program
    tracker,
    overt
};
template <>
inline constexpr auto names_of<CalibratedBy> = enum_names<CalibratedBy>("auto", "tracker", "overt");

/// [calibration]
struct CalibrationKeys : CalibrationSettings {
    CalibratedBy by = CalibratedBy::automatic;
    // A validation beyond these is shown to the operator, who decides.
    double mean_limit_deg = 1.0, max_limit_deg = 2.0;
    bool beeps = true; ///< sounds while it goes on, where there is a sound device
};

/// Who says when the eye rested, jumped and was closed.
enum class EventMethod : std::uint8_t {
    tracker, ///< the eye tracker, where it says so; else the program
    overt,   ///< the program
    none
};
template <> inline constexpr auto names_of<EventMethod> = enum_names<EventMethod>("tracker", "overt", "none");

/// [events]: with the thresholds by which the program tells them apart.
struct EventDetectionSettings : EventSettings {
    EventMethod method = EventMethod::tracker;
};

/// [[view]]: image and camera. [view] is the only one.
struct ViewSettings : ListEntry {
    int width_px = 1024;
    int height_px = 1024;
    // Place on the screen: its top left pixel, or its middle's angle from the middle of the screen; left out:
    // in the middle.
    std::optional<int> left_px, top_px;
    std::optional<double> centre_right_deg, centre_up_deg;
    /// Full angle over the height. Left out: the angle under which the observer sees the image on the screen.
    std::optional<double> vertical_fov_deg;
    double margin = 0.06;                      ///< share of the image left free where the camera is fitted
    std::optional<glm::dvec3> camera_position; ///< left out: fitted for each object
    std::optional<glm::dvec3> camera_target;   ///< left out: the centre of the bounding box
    bool two_eyes = true;  ///< with [stereo], each eye sees it from its own place; else both from the middle
    double aside_mm = 0.0; ///< of a view for one eye: how far it is to the right of the middle of both
};

/// What gives the light of a lamp.
enum class LampShape : std::uint8_t { rectangle, disc, sphere };
template <> inline constexpr auto names_of<LampShape> = enum_names<LampShape>("rectangle", "disc", "sphere");

/// [[lamp]]: something near that shines evenly. Lengths are in the unit of the mesh, places from the centre
/// of the object's box, by the axes of the front view: x to the right, y away, z up.
struct LampSettings {
    std::string id;
    LampShape shape = LampShape::disc;
    std::optional<double> cd_m2; ///< luminance of it
    std::array<double, 3> colour{1.0, 1.0, 1.0};
    std::optional<glm::dvec3> position;
    /// The place that a flat one is turned to; it shines to that side alone. Left out: the centre.
    std::optional<glm::dvec3> faces;
    double width = 0.0, height = 0.0; ///< of a rectangle
    double radius = 0.0;              ///< of a disc or sphere
};

/// [[light]]: what surrounds the object. [light] is the only one.
struct LightSettings : ListEntry {
    /// "overcast", "gallery" or "dark", or a latitude-longitude EXR or HDR file, linear Rec.709, +y up,
    /// resolved against the protocol's folder.
    std::string probe = "overcast";
    /// Whether the probe is a file, and not one that the program makes.
    bool is_file() const { return probe != "overcast" && probe != "gallery" && probe != "dark"; }
    double exposure = 1.0;     ///< factor from the probe's radiance to the display's white
    double rotation_deg = 0.0; ///< turns the probe, the sun and the lamps about the vertical
    /// Luminance of the probe's 1, by which lux and cd/m2 of sun and lamps are held against it. Left out: of
    /// "dark" 1 cd/m2, else nothing is known.
    std::optional<double> unit_cd_m2;
    /// Illuminance by the sun on what faces it; left out: there is none but what the probe has.
    std::optional<double> sun_lux;
    double sun_azimuth_deg = 0.0; ///< from behind the observer to the observer's right
    double sun_elevation_deg = 45.0;
    double sun_radius_deg = 0.2666; ///< half the angle that it fills
    std::array<double, 3> sun_colour{1.0, 1.0, 1.0};
    std::vector<std::string> lamps;    ///< ids of [[lamp]]
    std::vector<LampSettings> shining; ///< those lamps, in that order
    /// Instead of all above but the exposure: the light of others together, by their ids, each times a
    /// number.
    std::vector<std::pair<std::string, double>> sum;
    std::vector<LightSettings> parts; ///< those others, in that order

    /// Whether there is light from the sun or from lamps, besides the probe's.
    bool has_sources() const { return sun_lux || !lamps.empty(); }
};

/// [[background]]: what the image of the stimulus shows where the object does not. [background] is the only
/// one. One of the three; none: the display's background.
struct BackgroundSettings : ListEntry {
    std::optional<double> grey;       ///< linear, 0 … 1 of the display's white
    std::optional<glm::dvec3> colour; ///< the display's own red, green and blue, linear, 0 … 1
    /// A picture, linear (EXR, HDR) or sRGB, of Rec. 709 colours of which white is the display's, resolved
    /// against the protocol's folder; as large as it must be to cover the image, about its middle.
    std::string picture;
};

/// [[motion]]: how an object turns. [animation] is the only one.
struct MotionSettings : ListEntry, Animation {
    std::vector<RecordedCourse> courses; ///< of `recorded`, in the order of its tables
};

/// [screens]: what is shown between the animations.
struct ScreenSettings {
    double task_min_s = 1.0;     ///< before a key goes on
    double drift_target_s = 1.0; ///< how long the drift target is shown
    double recording_lead_s =
        0.1; ///< recording before the first and after the last refresh of a presentation
    double response_min_s = 1.0;
    double response_max_s = 60.0; ///< goes on without an answer
    double text_height_deg = 0.8;
    double text_grey = 0.6;           ///< linear, 0 … 1 of the display's white
    std::optional<double> text_cd_m2; ///< or its luminance, from which `text_grey` is made
    std::string response_text = "Please answer now.";
    bool repeat_question = false; ///< above the response text
    std::string welcome_text = "# Welcome";
    std::string farewell_text = "# Thank you\nThis is the end.";
};

/// What of a mesh file divides it into parts: its groups (`g` and `o` of OBJ, the nodes of glTF), or what its
/// triangles are made of (`usemtl`, the materials of glTF).
enum class PartsBy : std::uint8_t { group, material };
template <> inline constexpr auto names_of<PartsBy> = enum_names<PartsBy>("group", "material");

/// [[object]]
struct ObjectSettings : ListEntry {
    std::string shipped;        ///< name of an object that overt makes itself, or empty
    std::filesystem::path mesh; ///< PLY, OBJ, STL or glTF, or empty; resolved against the protocol's folder
    /// Axis of the file that points up: x, y, z, -x, -y, -z; empty: that of its format.
    std::string up;
    double scale = 1.0;
    /// Of the file: mm, cm, m, in, which all become millimetres; or own; empty: that of its format.
    std::string unit;
    std::optional<PartsBy> parts_by; ///< left out: as is usual for the file's format
    double weld_tolerance = 1e-6;    ///< of vertices, as a share of the diagonal of the mesh's box
    std::filesystem::path
        labels; ///< a label for each triangle or vertex of the mesh, or empty; resolved likewise
    /// Coordinate-encoded maps made by another program, or empty: path with # for the digits of the frame
    /// number, resolved against the protocol's folder.
    std::string lut;
    int lut_first_number = 0;                   ///< number of animation frame 0
    std::optional<int> lut_scale;               ///< of 16-bit codes; left out: a file beside each map says it
    std::optional<glm::dvec3> lut_min, lut_max; ///< the box that they are coded by, likewise
    std::vector<AreaSettings> areas;            ///< beside those that the mesh file and `labels` name
    /// A flat picture in place of a shape, or the pictures of a movie with # for the digits of their number;
    /// or empty; resolved likewise.
    std::filesystem::path picture;
    int picture_first_number = 0; ///< number of animation frame 0
    /// Of such a picture on the screen, where it is shown pixel for pixel; known when the protocol is
    /// complete.
    glm::dvec2 picture_mm{0.0};

    bool is_flat() const { return !picture.empty(); }
};

/// What the reflectance of a plastic is of: `light`, of the light that leaves its body, as a colour measured
/// on it is; `pigment`, of the body itself, which throws much of it back inside at its own surface.
enum class PlasticBody : std::uint8_t { light, pigment };
template <> inline constexpr auto names_of<PlasticBody> = enum_names<PlasticBody>("light", "pigment");

/// What `roughness` is: the GGX alpha itself, or its square root, as programs that call it perceived have it.
enum class RoughnessAs : std::uint8_t { alpha, root };
template <> inline constexpr auto names_of<RoughnessAs> = enum_names<RoughnessAs>("alpha", "root");

/// Whose colour a material has: the one it is given, or that which the object's file gives each place.
enum class MaterialBase : std::uint8_t { given, own };
template <> inline constexpr auto names_of<MaterialBase> = enum_names<MaterialBase>("given", "own");

/// The bumps that a material has: none, or those of the object's file (its normal map).
enum class MaterialBumps : std::uint8_t { none, own };
template <> inline constexpr auto names_of<MaterialBumps> = enum_names<MaterialBumps>("none", "own");

/// Where the scratches of a brushed metal run: round the object's vertical, as turned on a lathe, or up and
/// down.
enum class BrushedAlong : std::uint8_t { around, upward };
template <> inline constexpr auto names_of<BrushedAlong> = enum_names<BrushedAlong>("around", "upward");

/// [[material]]
struct MaterialSettings : ListEntry {
    MaterialKind kind = MaterialKind::smooth_conductor;
    std::string metal =
        "Au"; ///< "Au", "Ag", or a file (metal_table.h), resolved against the protocol's folder
    /// See alpha(). Left out: of `own` the file's, of glass and translucent none, of all else 0.13.
    std::optional<double> roughness;
    double coat_ior = 1.4;
    std::array<double, 3> coat_absorbance{0.0, 0.10,
                                          0.75}; ///< red, green, blue, for one pass of the nominal thickness
    // The coat's shape, as shares of half the object's height.
    double coat_thickness = 0.01;  ///< in the mean
    double coat_bump = 0.015;      ///< height of its bumps
    double coat_bump_width = 0.05; ///< from one bump to the next
    int coat_seed = 0;             ///< of the bumps
    /// Of diffuse, plastic, metallic_roughness; left out: 0.5, and of `own` the file's.
    std::optional<glm::dvec3> reflectance;
    RoughnessAs roughness_as = RoughnessAs::alpha; ///< of plastic; of metallic_roughness it is the root
    bool multiple_scattering = false;      ///< of rough_conductor: light of several micro-mirrors, too
    double ior = 1.5;                      ///< of plastic, metallic_roughness, glass and translucent
    PlasticBody body = PlasticBody::light; ///< of plastic
    // Of metallic_roughness.
    std::optional<double> metallic;          ///< share of metal; left out: none, and of `own` the file's
    double clear_coat = 0.0;                 ///< share that a clear coat covers
    double clear_coat_roughness = 0.0;       ///< root of its alpha
    MaterialBase base = MaterialBase::given; ///< of diffuse, plastic, metallic_roughness
    // Of what is of the object's file.
    std::optional<MaterialBumps> bumps; ///< left out: those of the file's, of what else is of the file
    std::vector<std::string> of; ///< the file's materials that the given properties hold for; empty: all
    // Of glass.
    std::optional<double> abbe;                      ///< its Abbe number; left out: no dispersion
    std::array<double, 3> absorbance{0.0, 0.0, 0.0}; ///< red, green, blue, over half the object's height
    // Of translucent: red, green, blue, by the millimetre; those of marble (Jensen et al. 2001).
    std::array<double, 3> scattering_per_mm{2.19, 2.62, 3.0};
    std::array<double, 3> absorption_per_mm{0.0021, 0.0041, 0.0071};
    double scattering_anisotropy = 0.0; ///< mean cosine of the angle that a scattering turns light by
    double density = 1.0;               ///< factor on both coefficients
    // Of rough_conductor.
    double anisotropy = 0.0; ///< 0: alike in all directions
    BrushedAlong brushed = BrushedAlong::around;
    // A thin film on metals and glass.
    std::optional<double> film_nm; ///< its thickness; left out: none
    double film_ior = 1.33;

    glm::dvec3 given_reflectance() const { return reflectance.value_or(glm::dvec3(0.5)); }
    double given_metallic() const { return metallic.value_or(0.0); }
    double given_roughness() const { return roughness.value_or(0.13); }
    /// Whether its colour, or more, is what the object's file gives each place.
    bool is_own() const { return kind == MaterialKind::own || base == MaterialBase::own; }
    bool has_own_bumps() const {
        return bumps.value_or(is_own() ? MaterialBumps::own : MaterialBumps::none) == MaterialBumps::own;
    }
    /// Whether anything of it is what the object's file says of the surface.
    bool is_of_file() const { return is_own() || has_own_bumps(); }

    /// GGX alpha of what the kind has of rough surface, below a clear coat.
    double alpha() const {
        const bool is_root = kind == MaterialKind::metallic_roughness || kind == MaterialKind::own ||
                             roughness_as == RoughnessAs::root;
        const double given = given_roughness();
        return is_root && kind != MaterialKind::rough_conductor ? given * given : given;
    }
};

/// How carefully frames are rendered, in rising order. `live`: drawn by OpenGL, an approximation; the others
/// are path traced.
enum class BakeQuality : std::uint8_t { live, preview, draft, standard, reference };
template <>
inline constexpr auto names_of<BakeQuality> = enum_names<BakeQuality>("live", "preview", "draft", "standard",
                                                                      "reference");

/// How the samples about a pixel's middle are weighed.
enum class PixelFilter : std::uint8_t { box, gaussian, blackman_harris };
template <>
inline constexpr auto names_of<PixelFilter> = enum_names<PixelFilter>("box", "gaussian", "blackman-harris");

/// Whose colour matching functions make three numbers of a spectrum, 2 degrees.
enum class StandardObserver : std::uint8_t { cie1931, cie2006 };
template <>
inline constexpr auto names_of<StandardObserver> = enum_names<StandardObserver>("cie1931", "cie2006");

/// [bake]: how stimuli are rendered that are not given as [[frames]].
struct BakingSettings {
    std::optional<BakeQuality> quality;    ///< that a session needs at least; nothing: see least()
    std::optional<int> samples;            ///< a pixel, instead of what is usual for the quality
    std::optional<double> target_error_de; ///< a pixel is left when its standard error is below this
    PixelFilter filter = PixelFilter::box;
    double filter_width_px = 1.0;
    std::optional<std::uint64_t> seed; ///< of the samples; left out: 0
    StandardObserver observer = StandardObserver::cie1931;

    /// What a session needs at least. A person would look at the noise and the coarse edges of previews,
    /// which have half the resolution; a simulated observer has the hidden maps to look at.
    BakeQuality least(bool for_people = true) const {
        return quality.value_or(for_people ? BakeQuality::standard : BakeQuality::preview);
    }
};

/// Encoding of ready-made frames.
enum class FrameEncoding : std::uint8_t { linear, srgb };
template <> inline constexpr auto names_of<FrameEncoding> = enum_names<FrameEncoding>("linear", "srgb");

/// What the three numbers of a ready-made frame's pixel are: the display's own light, linear Rec. 709 of
/// which white is the display's, or CIE 1931 XYZ of which Y = 1 is as bright as the display's white.
enum class FrameColours : std::uint8_t { display, rec709, xyz };
template <>
inline constexpr auto names_of<FrameColours> = enum_names<FrameColours>("display", "rec709", "xyz");

/// [[frames]]: a ready-made animation for one stimulus, instead of rendering it.
struct FrameSequenceSettings {
    std::string object;
    std::string material;
    std::string light, motion, view; ///< empty: the only one that there is
    std::string
        files; ///< path with # for the digits of the frame number; resolved against the protocol's folder
    int first_number = 0; ///< number of animation frame 0
    FrameEncoding encoding = FrameEncoding::linear;
    FrameColours colour_space = FrameColours::display;
    double exposure = 1.0; ///< factor on their light; that of [light] is not for them
    /// Of files without alpha: the colour, as it stands in them, that is not the object.
    std::optional<glm::dvec3> background_colour;
    double background_tolerance = 0.004; ///< largest difference from it, in each channel
    /// The object whose `picture` it is, as an index; -1: the protocol has it as [[frames]].
    int picture_of = -1;
};

struct Protocol {
    std::string name;
    std::string title;
    DisplaySettings display;
    StereoSettings stereo;
    TrackerSettings tracker;
    std::vector<FurtherTrackerSettings> further_trackers;
    CalibrationKeys calibration;
    EventDetectionSettings events;
    BakingSettings bake;
    ScheduleSettings schedule;
    ScreenSettings screens;
    ConsentSettings consent;
    InstructionSettings instructions;
    OperatorSettings operators;
    std::vector<ButtonBoxSettings> button_boxes;
    std::vector<MarkerOutputSettings> marker_outputs;
    AnswerSettings answers;
    WordSettings words;
    DatasetSettings dataset;
    std::vector<ObserverFieldSettings> observer_fields; ///< what the observer is asked before the session
    std::vector<Task> tasks;
    std::vector<ProcedureSettings> procedures; ///< that tasks name in their trials
    std::vector<BlockSettings> blocks;         ///< none: all trials are one block in random order
    std::vector<GroupSettings> groups;         ///< none: all observers see the same
    std::vector<PracticeSettings> practice;
    SimulatedObserverSettings simulated_observers;
    std::vector<SimulatedEffect> simulated_effects;
    BreakSettings breaks;
    RepeatSettings repeat;
    // A stimulus is an entry of each. There is always a light, a motion, a view and a background.
    std::vector<ObjectSettings> objects;
    std::vector<MaterialSettings> materials;
    std::vector<LightSettings> lights = std::vector<LightSettings>(1);
    std::vector<MotionSettings> motions = std::vector<MotionSettings>(1);
    std::vector<ViewSettings> views = std::vector<ViewSettings>(1);
    std::vector<BackgroundSettings> backgrounds = std::vector<BackgroundSettings>(1);
    /// For each further size that slots have (Slot::size), in their order: all views, of that size. What is
    /// drawn for such a slot counts its views on from those of the list. With [stereo] all these are the left
    /// eye's, and behind them come the right eye's, in the same order.
    std::vector<ViewSettings> views_in_slots;
    std::vector<LampSettings> lamps; ///< that lights name
    std::vector<FrameSequenceSettings> frames;
    std::vector<PointListSettings> point_lists; ///< of places on the surfaces
    std::vector<TrialTable> trial_tables;       ///< of the tasks that name one
    std::vector<SlotSettings> slot_entries;     ///< as they are written
    std::vector<Slot> slots = written_out({});  ///< the places that they are; never empty

    const ObjectSettings& object_of(const Stimulus& of) const {
        return objects.at(static_cast<std::size_t>(of.object));
    }
    const MaterialSettings& material_of(const Stimulus& of) const {
        return materials.at(static_cast<std::size_t>(of.material));
    }
    const LightSettings& light_of(const Stimulus& of) const {
        return lights.at(static_cast<std::size_t>(of.light));
    }
    const MotionSettings& motion_of(const Stimulus& of) const {
        return motions.at(static_cast<std::size_t>(of.motion));
    }
    const ViewSettings& view_of(const Stimulus& of) const { return view_at(of.view); }
    const BackgroundSettings& background_of(const Stimulus& of) const {
        return backgrounds.at(static_cast<std::size_t>(of.background));
    }

    /// A view at each size that slots have: those of the list first, at the size of the first slot.
    const ViewSettings& view_at(int view) const {
        const auto at = static_cast<std::size_t>(view);
        return at < views.size() ? views[at] : views_in_slots.at(at - views.size());
    }
    std::size_t views_at_all_sizes() const { return views.size() + views_in_slots.size(); }

    /// The stimulus as its slot shows it to an eye: what frames, maps and cameras are found by. Slots of one
    /// size have the same, and so have both eyes without [stereo].
    Stimulus in_slot(const PlacedStimulus& placed, Eye eye) const {
        Stimulus shown = placed.stimulus;
        shown.view += slots.at(static_cast<std::size_t>(placed.slot)).size * static_cast<int>(views.size());
        if (stereo.is_on() && eye == Eye::right)
            shown.view += static_cast<int>(views_at_all_sizes() / 2);
        return shown;
    }
    /// To the eye whose gaze is analysed.
    Stimulus in_slot(const PlacedStimulus& placed) const { return in_slot(placed, tracker.analysed_eye()); }

    std::filesystem::path file;         ///< where it was read
    std::string text;                   ///< the file, byte for byte
    std::vector<IncludedText> included; ///< the files that it includes
    KeyPlaces places;                   ///< where each key stands in it, for findings that come later
};

/// Where the entries of each of `stimulus_lists` are, in their order.
inline constexpr std::tuple entries_of_lists{&Protocol::objects, &Protocol::materials,
                                             &Protocol::lights,  &Protocol::motions,
                                             &Protocol::views,   &Protocol::backgrounds};
static_assert(std::tuple_size_v<decltype(entries_of_lists)> == stimulus_lists.size());

/// The entries of a list as what all lists' entries have in common; for as long as the protocol's lists stay
/// as they are. `list`: index into `stimulus_lists`.
std::vector<const ListEntry*> entries_of(const Protocol& protocol, std::size_t list);
std::vector<ListEntry*> entries_of(Protocol& protocol, std::size_t list);

/// Their ids.
std::vector<std::string_view> ids_in_list(const Protocol& protocol, std::size_t list);

/// All factors of a protocol's trials.
Factors factors_of(const Protocol& protocol);

/// The levels that its trials have of their own, by its tables and rules (own_factors.cpp).
std::vector<NamedWord> own_levels_of(const Protocol& protocol);

/// For each list: whether a simulated effect holds for each of its entries.
std::array<std::vector<bool>, stimulus_lists.size()> chosen_by(const Protocol& protocol,
                                                               const SimulatedEffect& effect);

/// The screen, or with [stereo] the field of it that each eye has, and the stimulus's place there, as the
/// protocol has them.
ScreenGeometry screen_geometry_of(const Protocol& protocol);

/// The protocol as the further tracker of this index has it: that is its [tracker], and there is no other.
Protocol protocol_of_further(const Protocol& protocol, std::size_t index);

/// File of one frame of a ready-made animation: the #s of `files` replaced by the number, zeros in front; the
/// same for all, if there are none.
std::filesystem::path frame_file(const FrameSequenceSettings& sequence, AnimationFrameIndex frame);

/// The key that says where a ready-made animation is, as findings name it: of [[frames]], or of a picture.
std::string place_of_frames(const Protocol& protocol, std::size_t index);

/// The same for the map of one frame, of an object with ready-made maps.
std::filesystem::path lut_file(const ObjectSettings& object, AnimationFrameIndex frame);

/// The ready-made frames of a stimulus, or nullptr if they are to be rendered.
const FrameSequenceSettings* find_frames(const Protocol& protocol, const Stimulus& stimulus);

} // namespace overt
