#include "app/rig/marker_outputs.h"

#include <filesystem>

#include <fmt/format.h>

#include "devices/link/serial_port_search.h"
#include "devices/lsl/lsl_outlet.h"
#include "devices/triggers/parallel_trigger.h"
#include "devices/triggers/serial_trigger.h"
#include "devices/triggers/threaded_marker_sink.h"
#include "devices/usb/serial_line.h"
#include "experiment/base/error.h"

namespace overt {
namespace {

constexpr const char* first_parallel_port = "/dev/parport0";
/// Each frame of half a minute at 120 Hz, and the rest.
constexpr std::size_t held_markers = 4096;

std::unique_ptr<MarkerSink> open_output(const MarkerOutputSettings& output, Clock& clock,
                                        const std::string& session) {
    MarkerPulse pulse;
    pulse.length = from_seconds(1e-3 * output.pulse_ms);
    std::unique_ptr<MarkerOutput> opened;
    switch (output.kind) {
    case MarkerOutputKind::serial:
        opened = std::make_unique<SerialTrigger>(open_serial_line(output.address, clock, output.baud), clock);
        break;
    case MarkerOutputKind::parallel:
        opened =
            std::make_unique<ParallelTrigger>(output.address.empty() ? first_parallel_port : output.address);
        break;
    case MarkerOutputKind::lsl:
        pulse.length = {};
        opened = std::make_unique<LslMarkerOutlet>(load_lsl(output.library), session, clock);
        break;
    case MarkerOutputKind::t_lock:
        return nullptr;
    }
    return std::make_unique<ThreadedMarkerSink>(std::move(opened), clock, pulse, held_markers);
}

} // namespace

MarkerEquipment::MarkerEquipment(const Protocol& protocol, Clock& clock, bool virtual_time,
                                 const std::string& session,
                                 const std::function<void(const std::string&)>& tell) {
    for (const MarkerOutputSettings& output : protocol.marker_outputs) {
        std::unique_ptr<MarkerSink>& sink = sinks_.emplace_back();
        if (output.kind == MarkerOutputKind::t_lock) {
            descriptions_.push_back(
                fmt::format("{}: digital outputs of the display box, by the picture", output.id));
            continue;
        }
        if (virtual_time) {
            descriptions_.push_back(fmt::format("{}: nothing is sent, for time is virtual", output.id));
            continue;
        }
        try {
            sink = open_output(output, clock, session);
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
    for (int i = 0; i < 4; ++i) {
        std::error_code absent;
        const std::string port = fmt::format("/dev/parport{}", i);
        if (std::filesystem::exists(port, absent))
            lines.push_back(fmt::format("{}: kind parallel", port));
    }
    for (const SerialPortInfo& port : serial_ports("/dev", "/sys", "ttyUSB"))
        lines.push_back(fmt::format("{}: kind serial", describe(port)));
    try {
        load_lsl({});
        lines.emplace_back("Lab Streaming Layer: its library is there, kind lsl");
    } catch (const Error& error) {
        lines.push_back(fmt::format("Lab Streaming Layer: {}", error.what()));
    }
    return lines;
}

} // namespace overt
