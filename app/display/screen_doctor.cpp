#include "app/display/screen_doctor.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/cli/progress_bar.h"
#include "app/rig/open_display.h"
#include "experiment/base/error.h"
#include "render/vblank/timing_check.h"
#include "render/window/monitor_choice.h"

namespace overt {
namespace {

/// Of a screen that does not say what its rate is.
constexpr double assumed_hz = 60.0;

/// A window that is not the whole screen is large enough to be seen, and small enough to be no bother.
constexpr glm::ivec2 window_px{640, 360};

constexpr double longest_input_s = 5.0; ///< of measuring how long keys take

nlohmann::ordered_json json_of(const std::optional<SwapModes>& modes) {
    if (!modes)
        return nullptr;
    return {{"flipped", modes->flipped},
            {"copied", modes->copied},
            {"suboptimal_copied", modes->suboptimal_copied},
            {"skipped", modes->skipped}};
}

nlohmann::ordered_json json_of(const std::optional<InputLatency>& inputs) {
    if (!inputs)
        return nullptr;
    nlohmann::ordered_json json{{"sent", inputs->sent}, {"came", inputs->seen}};
    if (inputs->delays) {
        json["median_ms"] = 1e3 * inputs->delays->median_s;
        json["median_refreshes"] = inputs->median_refreshes();
        json["most_ms"] = 1e3 * inputs->delays->most_s;
        json["longest_ms"] = 1e3 * inputs->delays->longest_s;
    }
    return json;
}

/// Nothing where keys cannot be sent, as in a window of Wayland.
std::optional<InputLatency> measure_inputs(const OpenDisplay& display, double seconds) {
    ProgressBar bar;
    bar.update("measuring how soon keys are seen", 0, 1);
    std::optional<InputLatency> found;
    try {
        found = measure_input_latency(*display.window(), display.clock(), std::min(seconds, longest_input_s),
                                      1, [&](int) { return display.window_display()->present_dark(); });
    } catch (const GraphicsError&) {
    }
    bar.finish();
    return found;
}

nlohmann::ordered_json json_of(const ExaminedScreen& screen) {
    const TimingFacts& facts = screen.facts;
    const std::vector<ScreenFinding>& findings = screen.findings;
    const RefreshMeasurement& measured = facts.measured;
    auto list = nlohmann::ordered_json::array();
    for (const ScreenFinding& finding : findings)
        list.push_back(
            {{"what", finding.what}, {"weight", name_of(finding.weight)}, {"finding", finding.finding}});
    const auto figure = [](std::string_view name, double value, std::string_view unit) {
        return nlohmann::ordered_json{{"figure", name}, {"value", value}, {"unit", unit}};
    };
    return {{"screen", list},
            {"source", overt::name_of(measured.source)},
            {"refused_sources", facts.refused_sources},
            {"swaps", json_of(facts.swap_modes)},
            {"inputs", json_of(screen.inputs)},
            {"figures",
             {figure("refresh rate", measured.mean_hz, "Hz"),
              figure("standard error of the refresh rate", measured.mean_se_hz, "Hz"),
              figure("standard deviation of intervals", measured.interval_sd_ms, "ms"),
              figure("flips", measured.flips, ""), figure("stamps off the line", measured.outliers, ""),
              figure("missed refreshes", measured.missed, ""),
              figure("swaps that return at once", facts.swaps.at_once, "")}}};
}

} // namespace

MonitorInfo chosen_monitor(const DoctorOptions& options) {
    const std::vector<MonitorInfo> monitors = list_monitors();
    return choose_monitor(monitors, {.which = options.monitor});
}

std::string_view name_of(ScreenFinding::Weight weight) {
    switch (weight) {
    case ScreenFinding::Weight::good:
        return "good";
    case ScreenFinding::Weight::risk:
        return "risk";
    case ScreenFinding::Weight::refusal:
        break;
    }
    return "refused";
}

bool ExaminedScreen::is_refused() const {
    return std::ranges::any_of(findings, [](const ScreenFinding& finding) {
        return finding.weight == ScreenFinding::Weight::refusal;
    });
}

ExaminedScreen measure_screen(const DoctorOptions& options) {
    const MonitorInfo monitor = chosen_monitor(options);
    const double nominal_hz = monitor.refresh_hz > 0 ? monitor.refresh_hz : assumed_hz;
    OpenDisplay display({.context = ContextKind::window,
                         .size_px = options.windowed ? glm::min(window_px, monitor.size_px) : monitor.size_px,
                         .title = "overt doctor",
                         .refresh_hz = nominal_hz,
                         .windowed = options.windowed,
                         .monitor = std::to_string(monitor.number),
                         .finds_blanks = true});
    display.start();
    ProgressBar bar;
    TimingFacts facts = measure_timing(
        *display.window(), *display.window_display(), display.clock(), options.seconds,
        [&](int done, int total) { bar.update("measuring the screen's refresh, s", done, total); });
    bar.finish();
    // What the desktop calls 59 or 60 Hz may be 59.94: the mode's own rate is the better word.
    const double own_hz = facts.output.refresh_hz        ? *facts.output.refresh_hz
                          : monitor.refresh_hz > 0       ? nominal_hz
                          : facts.measured.mean_hz > 0.0 ? facts.measured.mean_hz
                                                         : assumed_hz;
    std::vector<ScreenFinding> findings = judge_timing(facts, own_hz, "its mode");
    return {monitor,
            display.context().description(),
            std::move(facts),
            facts_of(*display.window()),
            std::move(findings),
            measure_inputs(display, options.seconds)};
}

int run_screen_doctor(const DoctorOptions& options) {
    const ExaminedScreen screen = measure_screen(options);
    if (options.json) {
        fmt::print("{}\n", json_of(screen).dump(2));
    } else {
        fmt::print("{}\n{}\n", describe(screen.monitor), screen.graphics.renderer);
        for (const ScreenFinding& finding : screen.findings)
            fmt::print("{:<8} {:<18} {}\n", name_of(finding.weight), finding.what, finding.finding);
        if (screen.inputs)
            fmt::print("{:<8} {:<18} {}\n", "", "keys to refresh", screen.inputs->description());
    }
    return screen.is_refused();
}

} // namespace overt
