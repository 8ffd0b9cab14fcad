/// What Pupil Capture publishes, as far as a session takes part in it: maps in MessagePack, by topic.
#pragma once

#include <optional>
#include <string_view>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "devices/pupil/msgpack_reader.h"
#include "experiment/gaze.h"

namespace overt {

/// Topic "pupil.<eye>…": one measurement of one eye camera.
struct PupilDatum {
    Eye eye = Eye::right; ///< camera 0 looks at the right eye
    double time_s = 0.0;  ///< Pupil time
    double confidence = 0.0;
    std::optional<double> diameter_mm; ///< by the model of the eye in 3D
    std::optional<double> diameter_px; ///< in the camera's image
    std::optional<glm::vec3> eye_mm;   ///< the middle of the eyeball, from the eye camera
};

/// Nothing if the bytes are no such map, or lack eye, time or confidence.
std::optional<PupilDatum> read_pupil_datum(std::string_view bytes) noexcept;

/// The time of a map of gaze in the scene camera's picture, from the topics "gaze.…", in seconds of Pupil
/// time; nothing if the bytes are no such map.
std::optional<double> read_gaze_time(std::string_view bytes) noexcept;

/// Gaze on a surface, from the topic "surfaces.<name>".
struct SurfaceGaze {
    glm::dvec2 place{}; ///< share of the surface: (0, 0) bottom left, (1, 1) top right
    double time_s = 0.0;
    double confidence = 0.0;
    bool from_left = false, from_right = false; ///< which eyes it was reckoned from
};

/// Calls on_gaze(SurfaceGaze) for each gaze in the order in which it stands there. What lacks place, time or
/// confidence is passed over. False if the bytes are no such map.
template <class OnGaze> bool read_surface(std::string_view bytes, OnGaze&& on_gaze) noexcept;

/// One map of a surface's list "gaze_on_surfaces".
std::optional<SurfaceGaze> read_surface_gaze(MsgpackReader& reader) noexcept;

template <class OnGaze> bool read_surface(std::string_view bytes, OnGaze&& on_gaze) noexcept {
    MsgpackReader reader(bytes);
    return reader.each_entry([&](std::string_view key) {
        if (key != "gaze_on_surfaces")
            return false;
        const std::optional<std::uint32_t> count = reader.begin_array();
        for (std::uint32_t i = 0; count && i < *count && !reader.failed(); ++i)
            if (const std::optional<SurfaceGaze> gaze = read_surface_gaze(reader))
                on_gaze(*gaze);
        return true;
    });
}

} // namespace overt
