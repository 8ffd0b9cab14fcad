#include <thread>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/statvfs.h>

#include "app/cli/cache_folder.h"
#include "app/cli/state_folder.h"
#include "app/display/display_commands.h"
#include "app/display/photodiode_doctor.h"
#include "app/display/screen_doctor.h"
#include "app/display/tracker_doctor.h"
#include "app/rig/answer_equipment.h"
#include "app/rig/button_boxes.h"
#include "app/rig/marker_outputs.h"
#include "devices/display_box/display_plus_plus_search.h"
#include "devices/display_box/switch_record.h"
#include "devices/host/clocks.h"
#include "devices/host/thread_priority.h"
#include "devices/light/colorcal.h"
#include "devices/link/serial_port.h"
#include "render/gl/headless_context.h"
#include "render/window/context_survey.h"
#include "render/window/screen_check.h"
#include "render/window/window_system.h"

namespace overt {

namespace {

struct Line {
    std::string what, finding;
};

double free_gb(const std::filesystem::path& folder) {
    std::filesystem::path existing = folder;
    while (!existing.empty() && !std::filesystem::exists(existing))
        existing = existing.parent_path();
    std::error_code error;
    const auto space = std::filesystem::space(existing, error);
    return error ? 0.0 : static_cast<double>(space.available) / 1e9;
}

std::string realtime_priority() {
    // Limits alone do not tell: root needs none, containers take it away, and RealtimeKit gives it.
    const ThreadWish wish = try_realtime_priority();
    return wish.granted ? "granted: " + wish.detail : "refused: " + wish.detail;
}

void add_screens(std::vector<Line>& lines) {
    lines.push_back({"window system", examine_window_system().description()});
    if (!display_is_available())
        return;
    try {
        for (const MonitorInfo& monitor : list_monitors()) {
            const ScreenFacts facts = facts_at(monitor);
            std::string finding = fmt::format(
                "{} x {} px at {}, from {}, {} on the desktop", monitor.size_px.x, monitor.size_px.y,
                monitor.refresh_hz > 0 ? fmt::format("{} Hz", monitor.refresh_hz)
                                       : std::string("an unknown rate"),
                monitor.position_px.x, monitor.position_px.y);
            lines.push_back({fmt::format("monitor {}, {}", monitor.number, monitor.name), finding});
            lines.push_back({"  gamma table", describe(facts.gamma_ramp)});
            if (monitor.content_scale != glm::vec2(1.0f))
                lines.push_back({"  scaling", fmt::format("{:.0f} %", 100.0 * static_cast<double>(
                                                                                  monitor.content_scale.x))});
        }
    } catch (const std::exception& error) {
        lines.push_back({"monitors", error.what()});
    }
}

/// Asks only ports of the box's vendor: an overview must not talk to another maker's device.
void add_instruments(std::vector<Line>& lines) {
    const std::vector<SerialPortInfo> ports = serial_ports();
    if (ports.empty())
        lines.push_back({"display box, photometer", "no USB serial port (/dev/ttyACM*)"});
    SteadyClock clock;
    for (const SerialPortInfo& port : ports) {
        std::string finding = "another maker's device, not asked; `overt display status` does";
        if (port.vendor_id == crs_vendor_id) {
            const AskedPort asked =
                ask_for_display_boxes({&port, 1}, std::nullopt, serial_port_opener(clock), clock).front();
            finding = asked.box ? fmt::format("display box: {}, serial number {}", asked.box->product,
                                              asked.box->serial_number)
                      : port.product_id == colorcal_product_id ? "photometer: ColorCAL"
                                                               : asked.otherwise;
        }
        lines.push_back({describe(port), finding});
    }
    try {
        if (const auto note = read_switch_record(state_folder()))
            lines.push_back({"display box", fmt::format("{} is noted to be in {} mode{}", note->serial_number,
                                                        note->mode, note->kept ? ", on purpose" : "")});
    } catch (const std::exception& error) {
        lines.push_back({"display box", error.what()});
    }
}

std::vector<Line> examine() {
    std::vector<Line> lines;
    for (const ContextAttempt& attempt : survey_contexts())
        lines.push_back({fmt::format("OpenGL, {}", name_of(attempt.kind)), attempt.outcome});
    try {
        const auto context = make_headless_context(std::nullopt);
        lines.push_back({"headless sessions take", fmt::format("{}, {}", name_of(context->description().kind),
                                                               context->description().renderer)});
    } catch (const std::exception& error) {
        lines.push_back({"headless sessions", error.what()});
    }
    add_screens(lines);
    add_instruments(lines);
    for (TrackerFinding& tracker : examine_trackers())
        lines.push_back({std::move(tracker.what), std::move(tracker.finding)});
    for (const std::string& box : button_box_overview())
        lines.push_back({"response box", box});
    for (const std::string& output : marker_overview())
        lines.push_back({"marker output", output});
    for (const std::string& sound : sound_overview())
        lines.push_back({"sound device", sound});
    lines.push_back({"processors", fmt::format("{}", std::thread::hardware_concurrency())});
    lines.push_back({"real-time priority", realtime_priority()});
    lines.push_back({"free disk, here", fmt::format("{:.1f} GB", free_gb(std::filesystem::current_path()))});
    lines.push_back({"free disk, cache",
                     fmt::format("{:.1f} GB in {}", free_gb(cache_folder()), cache_folder().string())});
    return lines;
}

} // namespace

int run_doctor(const DoctorOptions& options) {
    if (options.photodiode)
        return run_photodiode_doctor(options);
    if (options.window)
        return run_screen_doctor(options);
    const std::vector<Line> lines = examine();
    if (options.json) {
        auto json = nlohmann::ordered_json::array();
        for (const Line& line : lines)
            json.push_back({{"what", line.what}, {"finding", line.finding}});
        fmt::print("{}\n", nlohmann::ordered_json{{"doctor", json}}.dump(2));
        return 0;
    }
    for (const Line& line : lines)
        fmt::print("{:<24} {}\n", line.what, line.finding);
    return 0;
}

} // namespace overt
