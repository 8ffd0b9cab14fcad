/// The language of the Open Gaze API (version 2, as of its revision of March 2025): one element a line,
/// values in quotes. Bytes to words and numbers, without input or output.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "experiment/gaze.h"

namespace overt {

/// A line of the server, which must outlive this. Read leniently: servers leave out blanks between values and
/// put others in; what is no name="value" is passed over.
struct OpenGazeMessage {
    enum class Kind : std::uint8_t {
        acknowledged, ///< <ACK …>
        refused,      ///< <NACK …>
        calibration,  ///< <CAL …>
        record,       ///< <REC …>
        other         ///< of a kind that has no part in a session, such as <UPDATE …>
    };
    Kind kind = Kind::other;
    std::string_view attributes; ///< what follows the kind

    /// Without blanks around it; nothing if there is none of that name. The first, where there are several.
    std::optional<std::string_view> value(std::string_view name) const noexcept;
    /// Nothing if it is no finite decimal number.
    std::optional<double> number(std::string_view name) const noexcept;

    /// Calls on_attribute(name, value) for each.
    template <class OnAttribute> void for_each(OnAttribute&& on_attribute) const;
};

/// Nothing if the line is no whole element: cut off, or noise.
std::optional<OpenGazeMessage> parse_opengaze(std::string_view line) noexcept;

/// What one record says of one eye. Absent: not said, or said to be invalid.
struct OpenGazeEye {
    std::optional<glm::dvec2> gaze;  ///< share of the screen, (0, 0) top left, (1, 1) bottom right
    std::optional<double> pupil_mm;  ///< diameter
    std::optional<double> pupil_px;  ///< diameter in the camera's image
    std::optional<glm::vec3> eye_mm; ///< from the camera's focal point
};

struct OpenGazeRecord {
    std::optional<std::int64_t> counter;
    std::optional<double> time_s; ///< since the server's start or its last calibration
    std::optional<std::int64_t> ticks;
    OpenGazeEye left, right;
    std::optional<glm::dvec2> best; ///< mean of both eyes' gaze, or that of the one which is valid
};

/// Of a message of kind `record`. Allocates nothing.
OpenGazeRecord read_opengaze_record(const OpenGazeMessage& message) noexcept;

/// A point of a calibration, from its result.
struct OpenGazeCalibrationPoint {
    glm::dvec2 target;                     ///< share of the screen
    std::optional<glm::dvec2> left, right; ///< where the calibrated eye was measured; nothing: not valid
};

/// The point of that number, from 1, in a message "CALIB_RESULT"; nothing if it has no such point.
std::optional<OpenGazeCalibrationPoint> calibration_point(const OpenGazeMessage& message, int number);

/// `text` as it may stand in a value: quotes, angle brackets, ampersands and what is not printable ASCII
/// become blanks, since servers were not seen to understand entities.
std::string opengaze_text(std::string_view text);

template <class OnAttribute> void OpenGazeMessage::for_each(OnAttribute&& on_attribute) const {
    constexpr std::string_view blanks = " \t";
    std::string_view rest = attributes;
    for (;;) {
        const std::size_t equals = rest.find('=');
        if (equals == std::string_view::npos)
            return;
        std::string_view name = rest.substr(0, equals);
        while (!name.empty() && blanks.find(name.back()) != std::string_view::npos)
            name.remove_suffix(1);
        name.remove_prefix(name.find_last_of(" \t\"") + 1); // npos + 1 is 0
        rest.remove_prefix(equals + 1);
        const std::size_t opening = rest.find_first_not_of(blanks);
        if (opening == std::string_view::npos || rest[opening] != '"')
            continue;
        const std::size_t closing = rest.find('"', opening + 1);
        if (closing == std::string_view::npos)
            return;
        std::string_view value = rest.substr(opening + 1, closing - opening - 1);
        value.remove_prefix(std::min(value.find_first_not_of(blanks), value.size()));
        value.remove_suffix(value.size() - (value.find_last_not_of(blanks) + 1));
        if (!name.empty())
            on_attribute(name, value);
        rest.remove_prefix(closing + 1);
    }
}

} // namespace overt
