/// Steps of the first day at the screen.
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/display/photodiode_doctor.h"
#include "app/display/screen_doctor.h"
#include "app/doctor/first_day_steps.h"
#include "app/rig/display_box_session.h"
#include "experiment/base/error.h"
#include "render/vblank/timing_check.h"

namespace overt {
namespace {

/// How far the light may be from where [display] latency_ms has it: a session's times are off by so much.
constexpr double most_latency_error_ms = 1.0;

/// Of what is drawn in the protocol's mode and read back, without a screen.
RigStep look_at_drawn_bytes(const FirstDay& day) {
    DisplayVerifyOptions drawn;
    drawn.modes = {std::string(name_of(day.protocol.display.output))};
    drawn.context = day.is_headless() ? day.doctor_options().context : ContextChoice(ContextKind::window);
    std::vector<std::string> refused;
    BenchFigures figures = verify_drawn_output(drawn, refused);
    if (figures.empty())
        return not_proved(fmt::format("Nothing could be drawn: {}.", fmt::join(refused, "; ")),
                          "see what overt doctor says of OpenGL");
    return judged(std::move(figures),
                  "What is drawn was read back from the graphics card and decoded, value by value.",
                  "the driver changes what is drawn: see docs/rig.md, What the graphics driver does to the "
                  "bytes; or take another driver");
}

std::string refusals_of(const std::vector<ScreenFinding>& findings, ScreenFinding::Weight weight) {
    std::string text;
    for (const ScreenFinding& finding : findings)
        if (finding.weight == weight)
            text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", finding.what, finding.finding);
    return text;
}

} // namespace

RigStep measure_bytes(const FirstDay& day) {
    RigStep drawn = look_at_drawn_bytes(day);
    if (drawn.verdict != StepVerdict::proved)
        return drawn;
    const BoxPlan plan = plan_box(day.protocol.display, !day.is_headless(), false);
    if (plan.use != RecordedBox::Use::box) {
        RigStep step = not_proved(fmt::format("{} Whether the bytes arrive at the screen, nothing says: {}.",
                                              drawn.finding,
                                              day.is_headless() ? "there is no screen here"
                                                                : "no display box is asked in this mode"),
                                  "a Display++ or Bits# sends back what it received (overt display verify "
                                  "--hardware); without one, "
                                  "look at a ramp of greys with a photometer (overt display characterise)");
        step.figures = std::move(drawn.figures);
        return step;
    }
    const CheckedHardware found =
        check_display_hardware({plan.port.value_or(""), day.doctor_options().monitor});
    BenchFigures figures = std::move(drawn.figures);
    figures.insert(figures.end(), found.figures.begin(), found.figures.end());
    RigStep step =
        judged(std::move(figures), found.verdict,
               "see docs/rig.md, What the graphics driver does to the bytes, and repeat this step");
    add_screen_facts(step.facts, found.graphics, &found.monitor);
    add_box_fact(step.facts, found.box.product, found.box.serial_number);
    return step;
}

RigStep measure_refreshes(const FirstDay& day) {
    if (day.is_headless())
        return not_proved("There is no screen here whose refreshes could be measured.",
                          "repeat this step where a monitor is connected, in a session of X11");
    const ExaminedScreen screen = measure_screen(day.doctor_options());
    const RefreshMeasurement& measured = screen.facts.measured;
    const double wished_hz = day.protocol.display.refresh_hz;
    std::vector<ScreenFinding> findings = judge_timing(screen.facts, wished_hz, "the protocol");
    // The depth is that of this step's own window; the latency is measured by the next step.
    for (ScreenFinding& finding : judge_screen(screen.signal, day.protocol.display))
        if (finding.what != "depth" && finding.what != "latency")
            findings.push_back(std::move(finding));
    BenchFigures figures{at_most("distance of the refresh rate from the protocol's",
                                 std::abs(measured.mean_hz - wished_hz), "Hz", 0.005 * wished_hz),
                         at_most("missed refreshes", measured.missed, "", 0.01 * measured.flips),
                         {"refresh rate", measured.mean_hz, "Hz"},
                         {"standard deviation of intervals", measured.interval_sd_ms, "ms"},
                         {"flips", static_cast<double>(measured.flips), ""}};
    if (screen.inputs && screen.inputs->delays) {
        figures.push_back(
            {"from a key to the refresh that shows it, median", 1e3 * screen.inputs->delays->median_s, "ms"});
        figures.push_back({"the same, longest", 1e3 * screen.inputs->delays->longest_s, "ms"});
    }
    RigStep step = judged(std::move(figures), describe(measured) + ".", "see overt doctor --window");
    const std::string refused = refusals_of(findings, ScreenFinding::Weight::refusal);
    const std::vector<std::string> doubts = doubts_about_times(screen.facts);
    if (!refused.empty()) {
        step.verdict = StepVerdict::failed;
        step.finding += fmt::format(" A session would be refused: {}.", refused);
        step.remedy = "mend what refuses a session (overt doctor --window says how), and repeat this step";
    } else if (!doubts.empty() && step.verdict == StepVerdict::proved) {
        step.verdict = StepVerdict::not_proved;
        step.finding += fmt::format(" Nothing proves when pictures are lit: {}.", fmt::join(doubts, "; "));
        step.remedy = "take a screen and driver that tell vertical blanks (docs/vblank_sources.md)";
    }
    if (const std::string risks = refusals_of(findings, ScreenFinding::Weight::risk); !risks.empty())
        step.finding += fmt::format(" At risk: {}.", risks);
    add_screen_facts(step.facts, screen.graphics, &screen.monitor);
    return step;
}

RigStep measure_light_latency(const FirstDay& day) {
    if (day.options.sensor.empty())
        return not_proved(
            "There is no light sensor: what the vertical blank and the screen's light have to do "
            "with each other is not known.",
            "put a light sensor before the screen and repeat this step with --sensor PORT");
    const MeasuredLight light = measure_light(day.doctor_options());
    const LightLatency& found = light.found;
    if (found.matched == 0)
        return not_proved(
            fmt::format("{} changes of a square were shown, and the sensor saw none.", light.changes),
            "see that the sensor looks at the square, and repeat this step");
    const double told_ms = day.protocol.display.latency_ms;
    const bool comes_too_early = found.mean_ms < -most_latency_error_ms;
    RigStep step = judged(
        {at_most("changes that the sensor did not see", found.unseen, "", 0.0),
         at_most("edges without a change", found.unasked, "", 0.0),
         at_least("light after the vertical blank, mean", found.mean_ms, "ms", -most_latency_error_ms),
         at_most("standard deviation from vertical blank to light", found.sd_ms, "ms", 1.0),
         at_most("distance of the first row's light from [display] latency_ms",
                 light.is_real ? std::abs(light.first_row_ms() - told_ms) : 0.0, "ms", most_latency_error_ms),
         {std::string(mean_light_figure), found.mean_ms, "ms"},
         {"latency of the screen's first row", light.first_row_ms(), "ms"},
         {"changes shown", static_cast<double>(light.changes), ""}},
        fmt::format("The light comes {:.2f} ms after what is told as the vertical blank ({:.2f} … {:.2f} "
                    "ms), by the times of "
                    "{}.",
                    found.mean_ms, found.lowest_ms, found.highest_ms, light.source),
        comes_too_early
            ? std::string("no light comes before the vertical blank that shows it, so the times of this "
                          "screen are wrong: mend what the step screen says, and repeat this one")
            : fmt::format("write [display] latency_ms = {:.2f}, if that is what fails; where edges are "
                          "missed or come too often, move the sensor and darken the room",
                          light.first_row_ms()));
    add_screen_facts(step.facts, light.graphics, light.monitor ? &*light.monitor : nullptr);
    if (light.display_box)
        add_box_fact(step.facts, light.display_box->product, light.display_box->serial_number);
    if (!light.is_real)
        return as_simulated(std::move(step), "a display that only keeps time, and a light sensor");
    return day.options.sensor == "simulated" ? as_simulated(std::move(step), "the light sensor") : step;
}

} // namespace overt
