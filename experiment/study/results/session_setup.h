/// How a session was set up, as far as its record says: what tables and sentences on methods are made of.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "experiment/animation.h"
#include "experiment/base/enum_names.h"
#include "experiment/gaze.h"

namespace overt {

/// Where a session's gaze comes from.
enum class GazeOrigin : std::uint8_t {
    measured,    ///< by an eye tracker, while the session ran
    imported,    ///< from a recording of another program
    simulated,   ///< made by the program
    played_back, ///< of an earlier recording
    pointer,     ///< the mouse pointer stood in for an eye
    none         ///< there is none
};
template <>
inline constexpr auto names_of<GazeOrigin> = enum_names<GazeOrigin>("measured", "imported", "simulated",
                                                                    "played back", "mouse pointer", "none");

struct GazeSetup {
    GazeOrigin origin = GazeOrigin::measured;
    std::string tracker;  ///< as its driver, or the imported recording, calls it
    std::string model;    ///< as the device tells it; of gaze that is played back: what it is of
    double rate_hz = 0.0; ///< 0: not known
    Eye eye = Eye::right; ///< of both, the one that is analysed
    bool both_eyes = false;
    bool was_simulated = false; ///< in the recording that it was imported or played back from
    /// No measurement, whichever way it came.
    bool is_simulated() const { return origin == GazeOrigin::simulated || was_simulated; }
    /// Of somebody's eyes, as far as the record says.
    bool is_of_people() const {
        return (origin == GazeOrigin::measured || origin == GazeOrigin::imported) && !was_simulated;
    }
    friend bool operator==(const GazeSetup&, const GazeSetup&) = default;
};

/// Of lengths and rates, 0: not known.
struct DisplaySetup {
    bool is_simulated = false; ///< time was virtual, and no picture was lit
    glm::ivec2 screen_px{0};
    glm::dvec2 screen_mm{0.0};
    double viewing_distance_mm = 0.0;
    std::optional<double> px_per_deg; ///< in its middle
    double refresh_hz = 0.0;
    double latency_ms = 0.0; ///< from the vertical blank to the first row's light
    std::string timing;      ///< RecordedDisplay::timing
    std::string stereo;      ///< RecordedDisplay::stereo
    double interocular_mm = 0.0;
    /// Nothing: it was not characterised.
    struct Light {
        double white_cd_m2 = 0.0;
        std::string instrument, date;
        friend bool operator==(const Light&, const Light&) = default;
    };
    std::optional<Light> light;
    friend bool operator==(const DisplaySetup&, const DisplaySetup&) = default;
};

/// The pictures, and how they move; nothing of it is known of imported recordings.
struct StimulusSetup {
    glm::ivec2 image_px{0};
    std::optional<glm::dvec2> image_deg; ///< width and height in the middle of the screen
    int frame_count = 0;                 ///< 0: nothing is known
    double frame_rate_hz = 0.0;
    double amplitude_deg = 0.0; ///< of the turn, to each side
    Playback playback = Playback::cycle;
    double duration_s = 0.0; ///< that was planned of a presentation
    /// Where there are several motions, or one that is no turn about the front under a light that stands:
    /// each in words. What is above is the first's.
    std::vector<std::string> motions = {};
    friend bool operator==(const StimulusSetup&, const StimulusSetup&) = default;
};

/// Something that a protocol names and shows by other words: a material, or a task with its question.
struct NamedThing {
    std::string id, title;
    friend bool operator==(const NamedThing&, const NamedThing&) = default;
};

struct SessionSetup {
    GazeSetup gaze;
    std::string imported_file; ///< of a recording without a protocol, its name; empty: it is none
    /// Another program presented, by this name, as far as its log tells it; nothing: this one did, or nobody
    /// knows of any stimulus.
    std::optional<std::string> presenter = {};
    DisplaySetup display;
    StimulusSetup stimuli;
    std::vector<NamedThing> materials, tasks; ///< of the protocol; titles and questions without marks
    /// Set-ups of the tracker that came to their end, by method.
    struct Calibrations {
        std::string method;
        int times = 0;
        int beyond_limits = 0; ///< of these: accepted though worse than the protocol allows
        bool is_simulated = false;
        friend bool operator==(const Calibrations&, const Calibrations&) = default;
    };
    std::vector<Calibrations> calibrations;
    std::string rig; ///< what was proved on it, by the page that the record names; empty: it names none
    std::string program_version; ///< of overt, which ran or imported it
};

} // namespace overt
