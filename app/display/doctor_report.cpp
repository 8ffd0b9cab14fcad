#include "app/display/doctor_report.h"

#include <algorithm>
#include <fstream>

#include <fmt/format.h>
#include <sys/utsname.h>

#include "app/cli/this_program.h"
#include "app/display/photodiode_doctor.h"
#include "app/display/screen_doctor.h"
#include "experiment/base/error.h"
#include "experiment/base/whole_file.h"
#include "render/figures/axes.h"

namespace overt {

namespace {

constexpr double figure_height_mm = 60.0;

std::string cell(std::string text) {
    for (std::size_t at = 0; (at = text.find_first_of("|\n", at)) != std::string::npos; at += 2)
        text.replace(at, 1, text[at] == '|' ? "\\|" : "; ");
    return text.substr(std::min(text.size(), text.find_first_not_of(' ')));
}

/// The rest of the first line of a file that begins with these words, without quotes; or nothing.
std::string value_in(const std::filesystem::path& path, std::string_view begin) {
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);)
        if (line.starts_with(begin)) {
            std::string value = line.substr(line.find_first_of("=:") + 1);
            std::erase(value, '"');
            return value.substr(std::min(value.size(), value.find_first_not_of(" \t")));
        }
    return {};
}

std::string machine_lines() {
    utsname system{};
    uname(&system);
    return fmt::format(
        "| | |\n| --- | --- |\n| machine | {} |\n| processor | {} |\n| system | {}, kernel {} |\n"
        "| program | {} |\n| written | {} |\n",
        cell(system.nodename), cell(value_in("/proc/cpuinfo", "model name")),
        cell(value_in("/etc/os-release", "PRETTY_NAME")), cell(system.release),
        cell(version_text().substr(0, version_text().find("\nbuild "))), utc_now());
}

/// Dots for values one after the other, about a line at `centre`.
void draw_series(const std::filesystem::path& folder, const std::string& name,
                 const std::vector<double>& values, double centre, const std::string& across,
                 const std::string& up) {
    const auto [low, high] = std::ranges::minmax(values);
    const double reach = std::max({high - centre, centre - low, 1e-3}) * 1.1;
    save_figure(folder, {name, {page_mm, figure_height_mm}, [&](FigurePen& pen) {
                             const ChartAxes axes(pen, {0.0, 0.0}, {page_mm, figure_height_mm},
                                                  {0.0, static_cast<double>(values.size()), across},
                                                  {centre - reach, centre + reach, up});
                             pen.line(axes.place(0.0, centre), {axes.right(), axes.up(centre)}, figure_grey);
                             for (std::size_t i = 0; i < values.size(); ++i)
                                 pen.dot(axes.place(static_cast<double>(i) + 0.5, values[i]), 0.35,
                                         figure_colour(0), 0.6);
                         }});
}

std::string screen_section(const ExaminedScreen& screen, const std::filesystem::path& page) {
    const RefreshMeasurement& measured = screen.facts.measured;
    std::string text = fmt::format("\n## The screen's refreshes\n\n{}, {}. {} flips of a dark screen.\n\n"
                                   "| | looked at | found |\n| --- | --- | --- |\n",
                                   describe(screen.monitor), screen.graphics.renderer, measured.flips);
    for (const ScreenFinding& finding : screen.findings)
        text += fmt::format("| {} | {} | {} |\n", name_of(finding.weight), cell(finding.what),
                            cell(finding.finding));
    if (screen.inputs)
        text += fmt::format(
            "| | keys to refresh | {} |\n\nKeys were sent to the window through the X server, and "
            "shown as a session shows what an observer turns or sets; keyboard, USB and the "
            "display's latency come on top.\n",
            cell(screen.inputs->description()));
    if (measured.mean_hz <= 0.0 || measured.intervals_ms.empty())
        return text;
    const std::string name = page.stem().string() + "_refreshes";
    draw_series(page.parent_path(), name, measured.intervals_ms, 1e3 / measured.mean_hz, "flip",
                "to the next flip, ms");
    return text +
           fmt::format("\n![Intervals from flip to flip]({}.svg)\n\n*Each flip's time to the next; the line "
                       "is the mean interval, {:.4f} ms.*\n",
                       name, 1e3 / measured.mean_hz);
}

std::string light_section(const MeasuredLight& light, const DoctorOptions& options) {
    const LightLatency& found = light.found;
    std::string text =
        fmt::format("\n## From the vertical blank to the light\n\nSensor: {}. Times of flips by {}.\n\n",
                    options.sensor.empty() ? "none" : options.sensor, light.source);
    if (options.sensor.empty())
        return text +
               fmt::format("{} changes were shown, and not compared with a sensor's.\n", light.changes);
    text += fmt::format(
        "| | |\n| --- | --- |\n| changes shown | {} |\n| of these seen | {} |\n| edges without a "
        "change | {} |\n| mean | {:.3f} ms |\n| standard deviation | {:.3f} ms |\n| range | {:.3f} "
        "to {:.3f} ms |\n",
        light.changes, found.matched, found.unasked, found.mean_ms, found.sd_ms, found.lowest_ms,
        found.highest_ms);
    if (found.matched == 0)
        return text;
    const std::string name = options.report.stem().string() + "_latency";
    draw_series(options.report.parent_path(), name, found.delays_ms, found.mean_ms, "change of the square",
                "from blank to light, ms");
    return text +
           fmt::format("\n![From each vertical blank to the light]({}.svg)\n\nFor a sensor at the top of the "
                       "screen: `[display] latency_ms = {:.2f}`.\n",
                       name, found.mean_ms);
}

std::string findings_section(const std::vector<DoctorFinding>& findings) {
    std::string missing, all = "\n## What there is\n\n| | |\n| --- | --- |\n";
    for (const DoctorFinding& finding : findings) {
        all += fmt::format("| {} | {} |\n", cell(finding.what), cell(finding.finding));
        if (!finding.remedy.empty())
            missing +=
                fmt::format("- {}: {}. To mend it: {}\n", finding.what, finding.finding, finding.remedy);
    }
    return "\n## What is missing\n\n" +
           (missing.empty() ? "Nothing that this program looks for.\n" : missing) + all;
}

} // namespace

int write_doctor_report(const DoctorOptions& given,
                        const std::function<std::vector<DoctorFinding>()>& examine) {
    DoctorOptions options = given;
    options.report = std::filesystem::absolute(options.report);
    if (std::filesystem::exists(options.report))
        throw InputError(
            fmt::format("{}: is there already, and is not overwritten: give --report another name",
                        given.report.string()));
    if (!std::filesystem::is_directory(options.report.parent_path()))
        throw InputError(fmt::format("{}: there is no folder {}", given.report.string(),
                                     options.report.parent_path().string()));
    bool is_sound = true;
    std::string text = "# What this rig is\n\n" + machine_lines() + findings_section(examine());
    if (options.window) {
        const ExaminedScreen screen = measure_screen(options);
        text += screen_section(screen, options.report);
        is_sound = !screen.is_refused();
    }
    if (options.photodiode) {
        const MeasuredLight light = measure_light(options);
        text += light_section(light, options);
        is_sound = is_sound && (options.sensor.empty() || light.is_whole());
    }
    write_whole_file(options.report, text);
    fmt::print("{}\n", given.report.string());
    return is_sound ? 0 : 1;
}

} // namespace overt
