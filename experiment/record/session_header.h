/// Everything about a session that stands fixed before its first trial, with what its exports and its
/// analysis need to know of the protocol: the protocol file is not needed again.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include <glm/glm.hpp>

#include "experiment/animation.h"
#include "experiment/base/content_hash.h"
#include "experiment/factors.h"
#include "experiment/list_entry.h"
#include "experiment/ports/eye_tracker.h"
#include "experiment/scene/mesh.h"
#include "experiment/scene/viewing.h"
#include "experiment/screen_geometry.h"
#include "experiment/session_time.h"
#include "experiment/stimulus_lists.h"
#include "experiment/trial.h"

namespace overt {

/// Whether time really passed while the session ran.
enum class ClockKind : std::uint8_t { steady, virtual_time };

/// The protocol as it was read, byte for byte.
struct RecordedProtocol {
    std::string name;
    std::string title;
    std::string text;
    ContentHash sha256; ///< of text

    /// A file that it includes, by its path as seen from the protocol's folder.
    struct Included {
        std::string name;
        std::string text;
        ContentHash sha256; ///< of text
        bool operator==(const Included&) const = default;
    };
    std::vector<Included> included = {};
};

/// The program that ran the session.
struct ProgramBuild {
    std::string version;
    std::string compiler;
    std::string flags;
    std::string commit; ///< empty if not known
};

/// What OpenGL said of itself.
struct GraphicsSystem {
    std::string context; ///< "window", "egl" or "osmesa"
    std::string vendor;
    std::string renderer;
    std::string version;
};

struct RecordedDisplay {
    ScreenGeometry screen;
    double refresh_hz = 120.0;
    SessionDuration latency{}; ///< from the vertical blank to the first row's light
    std::string output_mode;   ///< by the protocol's word
    double background = 0.0;   ///< linear grey, 0 … 1 of the display's white
    /// Of the flips: "proven" or "unproven" (TimingClaim); "none" in virtual time and without a screen; empty
    /// where it is not known, as in sessions of earlier programs and in imported ones.
    std::string timing = {};
    /// How each eye had a picture of its own, by the protocol's word: `screen` is an eye's field then. Empty:
    /// both had the same.
    std::string stereo = {};
    double interocular_mm = 0.0; ///< between the two cameras' eyes; 0 without `stereo`
};

/// What was known of the display's light: the essentials, and the files that say it, as they were read.
struct RecordedCharacterisation {
    struct File {
        std::string name;
        std::string text;
        bool operator==(const File&) const = default;
    };
    std::string display;
    std::string date;
    std::string instrument;
    ContentHash sha256;                        ///< of all files
    glm::dvec3 black_xyz{0.0};                 ///< CIE 1931, cd/m2
    std::array<glm::dvec3, 3> primaries_xyz{}; ///< red, green and blue at full signal, without the black
    std::vector<File> files;                   ///< the characterisation file first

    double white_cd_m2() const {
        return black_xyz.y + primaries_xyz[0].y + primaries_xyz[1].y + primaries_xyz[2].y;
    }
};

struct RecordedTask {
    std::string id;
    std::string question;
};

struct RecordedObject {
    std::string id;
    std::string title;
    ContentHash mesh_sha256;
    std::string mesh_file;               ///< relative to the session's directory; empty without a mesh
    std::vector<std::string> part_names; ///< by PartIndex
    /// By view, at each size that slots have (SessionHeader::in_slot); a field of view of 0 if it is not
    /// known, as ready-made maps may leave it.
    std::vector<Camera> cameras = std::vector<Camera>(1);
    glm::dvec3 axis_point{0.0}; ///< through which the vertical axis of the turn goes
    Bounds bounds;              ///< by which the maps are coded
    /// Of all its lengths: "mm"; "own" if the protocol does not know it, or if maps came without a mesh and
    /// do not say it; empty in sessions of earlier programs, which did not write it down.
    std::string unit = "mm";
    NamedWords columns = {}; ///< said of it in the protocol
    /// Added to a place on the object, it gives the place in the coordinates of the mesh's file, turned and
    /// scaled as the protocol says. Not 0 for a mesh far from its file's origin only (import_mesh).
    glm::dvec3 origin{0.0};
    /// Of how its surface looks by its file, and the files that say it, the mesh's first: where a material of
    /// the protocol asks for that, else empty, as in sessions of earlier programs.
    ContentHash surface_sha256 = {};
    std::string surface_files = {};

