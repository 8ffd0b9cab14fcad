#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/cli/own_folders.h"
#include "app/display/display_commands.h"
#include "app/display/doctor_report.h"
#include "app/display/machine_doctor.h"
#include "app/display/photodiode_doctor.h"
#include "app/display/screen_doctor.h"
#include "app/display/tracker_doctor.h"
#include "app/rig/answer_equipment.h"
#include "app/rig/button_boxes.h"
#include "app/rig/marker_outputs.h"
#include "app/rig/rig_page.h"
#include "devices/display_box/display_plus_plus_search.h"
#include "devices/display_box/switch_record.h"
#include "devices/host/clocks.h"
#include "devices/light/colorcal.h"
#include "devices/link/serial_port.h"
#include "render/gl/headless_context.h"
#include "render/window/context_survey.h"
#include "render/window/screen_check.h"
#include "render/window/window_system.h"

namespace overt {

namespace {

void add_screens(std::vector<DoctorFinding>& lines) {
    const WindowSystem system = examine_window_system();
    lines.push_back(
        {"window system", system.description(),
         system.is_wayland && !system.is_xwayland ? "log in to a session of X11" : system.go_between()});
    if (!display_is_available())
        return;
    try {
        const std::vector<MonitorInfo> monitors = list_monitors();
        if (monitors.size() > 1 && system.is_x11)
            lines.push_back({"monitors of the X screen",
                             fmt::format("{}: pictures beside another monitor's are usually copied, and may "
                                         "follow its refreshes",
                                         monitors.size()),
                             "switch the others off for sessions (xrandr --output NAME --off), or give the "
                             "observer's monitor an X screen of its own (docs/rig.md)"});
        for (const MonitorInfo& monitor : monitors) {
            const ScreenFacts facts = facts_at(monitor);
            std::string finding = fmt::format("{} x {} px at {}, from {}, {} on the desktop",
                                              monitor.size_px.x, monitor.size_px.y, describe_rate(monitor),
                                              monitor.position_px.x, monitor.position_px.y);
            lines.push_back({fmt::format("monitor {}, {}{}", monitor.number, monitor.name,
                                         monitor.edid_name.empty() ? "" : ", " + monitor.edid_name),
                             finding});
            const bool changes = facts.gamma_ramp.server_gamma != ServerGamma{} ||
                                 (!facts.gamma_ramp.red.empty() && !is_identity(facts.gamma_ramp));
            lines.push_back(
                {"  gamma table", describe(facts.gamma_ramp),
                 changes
                     ? fmt::format(
                           "xrandr --output {} --gamma 1:1:1, xgamma -gamma 1, and switch colour profiles "
                           "and the night light off",
                           monitor.name)
                     : ""});
            for (const SignalSetting& setting : facts.signal) {
                const SignalVerdict verdict =
                    judge_signal_setting(setting, OutputMode::color_plus_plus, monitor.name);
                lines.push_back(
                    {"  " + setting.name, setting.value,
                     verdict.is_safe ? "" : "for 16 bits through a display box: " + verdict.finding});
            }
            if (monitor.content_scale != glm::vec2(1.0f))
                lines.push_back({"  scaling", fmt::format("{:.0f} %", 100.0 * static_cast<double>(
                                                                                  monitor.content_scale.x))});
        }
    } catch (const std::exception& error) {
        lines.push_back({"monitors", error.what()});
    }
}

/// Asks only ports of the box's vendor: an overview must not talk to another maker's device.
void add_instruments(std::vector<DoctorFinding>& lines) {
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

void add_rig_page(std::vector<DoctorFinding>& lines) {
    constexpr const char* what = "page of this rig";
    try {
        const std::optional<KeptRigPage> kept = read_rig_page(rig_folder());
        lines.push_back({what, sentence_of(kept, {}),
                         kept && kept->page.is_finished() ? "" : "overt doctor PROTOCOL --first-day"});
    } catch (const std::exception& error) {
        lines.push_back({what, error.what()});
    }
}

std::vector<DoctorFinding> examine() {
    std::vector<DoctorFinding> lines;
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
    for (DoctorFinding& tracker : examine_trackers())
        lines.push_back(std::move(tracker));
    for (const std::string& box : button_box_overview())
        lines.push_back({"response box", box});
    for (const std::string& output : marker_overview())
        lines.push_back({"marker output", output});
    for (const std::string& sound : sound_overview())
        lines.push_back({"sound device", sound});
    add_rig_page(lines);
    for (DoctorFinding& finding : examine_machine())
        lines.push_back(std::move(finding));
    return lines;
}

} // namespace

int run_doctor(const DoctorOptions& options) {
    if (!options.report.empty())
        return write_doctor_report(options, examine);
    if (options.photodiode)
        return run_photodiode_doctor(options);
    if (options.window)
        return run_screen_doctor(options);
    const std::vector<DoctorFinding> lines = examine();
    if (options.json) {
        auto json = nlohmann::ordered_json::array();
        for (const DoctorFinding& line : lines) {
            json.push_back({{"what", line.what}, {"finding", line.finding}});
            if (!line.remedy.empty())
                json.back()["remedy"] = line.remedy;
        }
        fmt::print("{}\n", nlohmann::ordered_json{{"doctor", json}}.dump(2));
        return 0;
    }
    for (const DoctorFinding& line : lines) {
        fmt::print("{:<24} {}\n", line.what, line.finding);
        if (!line.remedy.empty())
            fmt::print("{:<24} to mend it: {}\n", "", line.remedy);
    }
    return 0;
}

} // namespace overt
