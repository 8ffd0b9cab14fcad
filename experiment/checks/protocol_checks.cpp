#include "experiment/checks/protocol_checks.h"

#include <algorithm>
#include <cmath>

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

void check_image_fits(ProtocolExamination& examination) {
    const DisplaySettings& display = examination.protocol.display;
    const ViewSettings& view = examination.protocol.view;
    const bool has_slots = !examination.protocol.slot_entries.empty(); // whose places are checked themselves
    if (!has_slots && view.width_px > display.width_px) {
        examination.error(
            {"view.width_px", "display.width_px"},
            fmt::format("the image is {} px wide, the screen only {} px", view.width_px, display.width_px),
            "stimuli are shown 1:1; make view.width_px smaller");
    }
    if (!has_slots && view.height_px > display.height_px) {
        examination.error(
            {"view.height_px", "display.height_px"},
            fmt::format("the image is {} px high, the screen only {} px", view.height_px, display.height_px),
            "stimuli are shown 1:1; make view.height_px smaller");
    }
    // Square pixels are assumed by everyone who draws a circle.
    const double aspect = display.width_mm / display.width_px / (display.height_mm / display.height_px);
    if (std::abs(aspect - 1.0) > 0.02) {
        examination.warning(
            {"display.width_mm", "display.height_mm", "display.width_px", "display.height_px"},
            fmt::format("pixels are {:.3f} times as wide as high", aspect),
            "measure the lit area, without the frame around it");
    }
    if (view.camera_position && view.camera_target && *view.camera_position == *view.camera_target) {
        examination.error({"view.camera_position", "view.camera_target"},
                          "the camera stands at the very point that it looks at");
    }
}

void check_animation(ProtocolExamination& examination) {
    const Animation& animation = examination.protocol.animation;
    const double refresh_hz = examination.protocol.display.refresh_hz;
    if (refreshes_per_frame(animation.frame_rate_hz, refresh_hz) == 0) {
        const double below = std::floor(refresh_hz / animation.frame_rate_hz) * animation.frame_rate_hz;
        const double above = below + animation.frame_rate_hz;
        examination.error(
            {"display.refresh_hz", "animation.frame_rate_hz"},
            fmt::format(
                "a refresh rate of {} Hz is no whole multiple of the frame rate of {} Hz: frames would "
                "be lit for unequal times",
                refresh_hz, animation.frame_rate_hz),
            below > 0.0 ? fmt::format("{} Hz or {} Hz would do; or frame_rate_hz = {:.6g} or {:.6g}", below,
                                      above, refresh_hz / std::floor(refresh_hz / animation.frame_rate_hz),
                                      refresh_hz / std::ceil(refresh_hz / animation.frame_rate_hz))
                        : fmt::format("{} Hz would do; or frame_rate_hz = {:.6g}", above, refresh_hz));
    }
    const double frames = animation.duration_s * animation.frame_rate_hz;
    const double whole = std::max(1.0, std::round(frames));
    if (std::abs(frames - whole) > 1e-6 * whole) {
        examination.error({"animation.duration_s", "animation.frame_rate_hz"},
                          fmt::format("{} s hold {:.6g} frames at {} Hz, which is no whole number",
                                      animation.duration_s, frames, animation.frame_rate_hz),
                          fmt::format("{:.9g} s are {:.0f} frames", whole / animation.frame_rate_hz, whole));
    }
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