    const Camera& camera(int view) const { return cameras.at(static_cast<std::size_t>(view)); }
};

struct RecordedStimulus {
    Stimulus stimulus;
    std::string source; ///< how its frames were made, in words
    /// Of the pixels that are shown: see StimulusLibrary::frames_hash. Empty where nothing was drawn, and in
    /// sessions of earlier programs, which knew only what frames are made from.
    ContentHash frames_sha256;
    ContentHash made_from_sha256 = {}; ///< of everything that the frames are made from, or of their files
    std::string drawn_by = {};         ///< of live frames, what OpenGL says of its renderer; else empty

    /// Whether both are made from the same and, as far as both know their pixels, look the same.
    bool is_same_as(const RecordedStimulus& other) const {
        return made_from_sha256 == other.made_from_sha256 &&
               (frames_sha256.empty() || other.frames_sha256.empty() || frames_sha256 == other.frames_sha256);
    }
};

/// A place on the screen.
struct RecordedSlot {
    std::string id;
    std::string title;
    glm::ivec2 origin_px{0}; ///< top left pixel of its image
    glm::ivec2 size_px{0};
    bool operator==(const RecordedSlot&) const = default;
};

/// A coordinate-encoded map of an object in a view and a pose. It shows all materials and lights.
struct RecordedMap {
    enum class Made : std::uint8_t { prepared, live };
    /// What its file holds: numbers of triangles (triangle_map.h), or coordinates (coordinate_image_file.h).
    enum class Kind : std::uint8_t { triangles, coordinates };
    ViewedObject viewed;
    PoseIndex pose;
    std::string file; ///< relative to the session's directory
    ContentHash sha256;
    Made made = Made::prepared; ///< before the session, or while the frame was shown
    Kind kind = Kind::triangles;
};

/// A place on an object's surface that the protocol's [[points]] name.
struct RecordedPoint {
    int object = 0;
    std::string name; ///< "ID.1"; a level of the factors that probes are
    std::uint32_t triangle = 0;
    glm::dvec3 barycentric{0.0};              ///< weights of the triangle's corners, sum 1
    glm::dvec3 position{0.0};                 ///< in object coordinates, in the object's unit
    std::optional<std::uint32_t> vertex = {}; ///< of the mesh, where it is one
    std::string part = {};                    ///< of the surface
};

/// One thing that the protocol's [dataset] says, by its key; a list has an entry for each text.
struct RecordedDatasetEntry {
    std::string key;
    std::string value;
    bool operator==(const RecordedDatasetEntry&) const = default;
};

struct SessionHeader {
    RecordedProtocol protocol;
    std::vector<RecordedDatasetEntry> dataset = {};
    Schedule schedule; ///< observer, seed, and the order in which the trials were to come
    int session_number = 1;
    std::string started_utc; ///< wall clock, ISO 8601; never exported
    ClockKind clock = ClockKind::steady;
    ProgramBuild program;
    GraphicsSystem graphics;
    TrackerDescription tracker;
    /// Of the record of a further tracker: its id. Empty: the session's own record.
    std::string further_tracker = {};
    RecordedDisplay display;
    std::optional<RecordedCharacterisation> characterisation; ///< of the display, if the protocol names one
    std::vector<Animation> animations = std::vector<Animation>(1); ///< by motion
    PoseTable poses;
    std::vector<std::string> blocks; ///< ids; none: the protocol has no blocks
    std::vector<RecordedTask> tasks;
    std::vector<RecordedObject> objects;
    std::vector<ListEntry> materials;
    std::vector<ListEntry> lights = {}, motions = {}, views = {},
                           backgrounds = {}; ///< none: there is one, with the list's name
    std::vector<RecordedStimulus> stimuli;
    std::vector<RecordedMap> maps;
    std::vector<RecordedPoint> points = {}; ///< of all objects, list by list
    std::vector<RecordedSlot> slots = {}; ///< as read: one at least, that of the image where none is recorded

