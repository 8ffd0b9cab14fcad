#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/cli/figures.h"
#include "app/cli/own_folders.h"
#include "app/cli/this_program.h"
#include "app/display/display_commands.h"
#include "app/rig/open_display.h"
#include "app/rig/video_check.h"
#include "devices/display_box/display_plus_plus_search.h"
#include "devices/host/clocks.h"
#include "devices/link/serial_port.h"
#include "experiment/base/error.h"
#include "experiment/base/random.h"
#include "render/window/monitor_choice.h"
#include "render/window/screen_check.h"
#include "render/window/window_system.h"

namespace overt {
namespace {

constexpr int readings_per_line = 3;

/// Every value of every channel, rising, falling and scattered.
std::vector<RgbBytes> ramp(int width) {
    std::vector<RgbBytes> pixels;
    for (int x = 0; x < width; ++x)
        pixels.push_back({static_cast<std::uint8_t>(x & 255), static_cast<std::uint8_t>(255 - (x & 255)),
                          static_cast<std::uint8_t>((x * 167 + 13) & 255)});
    return pixels;
}

/// As the bytes of a packed picture look: neighbours have nothing to do with each other.
std::vector<RgbBytes> noise(int width, int line) {
    RandomStream random(1, fmt::format("video line {}", line));
    const auto byte = [&] { return static_cast<std::uint8_t>(random.uniform(0.0, 256.0)); };
    std::vector<RgbBytes> pixels;
    for (int x = 0; x < width; ++x) {
        const std::uint8_t red = byte(), green = byte(), blue = byte();
        pixels.push_back({red, green, blue});
    }
    return pixels;
}

/// Over the height of the screen, but not in the rows that speak to the box.
std::vector<DrawnLine> lines_for(glm::ivec2 size_px) {
    const int first = 1 + rows_of(TopRows::t_lock); // counted from 1
    const int last = size_px.y;
    std::vector<DrawnLine> lines;
    for (const int line : {first, first + (last - first) / 3, first + 2 * (last - first) / 3, last}) {
        lines.push_back({line, ramp(size_px.x)});
        if (line != last)
            lines.push_back({line + 1, noise(size_px.x, line + 1)});
    }
    return lines;
}

std::vector<std::byte> picture_of(const std::vector<DrawnLine>& lines, glm::ivec2 size_px) {
    const auto width = static_cast<std::size_t>(size_px.x), height = static_cast<std::size_t>(size_px.y);
    std::vector<std::byte> bytes(4 * width * height, std::byte{64});
    for (std::size_t i = 3; i < bytes.size(); i += 4)
        bytes[i] = std::byte{255};
    for (const DrawnLine& drawn : lines) {
        std::size_t at = 4 * width * static_cast<std::size_t>(drawn.line - 1);
        for (const RgbBytes& pixel : drawn.pixels) {
            for (const std::uint8_t value : pixel)
                bytes[at++] = std::byte{value};
            ++at;
        }
    }
    return bytes;
}

/// Shows a still picture and returns when it has stood for a while: how soon the box has a new picture's
/// lines ready is not known.
void show_still(const OpenDisplay& display, const std::vector<std::byte>& bytes, glm::ivec2 size_px) {
    Framebuffer canvas(display.context(), size_px, PixelFormat::rgba8);
    canvas.texture().upload(bytes);
    display.context().gl().Disable(GL_DITHER);
    for (int buffer = 0; buffer < 3; ++buffer)
        display.surface().present(canvas);
    display.clock().wait_until(display.clock().now() + std::chrono::milliseconds(200));
}

BenchFigures figures_of(const VideoLineReport& report) {
    BenchFigures figures;
    for (const LineVerdict& line : report.lines)
        figures.push_back(at_most(fmt::format("line {}: {}", line.line, line.description()),
                                  static_cast<double>(line.changed), "bytes", 0.0));
    return figures;
}

} // namespace

CheckedHardware check_display_hardware(const DisplayHardwareOptions& options) {
    if (!display_is_available())
        throw InputError("there is no display to draw on (DISPLAY and WAYLAND_DISPLAY are not set)");
    SteadyClock clock;
    DisplayPlusPlusSettings settings;
    settings.record_folder = state_folder();
    // The box first: without it no window need flash up.
    const auto box = find_display_plus_plus(serial_ports(),
                                            options.port.empty() ? std::nullopt : std::optional(options.port),
                                            serial_port_opener(clock), clock, settings);
    const std::vector<MonitorInfo> monitors = list_monitors();
    const MonitorInfo& monitor = choose_monitor(monitors, {.which = options.monitor});
    OpenDisplay display({.context = ContextKind::window,
                         .size_px = monitor.size_px,
                         .title = "overt display verify",
                         .monitor = std::to_string(monitor.number)});
    display.start();
    std::vector<DrawnLine> lines = lines_for(monitor.size_px);

    DisplaySettings whole_screen;
    whole_screen.width_px = monitor.size_px.x;
    whole_screen.height_px = monitor.size_px.y;
    whole_screen.refresh_hz = monitor.refresh_hz;
    whole_screen.linearised_by = LinearisedBy::display; // bytes are compared, whatever light they make
    const std::vector<ScreenFinding> findings = judge_screen(facts_of(*display.window()), whole_screen);
    const double rate_hz = box->video_rate_hz();
    const VideoLineReport report = box->check_video(
        [&] {
            show_still(display, picture_of(lines, monitor.size_px), monitor.size_px);
            return lines;
        },
        readings_per_line);
    box->restore_desktop();
    // What a session asks for, see require_video_check().
    keep_video_check(video_check_file(),
                     {video_path(box->identity(), display.context().description(), monitor), utc_now(),
                      report.good(), report.description()});

    return {figures_of(report),
            box->identity(),
            display.context().description(),
            monitor,
            rate_hz,
            report.good(),
            report.description(),
            findings};
}

int run_display_hardware_check(const DisplayHardwareOptions& options) {
    const CheckedHardware found = check_display_hardware(options);
    const std::string kept = video_check_file().string();
    if (options.json) {
        nlohmann::ordered_json json = to_json(found.figures);
        json["port"] = found.box.port;
        json["serial_number"] = found.box.serial_number;
        json["monitor"] = describe(found.monitor);
        json["video_rate_hz"] = found.video_rate_hz;
        json["verdict"] = found.verdict;
        json["kept_in"] = kept;
        fmt::print("{}\n", json.dump(2));
    } else {
        fmt::print("{} ({}) at {} receives {:.2f} Hz; drawn on {}\n", found.box.product,
                   found.box.serial_number, found.box.port, found.video_rate_hz, describe(found.monitor));
        print_table(found.figures);
        fmt::print("{}\nkept for sessions in {}\n", found.verdict, kept);
        for (const ScreenFinding& finding : found.findings)
            if (finding.weight != ScreenFinding::Weight::good)
                fmt::print("{}: {}\n", finding.what, finding.finding);
    }
    return found.is_good ? 0 : 1;
}

} // namespace overt
