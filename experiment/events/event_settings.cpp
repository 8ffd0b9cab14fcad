#include "experiment/events/event_settings.h"

#include <fmt/format.h>

namespace overt {

std::string json_of(const EventSettings& settings) {
    return fmt::format(
        R"({{"velocity_deg_s":{},"acceleration_deg_s2":{},"motion_deg":{},"pursuit_deg_s":{},"onset_verify_ms":{},)"
        R"("offset_verify_ms":{},"blink_verify_ms":{},"velocity_window_ms":{},"acceleration_window_ms":{},)"
        R"("pursuit_window_ms":{},"longest_gap_ms":{}}})",
        settings.velocity_deg_s, settings.acceleration_deg_s2, settings.motion_deg, settings.pursuit_deg_s,
        settings.onset_verify_ms, settings.offset_verify_ms, settings.blink_verify_ms, velocity_window_ms,
        acceleration_window_ms, pursuit_window_ms, longest_gap_ms);
}

EventDetection detection_by(const EventSettings& settings) {
    return {std::string(event_detector_name), event_detector_version, json_of(settings)};
}

} // namespace overt
