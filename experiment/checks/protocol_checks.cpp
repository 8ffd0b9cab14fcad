#include "experiment/checks/protocol_checks.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <fmt/format.h>

namespace overt {

void check_ids_differ(ProtocolExamination& examination, std::string_view list,
                      const std::vector<std::string_view>& ids) {
    for (std::size_t i = 0; i < ids.size(); ++i) {
        const auto earlier = static_cast<std::size_t>(std::ranges::find(ids, ids[i]) - ids.begin());
        const std::string path = fmt::format("{}[{}].id", list, i);
        if (earlier < i && !ids[i].empty())
            examination.error(
                {path}, fmt::format("id \"{}\" is taken already", ids[i]),
                fmt::format("by the [[{}]] in {}", list,
                            examination.line_of(fmt::format("{}[{}].id", list, earlier), path)));
    }
}

bool is_known(ProtocolExamination& examination, const std::string& path, std::string_view noun,
              std::string_view id, const std::vector<std::string_view>& known) {
    if (std::ranges::find(known, id) != known.end())
        return true;
    examination.error({path}, fmt::format("there is no {} \"{}\"", noun, id), suggest_name(id, known));
    return false;
}

namespace {

void check_view(ProtocolExamination& examination, std::size_t index) {
    const DisplaySettings display = display_of_field(examination.protocol);
    const ViewSettings& view = examination.protocol.views[index];
    const auto key = [&](std::string_view name) { return fmt::format("view[{}].{}", index, name); };
    const bool has_slots = !examination.protocol.slot_entries.empty(); // whose places are checked themselves
    if (!has_slots && view.width_px > display.width_px) {
        examination.error(
            {key("width_px"), "display.width_px"},
            fmt::format("the image is {} px wide, the screen only {} px", view.width_px, display.width_px),
            "stimuli are shown 1:1; make view.width_px smaller");
    }
    if (!has_slots && view.height_px > display.height_px) {
        examination.error(
            {key("height_px"), "display.height_px"},
            fmt::format("the image is {} px high, the screen only {} px", view.height_px, display.height_px),
            "stimuli are shown 1:1; make view.height_px smaller");
    }
    if (view.camera_position && view.camera_target && *view.camera_position == *view.camera_target) {
        examination.error({key("camera_position"), key("camera_target")},
                          "the camera stands at the very point that it looks at");
    }
    const ViewSettings& first = examination.protocol.views.front();
    if (std::tuple(view.width_px, view.height_px, view.left_px, view.top_px, view.centre_right_deg,
                   view.centre_up_deg) != std::tuple(first.width_px, first.height_px, first.left_px,
                                                     first.top_px, first.centre_right_deg,
                                                     first.centre_up_deg)) {
        examination.error({key("width_px"), key("height_px"), key("left_px"), key("top_px"),
                           key("centre_right_deg"), key("centre_up_deg")},
                          "the image has another size or place on the screen than in the first view",
                          "views differ in their cameras; the image is the same in all of them");
    }
}

void check_motion(ProtocolExamination& examination, std::size_t index) {
    const Animation& motion = examination.protocol.motions[index];
    const auto key = [&](std::string_view name) { return fmt::format("motion[{}].{}", index, name); };
    const double refresh_hz = examination.protocol.display.refresh_hz;
    if (refreshes_per_frame(motion.frame_rate_hz, refresh_hz) == 0) {
        const double below = std::floor(refresh_hz / motion.frame_rate_hz) * motion.frame_rate_hz;
        const double above = below + motion.frame_rate_hz;
        examination.error(
            {"display.refresh_hz", key("frame_rate_hz")},
            fmt::format(
                "a refresh rate of {} Hz is no whole multiple of the frame rate of {} Hz: frames would "
                "be lit for unequal times",
                refresh_hz, motion.frame_rate_hz),
            below > 0.0 ? fmt::format("{} Hz or {} Hz would do; or frame_rate_hz = {:.6g} or {:.6g}", below,
                                      above, refresh_hz / std::floor(refresh_hz / motion.frame_rate_hz),
                                      refresh_hz / std::ceil(refresh_hz / motion.frame_rate_hz))
                        : fmt::format("{} Hz would do; or frame_rate_hz = {:.6g}", above, refresh_hz));
    }
    const double frames = motion.duration_s * motion.frame_rate_hz;
    const double whole = std::max(1.0, std::round(frames));
    if (std::abs(frames - whole) > 1e-6 * whole) {
        examination.error({key("duration_s"), key("frame_rate_hz")},
                          fmt::format("{} s hold {:.6g} frames at {} Hz, which is no whole number",
                                      motion.duration_s, frames, motion.frame_rate_hz),
                          fmt::format("{:.9g} s are {:.0f} frames", whole / motion.frame_rate_hz, whole));
    }
}

} // namespace

void check_image_fits(ProtocolExamination& examination) {
    const DisplaySettings& display = examination.protocol.display;
    // Square pixels are assumed by everyone who draws a circle.
    const double aspect = display.width_mm / display.width_px / (display.height_mm / display.height_px);
    if (std::abs(aspect - 1.0) > 0.02) {
        examination.warning(
            {"display.width_mm", "display.height_mm", "display.width_px", "display.height_px"},
            fmt::format("pixels are {:.3f} times as wide as high", aspect),
            "measure the lit area, without the frame around it");
    }
    for (std::size_t i = 0; i < examination.protocol.views.size(); ++i)
        check_view(examination, i);
}

void check_motions(ProtocolExamination& examination) {
    for (std::size_t i = 0; i < examination.protocol.motions.size(); ++i)
        check_motion(examination, i);
}

void check_screens(ProtocolExamination& examination) {
    const Protocol& protocol = examination.protocol;
    const DisplaySettings& display = protocol.display;
    const ScreenSettings& screens = protocol.screens;
    if (screens.response_max_s < screens.response_min_s) {
        examination.error({"screens.response_max_s", "screens.response_min_s"},
                          fmt::format("the response screen ends after {} s, before its least time of {} s",
                                      screens.response_max_s, screens.response_min_s));
    }
    if (std::abs(screens.text_grey - display.background) < 0.02) {
        examination.error({"screens.text_grey", "display.background"},
                          fmt::format("text of grey {} cannot be seen on a background of {}",
                                      screens.text_grey, display.background));
    }
    const double text_px = screens.text_height_deg * screen_geometry_of(protocol).px_per_deg_at_centre();
    // Below 8 rows letters lose their shapes; above a tenth of the screen a question does not fit.
    if (text_px < 8.0) {
        examination.error({"screens.text_height_deg", "display.viewing_distance_mm"},
                          fmt::format("text of {} deg is {:.1f} px high: too small to be read",
                                      screens.text_height_deg, text_px));
    } else if (text_px > 0.1 * display.height_px) {
        examination.error({"screens.text_height_deg", "display.viewing_distance_mm"},
                          fmt::format("text of {} deg is {:.0f} px high: too large for a screen of {} rows",
                                      screens.text_height_deg, text_px, display.height_px));
    }
}

} // namespace overt
