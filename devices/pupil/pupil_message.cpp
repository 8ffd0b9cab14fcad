#include "devices/pupil/pupil_message.h"

#include <cmath>

namespace overt {
namespace {

std::optional<double> finite(std::optional<double> number) noexcept {
    return number && std::isfinite(*number) ? number : std::nullopt;
}

/// An array of at least `wanted` finite numbers. The rest of it is passed over.
bool read_numbers(MsgpackReader& reader, double* into, std::uint32_t wanted) noexcept {
    const std::optional<std::uint32_t> count = reader.begin_array();
    bool all = count && *count >= wanted;
    for (std::uint32_t i = 0; count && i < *count && !reader.failed(); ++i) {
        const std::optional<double> number = finite(reader.number());
        all = all && (i >= wanted || number);
        if (i < wanted)
            into[i] = number.value_or(0.0);
    }
    return all && !reader.failed();
}

std::optional<glm::vec3> read_sphere_centre(MsgpackReader& reader) noexcept {
    std::optional<glm::vec3> centre;
    reader.each_entry([&](std::string_view key) {
        if (key != "center")
            return false;
        double place[3];
        if (read_numbers(reader, place, 3))
            centre = glm::vec3(glm::dvec3(place[0], place[1], place[2]));
        return true;
    });
    return centre;
}

/// The topic that a gaze was made of, which names the eye cameras: "gaze.3d.0.", "gaze.2d.01.". It stands in
/// an array before its time, by itself or in a further array.
std::string_view read_base_topic(MsgpackReader& reader) noexcept {
    std::string_view topic;
    const std::optional<std::uint32_t> count = reader.begin_array();
    for (std::uint32_t i = 0; count && i < *count && !reader.failed(); ++i) {
        const std::optional<std::string_view> text = reader.text();
        if (i == 0 && text)
            topic = *text;
    }
    return topic;
}

} // namespace

std::optional<PupilDatum> read_pupil_datum(std::string_view bytes) noexcept {
    MsgpackReader reader(bytes);
    std::optional<double> id, time_s, confidence;
    PupilDatum datum;
    const bool is_map = reader.each_entry([&](std::string_view key) {
        if (key == "id")
            id = reader.number();
        else if (key == "timestamp")
            time_s = finite(reader.number());
        else if (key == "confidence")
            confidence = finite(reader.number());
        else if (key == "diameter_3d")
            datum.diameter_mm = finite(reader.number());
        else if (key == "diameter")
            datum.diameter_px = finite(reader.number());
        else if (key == "sphere")
            datum.eye_mm = read_sphere_centre(reader);
        else
            return false;
        return true;
    });
    if (!is_map || !time_s || !confidence || (id != 0.0 && id != 1.0))
        return std::nullopt;
    datum.eye = id == 0.0 ? Eye::right : Eye::left;
    datum.time_s = *time_s;
    datum.confidence = *confidence;
    return datum;
}

std::optional<double> read_gaze_time(std::string_view bytes) noexcept {
    MsgpackReader reader(bytes);
    std::optional<double> time_s;
    const bool is_map = reader.each_entry([&](std::string_view key) {
        if (key != "timestamp")
            return false;
        time_s = finite(reader.number());
        return true;
    });
    return is_map ? time_s : std::nullopt;
}

std::optional<SurfaceGaze> read_surface_gaze(MsgpackReader& reader) noexcept {
    std::optional<double> time_s, confidence;
    bool has_place = false;
    std::string_view topic;
    SurfaceGaze gaze;
    const bool is_map = reader.each_entry([&](std::string_view key) {
        if (key == "norm_pos") {
            double place[2];
            has_place = read_numbers(reader, place, 2);
            if (has_place)
                gaze.place = {place[0], place[1]};
        } else if (key == "timestamp") {
            time_s = finite(reader.number());
        } else if (key == "confidence") {
            confidence = finite(reader.number());
        } else if (key == "base_data") {
            topic = read_base_topic(reader);
        } else {
            return false;
        }
        return true;
    });
    if (!is_map || !has_place || !time_s || !confidence)
        return std::nullopt;
    gaze.time_s = *time_s;
    gaze.confidence = *confidence;
    // "gaze.3d.01.": the cameras stand after the second point.
    const std::size_t method = topic.find('.');
    const std::size_t cameras = method == std::string_view::npos ? method : topic.find('.', method + 1);
    if (cameras != std::string_view::npos) {
        gaze.from_right = topic.find('0', cameras) != std::string_view::npos;
        gaze.from_left = topic.find('1', cameras) != std::string_view::npos;
    }
    return gaze;
}

} // namespace overt
