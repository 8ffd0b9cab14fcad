#include "app/display/photodiode_doctor.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/cli/progress_bar.h"
#include "app/display/screen_doctor.h"
#include "app/inputs/protocol_file.h"
#include "app/rig/display_box_session.h"
#include "app/rig/open_display.h"
#include "devices/light/light_sensor.h"
#include "devices/link/serial_port.h"
#include "experiment/base/error.h"
#include "experiment/stimulus/photodiode_patch.h"
#include "render/presenter/page_presenter.h"
#include "render/window/screen_check.h"

namespace overt {
namespace {

/// Long enough for any screen to reach its light, and for delays of some refreshes to be told apart.
constexpr int refreshes_of_light = 6;

/// So much before its vertical blank light is looked for.
constexpr int refreshes_too_early = 2;

/// Of the side of the screen that is shorter, where no protocol says how large the square is.
constexpr int share_of_square = 6;

/// What the sensor that is not there is like.
constexpr double simulated_latency_ms = 5.0, simulated_jitter_ms = 0.2;

/// Of the display that only keeps time.
constexpr double simulated_hz = 120.0;

/// Two frames: dark, and light.
class SquareFrames final : public FrameSource {
  public:
    explicit SquareFrames(glm::ivec2 size_px) : size_px_(size_px) {}
    std::vector<int> page_of_frame(const Stimulus&) const override { return {0, 1}; }
    LinearImage page(const Stimulus&, int page) const override {
        LinearImage image(size_px_);
        const auto light = static_cast<float>(page);
        std::ranges::fill(image.pixels, glm::vec4(light, light, light, 1.0F));
        return image;
    }

