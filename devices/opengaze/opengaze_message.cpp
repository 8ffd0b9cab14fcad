#include "devices/opengaze/opengaze_message.h"

#include <limits>

#include <fmt/format.h>

#include "devices/link/text_line.h"
#include "experiment/base/text_number.h"

namespace overt {
namespace {

/// Numbers with their flag of validity, as they come one after the other in a record.
struct Flagged {
    std::optional<double> x, y, z;
    bool is_valid = false;

    std::optional<glm::dvec2> point() const noexcept {
        return is_valid && x && y ? std::optional(glm::dvec2(*x, *y)) : std::nullopt;
    }
    std::optional<double> number() const noexcept { return is_valid ? x : std::nullopt; }
};

/// What a record says of one eye, before it is known what of it is valid.
struct EyeFields {
    Flagged gaze, camera_pupil, eye, pupil_mm;
    std::optional<double> pupil_m;

    /// `field`: a name without its first letter, which tells the eye.
    void take(std::string_view field, std::string_view text) noexcept {
        const auto number = [&text] { return decimal_number(text); };
        if (field == "POGX")
            gaze.x = number();
        else if (field == "POGY")
            gaze.y = number();
        else if (field == "POGV")
            gaze.is_valid = text == "1";
        else if (field == "PD")
            camera_pupil.x = number();
        else if (field == "PV")
            camera_pupil.is_valid = text == "1";
        else if (field == "EYEX")
            eye.x = number();
        else if (field == "EYEY")
            eye.y = number();
        else if (field == "EYEZ")
            eye.z = number();
        else if (field == "PUPILD")
            pupil_m = number();
        else if (field == "PUPILV")
            eye.is_valid = text == "1";
        else if (field == "PMM")
            pupil_mm.x = number();
        else if (field == "PMMV")
            pupil_mm.is_valid = text == "1";
    }

    OpenGazeEye read() const noexcept {
        OpenGazeEye read;
        read.gaze = gaze.point();
        read.pupil_px = camera_pupil.number();
        read.pupil_mm = pupil_mm.number();
        if (!read.pupil_mm && eye.is_valid && pupil_m)
            read.pupil_mm = *pupil_m * 1000.0;
        if (eye.is_valid && eye.x && eye.y && eye.z)
            read.eye_mm = glm::vec3(glm::dvec3(*eye.x, *eye.y, *eye.z) * 1000.0);
        return read;
    }
};

} // namespace

std::optional<OpenGazeMessage> parse_opengaze(std::string_view line) noexcept {
    const std::size_t begin = line.find_first_not_of(" \t");
    if (begin == std::string_view::npos || line[begin] != '<')
        return std::nullopt;
    line.remove_prefix(begin + 1);
    // A line whose end is missing may have lost a part of its last value.
    const std::size_t end = line.find_last_not_of(" \t");
    if (end == std::string_view::npos || line[end] != '>')
        return std::nullopt;
    line = line.substr(0, end);
    const std::size_t length = std::min(line.find_first_of(" \t/>"), line.size());
    const std::string_view kind = line.substr(0, length);
    OpenGazeMessage message;
    message.attributes = line.substr(length);
    if (kind == "REC")
        message.kind = OpenGazeMessage::Kind::record;
    else if (kind == "ACK")
        message.kind = OpenGazeMessage::Kind::acknowledged;
    else if (kind == "NACK")
        message.kind = OpenGazeMessage::Kind::refused;
    else if (kind == "CAL")
        message.kind = OpenGazeMessage::Kind::calibration;
    return message;
}

std::optional<std::string_view> OpenGazeMessage::value(std::string_view name) const noexcept {
    std::optional<std::string_view> found;
    for_each([&](std::string_view each, std::string_view text) {
        if (!found && each == name)
            found = text;
    });
    return found;
}

std::optional<double> OpenGazeMessage::number(std::string_view name) const noexcept {
    const std::optional<std::string_view> text = value(name);
    return text ? decimal_number(*text) : std::nullopt;
}

OpenGazeRecord read_opengaze_record(const OpenGazeMessage& message) noexcept {
    OpenGazeRecord record;
    EyeFields left, right;
    Flagged best;
    message.for_each([&](std::string_view name, std::string_view text) {
        if (name == "CNT")
            record.counter = number_in<std::int64_t>(text);
        else if (name == "TIME")
            record.time_s = decimal_number(text);
        else if (name == "TIME_TICK")
            record.ticks = number_in<std::int64_t>(text);
        else if (name == "BPOGX")
            best.x = decimal_number(text);
        else if (name == "BPOGY")
            best.y = decimal_number(text);
        else if (name == "BPOGV")
            best.is_valid = text == "1";
        else if (name.front() == 'L')
            left.take(name.substr(1), text);
        else if (name.front() == 'R')
            right.take(name.substr(1), text);
    });
    record.left = left.read();
    record.right = right.read();
    record.best = best.point();
    return record;
}

std::optional<OpenGazeCalibrationPoint> calibration_point(const OpenGazeMessage& message, int number) {
    const auto of = [&](const char* name) { return message.number(fmt::format("{}{}", name, number)); };
    const auto eye = [&](const char* x, const char* y, const char* valid) {
        const std::optional<double> measured_x = of(x), measured_y = of(y);
        return of(valid) == 1.0 && measured_x && measured_y
                   ? std::optional(glm::dvec2(*measured_x, *measured_y))
                   : std::nullopt;
    };
    const std::optional<double> x = of("CALX"), y = of("CALY");
    if (!x || !y)
        return std::nullopt;
    return OpenGazeCalibrationPoint{{*x, *y}, eye("LX", "LY", "LV"), eye("RX", "RY", "RV")};
}

std::string opengaze_text(std::string_view text) {
    std::string clean(text);
    for (char& each : clean)
        if (each < ' ' || each > '~' || std::string_view("\"'<>&").find(each) != std::string_view::npos)
            each = ' ';
    return clean;
}

} // namespace overt
