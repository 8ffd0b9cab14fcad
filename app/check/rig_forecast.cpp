#include "app/check/rig_forecast.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/rig/display_box_session.h"
#include "experiment/base/error.h"
#include "experiment/protocol/keys/protocol_keys.h"
#include "render/window/monitor_choice.h"
#include "render/window/screen_check.h"
#include "render/window/window_system.h"

namespace overt {
namespace {

void add_screen(const DisplaySettings& display, std::vector<ForecastLine>& forecast) {
    const std::vector<MonitorInfo> monitors = list_monitors();
    MonitorInfo monitor;
    try {
        monitor = choose_monitor(monitors, {.which = display.monitor,
                                            .size_px = glm::ivec2(display.width_px, display.height_px),
                                            .refresh_hz = display.refresh_hz});
    } catch (const InputError& none) {
        forecast.push_back({"screen", none.what(), true});
        return;
    }
    const ScreenFacts facts = facts_at(monitor, row_of(display.output).framebuffer_bits);
    forecast.push_back({"screen", "the whole of " + describe(monitor)});
    for (const ScreenFinding& finding : judge_screen(facts, display))
        if (finding.weight != ScreenFinding::Weight::good)
            forecast.push_back({"", fmt::format("{}: {}", finding.what, finding.finding),
                                finding.weight == ScreenFinding::Weight::refusal});
}

ForecastLine box_line(const DisplaySettings& display, bool in_window) {
    const BoxPlan plan = plan_box(display, in_window, false);
    if (plan.use != RecordedBox::Use::box) {
        RecordedBox none;
        none.use = plan.use;
        return {"display box", describe(none)};
    }
    try {
        const BoxIdentity box = require_box(plan);
        return {"display box",
                fmt::format("{}, serial number {}, at {}: will be switched to {}", box.product,
                            box.serial_number, box.port, name_of(box_mode_of(display.output)))};
    } catch (const InputError&) {
        return {"display box",
                fmt::format("needed for {} and not found{}; see `overt display status`",
                            name_of(display.output), plan.port ? " at " + *plan.port : ""),
                true};
    }
}

} // namespace

std::vector<ForecastLine> rig_forecast(const Protocol& protocol) {
    std::vector<ForecastLine> forecast;
    const bool in_window = display_is_available();
    if (in_window) {
        try {
            add_screen(protocol.display, forecast);
        } catch (const GraphicsError& error) {
            forecast.push_back({"screen", error.what(), true});
        }
    } else {
        forecast.push_back({"screen", "none here: headless, with --simulate-observer"});
    }
    forecast.push_back(box_line(protocol.display, in_window));
    return forecast;
}

std::string to_text(const std::vector<ForecastLine>& forecast) {
    std::string text = "\nA session in real time on this machine\n\n";
    for (const ForecastLine& line : forecast)
        text += fmt::format("  {:<12}{}{}\n", line.what, line.is_refused ? "refused: " : "", line.finding);
    return text;
}

nlohmann::ordered_json to_json(const std::vector<ForecastLine>& forecast) {
    auto list = nlohmann::ordered_json::array();
    for (const ForecastLine& line : forecast)
        list.push_back({{"what", line.what}, {"finding", line.finding}, {"refused", line.is_refused}});
    return list;
}

} // namespace overt
