#include "app/display/photodiode_doctor.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/cli/progress_bar.h"
#include "app/display/screen_doctor.h"
#include "app/rig/open_display.h"
#include "devices/light/light_sensor.h"
#include "devices/link/serial_port.h"
#include "experiment/base/error.h"

namespace overt {
namespace {

/// Long enough for any screen to reach its light, and for delays of some refreshes to be told apart.
constexpr int refreshes_of_light = 6;

/// Of the side of the screen that is shorter.
constexpr int share_of_square = 6;

/// What the sensor that is not there is like.
constexpr double simulated_latency_ms = 5.0, simulated_jitter_ms = 0.2;

/// Of the display that only keeps time.
constexpr double simulated_hz = 120.0;

/// Dark, with a square in its top left corner.
void draw_square(const GlContext& context, const Framebuffer& canvas, glm::ivec2 size_px, bool is_light) {
    const GladGLContext& gl = context.gl();
    canvas.bind();
    gl.ClearColor(0.0f, 0.0f, 0.0f, 1.0f);
    gl.Clear(GL_COLOR_BUFFER_BIT);
    if (!is_light)
        return;
    const int side = std::min(size_px.x, size_px.y) / share_of_square;
    gl.Enable(GL_SCISSOR_TEST);
    gl.Scissor(0, 0, side, side); // a canvas has its top row first
    gl.ClearColor(1.0f, 1.0f, 1.0f, 1.0f);
    gl.Clear(GL_COLOR_BUFFER_BIT);
    gl.Disable(GL_SCISSOR_TEST);
}

struct Screen {
    OpenDisplay display;
    glm::ivec2 size_px;
};

Screen open_screen(const DoctorOptions& options) {
    constexpr glm::ivec2 window_px{320, 180};
    if (!options.windowed && options.context && *options.context != ContextKind::window)
        return {OpenDisplay({.context = options.context, .refresh_hz = simulated_hz, .virtual_time = true}),
                window_px};
    const MonitorInfo monitor = chosen_monitor(options);
    const glm::ivec2 size_px = options.windowed ? window_px : monitor.size_px;
    return {OpenDisplay({.context = ContextKind::window,
                         .size_px = size_px,
                         .title = "overt doctor",
                         .refresh_hz = monitor.refresh_hz > 0 ? monitor.refresh_hz : 60.0,
                         .windowed = options.windowed,
                         .monitor = monitor.number,
                         .finds_blanks = true}),
            size_px};
}

std::unique_ptr<LightSensor> open_sensor(const DoctorOptions& options, const Clock& clock) {
    if (options.sensor == "simulated")
        return std::make_unique<SimulatedLightSensor>(simulated_latency_ms, simulated_jitter_ms, 1);
    if (options.sensor.empty())
        return nullptr;
    return std::make_unique<SerialLightSensor>(std::make_unique<SerialPort>(options.sensor, clock), clock);
}

} // namespace

MeasuredLight measure_light(const DoctorOptions& options) {
    auto [display, size_px] = open_screen(options);
    display.start();
    Clock& clock = display.clock();
    if (options.sensor.starts_with('/') && !display.is_real())
        throw InputError("a sensor has nothing to see of a display that is not there: give no --context");
    const std::unique_ptr<LightSensor> sensor = open_sensor(options, clock);
    const Texture2D picture(display.context(), size_px, PixelFormat::rgba8);
    const Framebuffer canvas(display.context(), {&picture}, false);

    std::vector<LightEdge> changes;
    ProgressBar bar;
    FlipReport flip;
    bool is_light = false;
    const SessionTime start = clock.now();
    const auto passed_s = [&] { return to_seconds(clock.now() - start); };
    const int total = static_cast<int>(std::ceil(options.seconds));
    for (int i = 0; passed_s() < options.seconds && !display.surface().closed(); ++i) {
        // The first are dark: the screen was something else before.
        const bool change = i > 0 && i % refreshes_of_light == 0;
        is_light = change ? !is_light : is_light;
        draw_square(display.context(), canvas, size_px, is_light);
        flip = display.surface().present(canvas);
        if (!change)
            continue;
        changes.push_back({flip.vertical_blank, is_light});
        if (sensor)
            sensor->shown(changes.back());
        bar.update("showing the square, s", std::min(total, static_cast<int>(passed_s())), total);
    }
    bar.finish();
    clock.wait_until(clock.now() + std::chrono::milliseconds(200));
    return {std::string(name_of(flip.source)), static_cast<int>(changes.size()),
            sensor ? compare_light(changes, sensor->edges()) : LightLatency()};
}

int run_photodiode_doctor(const DoctorOptions& options) {
    const MeasuredLight light = measure_light(options);
    if (options.sensor.empty()) {
        fmt::print("{} changes shown, times by {}; give --sensor PORT to compare them\n", light.changes,
                   light.source);
        return 0;
    }
    const LightLatency& found = light.found;
    if (options.json) {
        const auto figure = [](std::string_view name, double value, std::string_view unit) {
            return nlohmann::ordered_json{{"figure", name}, {"value", value}, {"unit", unit}};
        };
        fmt::print("{}\n",
                   nlohmann::ordered_json{
                       {"source", light.source},
                       {"sensor", options.sensor},
                       {"figures",
                        {figure("changes", light.changes, ""), figure("seen", found.matched, ""),
                         figure("latency", found.mean_ms, "ms"),
                         figure("standard deviation of the latency", found.sd_ms, "ms"),
                         figure("unseen", found.unseen, ""), figure("unasked", found.unasked, "")}}}
                       .dump(2));
    } else {
        fmt::print("times by {}; {} of {} changes seen, {} edges without a change\n", light.source,
                   found.matched, light.changes, found.unasked);
        fmt::print(
            "from vertical blank to light: {:.3f} ms, standard deviation {:.3f} ms ({:.3f} … {:.3f})\n",
            found.mean_ms, found.sd_ms, found.lowest_ms, found.highest_ms);
        if (found.matched > 0)
            fmt::print("for a sensor at the top of the screen: [display] latency_ms = {:.2f}\n",
                       found.mean_ms);
    }
    return light.is_whole() ? 0 : 1;
}

} // namespace overt
