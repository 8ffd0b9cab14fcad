#include "app/doctor/first_day_steps.h"

#include <array>

#include <fmt/format.h>

#include "app/rig/open_display.h"

namespace overt {
namespace {

constexpr auto steps_of_the_day = std::to_array<FirstDayStep>({
    {"bytes", "The bytes that are drawn arrive",
     "Let the screen stand as in a session. A display box is asked what it received; without one the program "
     "and the graphics card alone are looked at.",
     2, "the machine, the screen, the output mode", measure_bytes},
    {"screen", "The screen's refreshes, and how soon keys are seen",
     "Let the screen stand as in a session, with compositor, night light and other monitors off. It goes "
     "dark.",
     1, "the machine, the screen, the output mode", measure_refreshes},
    {"light", "From the vertical blank to the light",
     "Fix the light sensor before the square that will appear in the corner (the protocol's, else the top "
     "left one), and darken the room.",
     2, "the machine, the screen, the output mode", measure_light_latency},
    {"stream", "The eye tracker's rate and loss",
     "Switch the tracker on and put an observer, or an artificial eye, before it.", 2,
     "the machine, the eye tracker", measure_gaze_stream},
    {"accuracy", "The eye tracker's accuracy against known targets",
     "Sit down before the tracker with the head still: it is calibrated, then targets at known places are "
     "looked at.",
     4, "the machine, the screen, the eye tracker", measure_accuracy},
    {"clock", "The eye tracker's clock over time",
     "Nothing needs to be done: both clocks are read for a while.", 10, "the machine, the eye tracker",
     measure_clock},
    {"boxes", "The response boxes' times",
     "Fix the response box's light sensor (or a phototransistor across one of its buttons) before the "
     "square, "
     "as the sensor was before.",
     2, "the machine, the screen, the response boxes", measure_response_boxes},
    {"markers", "The edges of markers",
     "Connect the sensor's second input, a microcontroller that sends 1 and 0 for an edge up and down, to "
     "the "
     "lines of the marker output.",
     2, "the machine, the marker outputs", measure_markers},
    {"trials", "Ten trials of the protocol",
     "Sit down as an observer: the first trials of the protocol are run as a session, and its record is "
     "looked "
     "at.",
     15, "the machine, the screen, the output mode, the eye tracker, the response boxes, the marker outputs",
     measure_trials},
});

} // namespace

std::span<const FirstDayStep> first_day_steps() { return steps_of_the_day; }

std::vector<std::string> names_of_steps() {
    std::vector<std::string> names;
    for (const FirstDayStep& step : steps_of_the_day)
        names.emplace_back(step.name);
    return names;
}

bool FirstDay::is_headless() const { return !wants_window(options.context); }

DoctorOptions FirstDay::doctor_options() const {
    DoctorOptions doctor;
    doctor.protocol = options.protocol;
    doctor.sensor = options.sensor;
    doctor.seconds = options.seconds;
    doctor.windowed = options.windowed && !is_headless();
    doctor.monitor = options.monitor.empty() ? protocol.display.monitor : options.monitor;
    doctor.context = options.context;
    if (is_headless() && !doctor.context)
        doctor.context = ContextKind::osmesa;
    return doctor;
}

RigStep not_proved(std::string finding, std::string remedy) {
    RigStep step;
    step.verdict = StepVerdict::not_proved;
    step.finding = std::move(finding);
    step.remedy = std::move(remedy);
    return step;
}

RigStep judged(BenchFigures figures, std::string finding, std::string remedy) {
    RigStep step;
    step.verdict = all_hold(figures) ? StepVerdict::proved : StepVerdict::failed;
    step.finding = std::move(finding);
    step.figures = std::move(figures);
    if (step.verdict == StepVerdict::failed)
        step.remedy = std::move(remedy);
    return step;
}

RigStep as_simulated(RigStep step, std::string_view what) {
    step.is_simulated = true;
    step.finding = fmt::format("SIMULATED: {}. {}", what, step.finding);
    if (step.verdict != StepVerdict::proved)
        return step;
    step.verdict = StepVerdict::not_proved;
    step.remedy = "measure it with the devices themselves: this was a rehearsal of the program";
    return step;
}

} // namespace overt