    /// Nothing proves when pictures were lit, nor, therefore, that no refresh was missed: as the protocol
    /// claims, or since real time went by without a screen. In virtual time refreshes are missed as
    /// simulated.
    bool is_timing_unproven() const {
        return display.timing == "unproven" || (display.timing == "none" && clock == ClockKind::steady);
    }

    const Animation& animation_of(const Stimulus& stimulus) const {
        return animations.at(static_cast<std::size_t>(stimulus.motion));
    }
    const Camera& camera_of(const Stimulus& stimulus) const {
        return objects.at(static_cast<std::size_t>(stimulus.object)).camera(stimulus.view);
    }
    /// What the plan has for each refresh of a presentation of a stimulus.
    PageCycle page_cycle_of(const Stimulus& stimulus) const {
        return make_page_cycle(animation_of(stimulus), poses.frames_of(stimulus.motion), display.refresh_hz);
    }

    /// The stimulus as its slot shows it to an eye: what frames, maps and cameras are found by. Views count
    /// on from those of the list for each further size that slots' images have, in the order of the slots,
    /// and then, where the eyes have pictures of their own, for the right eye.
    Stimulus in_slot(const PlacedStimulus& placed, Eye eye) const;
    /// To the eye that is analysed.
    Stimulus in_slot(const PlacedStimulus& placed) const { return in_slot(placed, tracker.eye); }

    /// How many views there are at all sizes: as many cameras each eye has before an object.
    std::size_t views_of_an_eye() const;

    /// The screen with an image of the size that belongs to such a view (in_slot).
    ScreenGeometry screen_of_view(int view) const;

    /// The screen with a slot's image on it.
    ScreenGeometry screen_of_slot(int slot) const {
        ScreenGeometry screen = display.screen;
        if (slot >= 0 && static_cast<std::size_t>(slot) < slots.size()) {
            screen.image_origin_px = slots[static_cast<std::size_t>(slot)].origin_px;
            screen.image_px = slots[static_cast<std::size_t>(slot)].size_px;
        }
        return screen;
    }
};

/// What the maps of a presentation show: the trial's stimulus in its slot.
inline ViewedObject viewed_in(const SessionHeader& header, const Trial& trial) {
    return viewed(header.in_slot(trial.shown(0)));
}

/// The same as an eye sees it.
inline ViewedObject viewed_in(const SessionHeader& header, const Trial& trial, Eye eye) {
    return viewed(header.in_slot(trial.shown(0), eye));
}

/// Where the entries of each of `stimulus_lists` are, in their order.
inline constexpr std::tuple recorded_lists{&SessionHeader::objects, &SessionHeader::materials,
                                           &SessionHeader::lights,  &SessionHeader::motions,
                                           &SessionHeader::views,   &SessionHeader::backgrounds};
static_assert(std::tuple_size_v<decltype(recorded_lists)> == stimulus_lists.size());

/// The entries of a list, at least one; of objects what all lists have. `list`: index into `stimulus_lists`.
std::vector<ListEntry> entries_of(const SessionHeader& header, std::size_t list);

/// Puts the entries of a list into the header; of objects, which are described there already, the columns.
void record_entries(SessionHeader& header, std::size_t list, const std::vector<const ListEntry*>& entries);

/// How many entries each list has.
std::array<std::size_t, stimulus_lists.size()> entry_counts(const SessionHeader& header);

/// All factors of a session's trials.
Factors factors_of(const SessionHeader& header);

/// The ids of a stimulus' entries, of lists with several, and always of object and material: "muse/gold".
std::string stimulus_name(const SessionHeader& header, const Stimulus& stimulus,
                          std::string_view between = "/");

} // namespace overt
