/// Steps of the first day at response boxes and outputs of markers.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "app/display/photodiode_doctor.h"
#include "app/doctor/box_light.h"
#include "app/doctor/first_day_steps.h"
#include "app/rig/button_boxes.h"
#include "app/rig/marker_outputs.h"
#include "devices/host/clocks.h"
#include "devices/link/serial_port.h"
#include "experiment/base/error.h"

namespace overt {
namespace {

/// Beyond what a box itself says of its times.
constexpr double most_beyond_uncertainty_ms = 1.0;

/// Of what is simulated.
constexpr double simulated_press_ms = 8.0, simulated_press_jitter_ms = 0.5;
constexpr double simulated_edge_ms = 0.5, simulated_edge_jitter_ms = 0.05;

/// Markers may come late by a USB frame and what the system takes.
constexpr double most_edge_ms = 10.0;
constexpr SessionDuration between_markers = std::chrono::milliseconds(50);
constexpr int fewest_markers = 10;
constexpr std::uint8_t all_lines = 255; ///< so that any line may be looked at

constexpr std::string_view simulated = "simulated";

/// Of the step `light`; nothing if it measured nothing.
std::optional<double> mean_light_ms(const RigPage& page) {
    for (const RigStep& step : page.steps)
        if (step.name == "light")
            for (const BenchFigure& figure : step.figures)
                if (figure.figure == mean_light_figure)
                    return figure.value;
    return std::nullopt;
}

struct BoxMeasured {
    BenchFigures figures;
    std::string sentence;
    bool saw_light = false, is_simulated = false;
};

BoxMeasured measure_box(const FirstDay& day, const ButtonBoxSettings& settings,
                        std::optional<double> light_ms) {
    BoxWords words;
    BoxMeasured measured;
    measured.is_simulated = day.is_headless();
    const MeasuredLight found = measure_light(
        day.doctor_options(),
        [&](Clock& clock, DisplayPlusPlus* display_box) -> std::unique_ptr<LightSensor> {
            if (measured.is_simulated)
                return std::make_unique<SimulatedLightSensor>(simulated_press_ms, simulated_press_jitter_ms,
                                                              2);
            return std::make_unique<BoxLightSensor>(open_button_box(settings, clock, display_box), words);
        });
    const LightLatency& edges = found.found;
    measured.saw_light = edges.matched > 0;
    const double after_light_ms = edges.mean_ms - light_ms.value_or(0.0);
    const std::string of = fmt::format("\"{}\": ", settings.id);
    const double uncertainty_ms = 1e3 * to_seconds(words.worst_uncertainty);
    measured.figures = {
        at_most(of + "changes that it did not tell", edges.unseen, "", 0.0),
        at_most(of + "edges without a change", edges.unasked, "", 0.0),
        at_most(of + "the connection was lost", words.is_lost ? 1.0 : 0.0, "", 0.0),
        at_most(of + "distance of its times from the light, mean",
                light_ms && !measured.is_simulated ? std::abs(after_light_ms) : 0.0, "ms",
                uncertainty_ms + most_beyond_uncertainty_ms),
        {of + "uncertainty that it told, largest", uncertainty_ms, "ms"},
        {of + (light_ms ? "from the light to its time, mean" : "from the vertical blank to its time, mean"),
         after_light_ms, "ms"},
        {of + "standard deviation", edges.sd_ms, "ms"}};
    measured.sentence = fmt::format(
        "\"{}\"{} tells light {:.2f} ms after {}, with a standard deviation of {:.2f} ms. ", settings.id,
        words.description.model.empty() ? "" : fmt::format(" ({})", words.description.model), after_light_ms,
        light_ms ? "it comes" : "the vertical blank, the display's latency included", edges.sd_ms);
    return measured;
}

/// What was sent to one output, and what became of it.
struct SentEdges {
    std::vector<LightEdge> changes; ///< lines up, lines down
    int sent = 0, refused = 0;
    double longest_ms = 0.0; ///< from when a marker was given to when it was handed over
};

SentEdges send_markers(MarkerSink& sink, const MarkerOutputSettings& output, Clock& clock,
                       LightSensor* sensor, double seconds) {
    const int count = std::max(fewest_markers, static_cast<int>(seconds / to_seconds(between_markers)));
    SentEdges edges;
    SentMarker fate;
    const auto take = [&] {
        while (sink.poll({&fate, 1}) == 1) {
            if (!fate.is_sent) {
                ++edges.refused;
                continue;
            }
            ++edges.sent;
            edges.longest_ms = std::max(edges.longest_ms, 1e3 * to_seconds(fate.not_after - fate.at));
            const SessionTime up = fate.not_before + (fate.not_after - fate.not_before) / 2;
            for (const LightEdge& edge :
                 {LightEdge{up, true}, LightEdge{up + from_seconds(1e-3 * output.pulse_ms), false}}) {
                edges.changes.push_back(edge);
                if (sensor)
                    sensor->shown(edge);
            }
        }
    };
    SessionTime next = clock.now();
    for (int i = 0; i < count; ++i) {
        const std::string text = fmt::format("first day {}", i + 1);
        sink.mark({clock.now(), all_lines, text, i});
        clock.wait_until(next += between_markers);
        take();
    }
    clock.wait_until(clock.now() + std::chrono::milliseconds(200));
    take();
    return edges;
}

std::unique_ptr<LightSensor> open_edge_sensor(const std::string& port, Clock& clock) {
    if (port.empty())
        return nullptr;
    if (port == simulated)
        return std::make_unique<SimulatedLightSensor>(simulated_edge_ms, simulated_edge_jitter_ms, 3);
    return std::make_unique<SerialLightSensor>(std::make_unique<SerialPort>(port, clock), clock);
}

} // namespace

RigStep measure_response_boxes(const FirstDay& day) {
    const std::vector<ButtonBoxSettings>& boxes = day.protocol.button_boxes;
    if (boxes.empty())
        return not_proved("The protocol has no response box: answers come from the keyboard, whose own delay "
                          "(10 ms and more) nothing here measures.",
                          "for response times add a [[button_box]] to the protocol");
    if (day.is_headless() && day.options.sensor != simulated)
        return not_proved("There is no screen here whose light a box could tell.",
                          "repeat this step where a monitor is connected");
    const std::optional<double> light_ms = mean_light_ms(day.page);
    BenchFigures figures;
    std::string finding, dark;
    bool is_simulated = false;
    for (const ButtonBoxSettings& box : boxes) {
        BoxMeasured measured = measure_box(day, box, light_ms);
        is_simulated = is_simulated || measured.is_simulated;
        if (!measured.saw_light) {
            dark += fmt::format("{}\"{}\"", dark.empty() ? "" : ", ", box.id);
            continue;
        }
        finding += measured.sentence;
        figures.insert(figures.end(), measured.figures.begin(), measured.figures.end());
    }
    RigStep step = judged(std::move(figures), finding,
                          "see docs/devices.md for the box's line and its latency_timer; fix the sensor anew "
                          "and repeat this step");
    if (!dark.empty()) {
        step.finding += fmt::format("No light came from {}.", dark);
        if (step.verdict == StepVerdict::proved) {
            step.verdict = StepVerdict::not_proved;
            step.remedy = "fix a light sensor at each box before the square, and repeat this step";
        }
    }
    if (!light_ms && step.verdict == StepVerdict::proved) {
        step.verdict = StepVerdict::not_proved;
        step.remedy = "measure the step light first: what the display takes is in these times";
    }
    return is_simulated ? as_simulated(std::move(step), "the response boxes, the light and its display")
                        : step;
}

RigStep measure_markers(const FirstDay& day) {
    const std::vector<MarkerOutputSettings>& outputs = day.protocol.marker_outputs;
    if (outputs.empty())
        return not_proved("The protocol has no output of markers.", "nothing, if nobody records along");
    SteadyClock clock;
    Protocol alone = day.protocol;
    std::string said;
    MarkerEquipment equipment(alone, clock, false, "first day",
                              [&](const std::string& sentence) { said += sentence + ". "; });
    const std::vector<MarkerSink*> sinks = equipment.sinks();
    BenchFigures figures;
    std::string finding = said, unseen;
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        const MarkerOutputSettings& output = outputs[i];
        const std::string of = fmt::format("\"{}\": ", output.id);
        const auto is_not_seen = [&](const char* why) {
            unseen += fmt::format("{}\"{}\" {}", unseen.empty() ? "" : ", ", output.id, why);
        };
        if (!sinks[i]) {
            is_not_seen(row_of(output.kind).rides_on_picture ? "(rises with the picture)" : "(is not there)");
            continue;
        }
        const bool has_edges = !row_of(output.kind).tells_texts && !output.as_text && output.pulse_ms > 0.0;
        const std::unique_ptr<LightSensor> sensor =
            has_edges ? open_edge_sensor(day.options.marker_sensor, clock) : nullptr;
        const SentEdges sent = send_markers(*sinks[i], output, clock, sensor.get(), day.options.seconds);
        figures.push_back(at_most(of + "markers that it did not take", sent.refused, "", 0.0));
        figures.push_back({of + "markers sent", static_cast<double>(sent.sent), ""});
        figures.push_back({of + "from a marker to its handing over, longest", sent.longest_ms, "ms"});
        if (!has_edges) {
            is_not_seen("(has no edges: look at what records it)");
            continue;
        }
        const LightLatency edges = sensor ? compare_light(sent.changes, sensor->edges()) : LightLatency{};
        if (edges.matched == 0) {
            is_not_seen(sensor ? "(the sensor saw none)" : "(no sensor)");
            continue;
        }
        figures.push_back(at_most(of + "edges that the sensor did not see", edges.unseen, "", 0.0));
        figures.push_back(at_most(of + "edges that nothing raised", edges.unasked, "", 0.0));
        figures.push_back(
            at_most(of + "from handing over to the edge, longest", edges.highest_ms, "ms", most_edge_ms));
        figures.push_back({of + "from handing over to the edge, mean", edges.mean_ms, "ms"});
        figures.push_back({of + "standard deviation", edges.sd_ms, "ms"});
        finding += fmt::format("\"{}\": each of {} edges came, {:.2f} ms after it was handed over. ",
                               output.id, edges.matched, edges.mean_ms);
    }
    for (MarkerSink* const sink : sinks)
        if (sink)
            for (const std::string& sentence : sink->finish())
                finding += sentence + " ";
    RigStep step = judged(std::move(figures), finding,
                          "see the cable and the port of the output (docs/devices.md), and repeat this step");
    if (!unseen.empty()) {
        step.finding += fmt::format("No edge was seen of {}.", unseen);
        if (step.verdict == StepVerdict::proved) {
            step.verdict = StepVerdict::not_proved;
            step.remedy =
                "connect a sensor to the output's lines and repeat this step with --marker-sensor PORT, or "
                "look at the marks in what records them";
        }
    }
    return day.options.marker_sensor == simulated
               ? as_simulated(std::move(step), "the sensor at the outputs of markers")
               : step;
}

} // namespace overt
