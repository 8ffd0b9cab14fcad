#include "app/rig/marker_outputs.h"

#include <fmt/format.h>

#include "devices/triggers/marker_device.h"
#include "devices/triggers/threaded_marker_sink.h"
#include "experiment/base/error.h"

namespace overt {
namespace {

/// Each frame of half a minute at 120 Hz, and the rest.
constexpr std::size_t held_markers = 4096;

/// In the order of their kinds.
const auto marker_devices = for_each_kind<MarkerOutputKind>([]<MarkerOutputKind kind> {
    if constexpr (row_of(kind).rides_on_picture)
        return MarkerDevice();
    else
        return marker_device_of<kind>();
});

std::unique_ptr<MarkerSink> open_output(const MarkerParts& parts) {
    MarkerPulse pulse;
    if (row_of(parts.settings.kind).tells_texts || parts.settings.as_text)
        pulse.length = {};
    else
        pulse.length = from_seconds(1e-3 * parts.settings.pulse_ms);
    return std::make_unique<ThreadedMarkerSink>(
        marker_devices[static_cast<std::size_t>(parts.settings.kind)].open(parts), parts.clock, pulse,
        held_markers);
}

} // namespace

MarkerEquipment::MarkerEquipment(const Protocol& protocol, Clock& clock, bool virtual_time,
                                 const std::string& session,
                                 const std::function<void(const std::string&)>& tell) {
    for (const MarkerOutputSettings& output : protocol.marker_outputs) {
        std::unique_ptr<MarkerSink>& sink = sinks_.emplace_back();
        if (row_of(output.kind).rides_on_picture) {
            descriptions_.push_back(
                fmt::format("{}: digital outputs of the display box, by the picture", output.id));
            continue;
        }
        if (virtual_time) {
            descriptions_.push_back(fmt::format("{}: nothing is sent, for time is virtual", output.id));
            continue;
        }
        try {
            sink = open_output({output, clock, session});
            descriptions_.push_back(fmt::format("{}: {}", output.id, sink->name()));
        } catch (const DeviceError& error) {
            if (output.required)
                throw DeviceError(
                    fmt::format("[[marker_output]] \"{}\": {} The protocol requires it: required = "
                                "false would let a session go on without it.",
                                output.id, error.what()));
            descriptions_.push_back(fmt::format("{}: left out: {}", output.id, error.what()));
            tell(descriptions_.back());
        }
    }
}

std::vector<MarkerSink*> MarkerEquipment::sinks() const {
    std::vector<MarkerSink*> all;
    for (const std::unique_ptr<MarkerSink>& sink : sinks_)
        all.push_back(sink.get());
    return all;
}

std::vector<std::string> marker_overview() {
    std::vector<std::string> lines;
    for (const MarkerDevice& device : marker_devices)
        if (device.look_for)
            for (std::string& line : device.look_for())
                lines.push_back(std::move(line));
    return lines;
}

} // namespace overt