  private:
    glm::ivec2 size_px_;
};

/// What is shown, on what.
struct SquareScreen {
    DisplaySettings display;
    ScreenGeometry geometry; ///< whose image is the square
    bool is_of_protocol = false;
    std::string monitor; ///< see WindowRequest
};

/// The screen and the mode of a protocol, and the place of its square; else a screen of 8 bits as it is.
SquareScreen square_screen(const DoctorOptions& options, bool headless) {
    constexpr glm::ivec2 window_px{320, 180};
    SquareScreen screen;
    screen.is_of_protocol = !options.protocol.empty();
    screen.monitor = options.monitor;
    if (screen.is_of_protocol) {
        screen.display = read_protocol_or_report(options.protocol).display;
        if (screen.monitor.empty())
            screen.monitor = screen.display.monitor;
    } else {
        DisplaySettings& display = screen.display;
        display.output = OutputMode::native_8bit;
        display.refresh_hz = simulated_hz;
        glm::ivec2 size_px = window_px;
        if (!headless) {
            const MonitorInfo monitor = chosen_monitor(options);
            screen.monitor = std::to_string(monitor.number);
            display.refresh_hz = monitor.refresh_hz > 0 ? monitor.refresh_hz : 60.0;
            size_px = options.windowed ? window_px : monitor.size_px;
        }
        display.width_px = size_px.x;
        display.height_px = size_px.y;
    }
    DisplaySettings& display = screen.display;
    if (display.photodiode == PatchCorner::none) {
        display.photodiode = PatchCorner::top_left;
        display.photodiode_px = std::min(display.width_px, display.height_px) / share_of_square;
    }
    const PatchPlace place = *photodiode_patch_of(display);
    // The square is the stimulus here, and goes the way of one; around it all is dark.
    display.photodiode = PatchCorner::none;
    display.tags_px = display.onset_trigger = 0;
    display.background = 0.0;
    screen.geometry.screen_px = {display.width_px, display.height_px};
    screen.geometry.image_px = place.size_px;
    screen.geometry.image_origin_px = place.origin_px;
    return screen;
}

OpenDisplay open_display(const SquareScreen& screen, const DoctorOptions& options, bool headless) {
    if (headless)
        return OpenDisplay({.context = options.context,
                            .refresh_hz = screen.display.refresh_hz,
                            .bits_per_channel = row_of(screen.display.output).framebuffer_bits,
                            .virtual_time = true});
    return OpenDisplay({.context = ContextKind::window,
                        .size_px = screen.geometry.screen_px,
                        .title = "overt doctor",
                        .refresh_hz = screen.display.refresh_hz,
                        .bits_per_channel = row_of(screen.display.output).framebuffer_bits,
                        .windowed = options.windowed,
                        .monitor = screen.monitor,
                        .finds_blanks = true});
}

std::unique_ptr<LightSensor> open_sensor_of(const DoctorOptions& options, const Clock& clock) {
    if (options.sensor == "simulated")
        return std::make_unique<SimulatedLightSensor>(simulated_latency_ms, simulated_jitter_ms, 1);
    if (options.sensor.empty())
        return nullptr;
    return std::make_unique<SerialLightSensor>(std::make_unique<SerialPort>(options.sensor, clock), clock);
}

} // namespace

MeasuredLight measure_light(const DoctorOptions& options) {
    return measure_light(options,
                         [&](Clock& clock, DisplayPlusPlus*) { return open_sensor_of(options, clock); });
}

MeasuredLight measure_light(const DoctorOptions& options, const SensorOpener& open_sensor) {
    const bool headless = !options.windowed && options.context && *options.context != ContextKind::window;
    const SquareScreen screen = square_screen(options, headless);
    // The box first, as before a session: without it no window need flash up.
    const BoxPlan plan = plan_box(screen.display, !headless, false);
    const std::optional<BoxIdentity> identity =
        plan.use == RecordedBox::Use::box ? std::optional(require_box(plan)) : std::nullopt;
    OpenDisplay display = open_display(screen, options, headless);
    if (display.is_real() && screen.is_of_protocol)
        refuse_unfit_screen(judge_screen(facts_of(*display.window()), screen.display));
    display.start();
    Clock& clock = display.clock();
    if (options.sensor.starts_with('/') && !display.is_real())
        throw InputError("a sensor has nothing to see of a display that is not there: give no --context");
    const SquareFrames frames(screen.geometry.image_px);
    PagePresenter presenter(display.context(), display.surface(), frames, screen.geometry, screen.display,
                            {});
    std::optional<DisplayBoxSession> box;
    if (identity)
        box.emplace(*identity, screen.display, clock, presenter);
    const std::unique_ptr<LightSensor> sensor = open_sensor(clock, box ? &box->box() : nullptr);
    presenter.load_frames({0, 0});

    std::vector<LightEdge> changes;
    ProgressBar bar;
    FlipReport flip;
    bool is_light = false;
    const SessionTime start = clock.now();
    const auto passed_s = [&] { return to_seconds(clock.now() - start); };
    const int total = static_cast<int>(std::ceil(options.seconds));
    for (int i = 0; passed_s() < options.seconds && !presenter.closed(); ++i) {
        // The first are dark: the screen was something else before.
        const bool change = i > 0 && i % refreshes_of_light == 0;
        is_light = change ? !is_light : is_light;
        flip = presenter.flip({is_light ? 1 : 0});
        if (!change)
            continue;
        changes.push_back({flip.vertical_blank, is_light});
        if (sensor)
            sensor->shown(changes.back());
        bar.update("showing the square, s", std::min(total, static_cast<int>(passed_s())), total);
    }
    bar.finish();
    clock.wait_until(clock.now() + std::chrono::milliseconds(200));
    const double scan_ms =
        1e3 * screen.geometry.image_origin_px.y / (screen.geometry.screen_px.y * screen.display.refresh_hz);
    // Where nothing proves the times, light may come before what is told as its vertical blank.
    const double earliest_ms = -1e3 * refreshes_too_early / screen.display.refresh_hz;
    return {std::string(name_of(flip.source)),
            std::string(name_of(screen.display.output)),
            display.is_real(),
            display.context().description(),
            display.is_real() ? std::optional(display.window()->monitor()) : std::nullopt,
            identity,
            static_cast<int>(changes.size()),
            scan_ms,
            sensor ? compare_light(changes, sensor->edges(), earliest_ms) : LightLatency()};
}

int run_photodiode_doctor(const DoctorOptions& options) {
    const MeasuredLight light = measure_light(options);
    if (options.sensor.empty()) {
        fmt::print("{} changes shown in {}, times by {}; give --sensor PORT to compare them\n", light.changes,
                   light.mode, light.source);
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
                       {"mode", light.mode},
                       {"sensor", options.sensor},
                       {"figures",
                        {figure("changes", light.changes, ""), figure("seen", found.matched, ""),
                         figure("latency", found.mean_ms, "ms"),
                         figure("scan-out above the square", light.scan_ms, "ms"),
                         figure("latency of the first row", light.first_row_ms(), "ms"),
                         figure("standard deviation of the latency", found.sd_ms, "ms"),
                         figure("unseen", found.unseen, ""), figure("unasked", found.unasked, "")}}}
                       .dump(2));
    } else {
        fmt::print("{}, times by {}; {} of {} changes seen, {} edges without a change\n", light.mode,
                   light.source, found.matched, light.changes, found.unasked);
        fmt::print(
            "from vertical blank to light: {:.3f} ms, standard deviation {:.3f} ms ({:.3f} … {:.3f})\n",
            found.mean_ms, found.sd_ms, found.lowest_ms, found.highest_ms);
        if (found.matched > 0)
            fmt::print("of the first row, with {:.3f} ms for the rows above the square: [display] "
                       "latency_ms = {:.2f}\n",
                       light.scan_ms, light.first_row_ms());
    }
    return light.is_whole() ? 0 : 1;
}

} // namespace overt
