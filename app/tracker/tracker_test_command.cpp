#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/cli/interruption.h"
#include "app/cli/progress_bar.h"
#include "app/inputs/protocol_file.h"
#include "app/rig/tracker_devices.h"
#include "app/tracker/chosen_tracker.h"
#include "app/tracker/stream_figures.h"
#include "app/tracker/tracker_commands.h"
#include "devices/host/clocks.h"
#include "devices/simulated/simulated_observer.h"
#include "experiment/base/error.h"
#include "experiment/base/scratch_folder.h"

namespace overt {

namespace {

constexpr int clock_readings = 16;

Protocol wished(const TrackerTestOptions& options) {
    Protocol protocol;
    if (!options.protocol.empty())
        protocol = read_protocol_or_report(options.protocol);
    protocol = with_one_tracker(protocol, options.further);
    TrackerSettings& tracker = protocol.tracker;
    if (!options.kind.empty())
        tracker.kind = tracker_kind_called(options.kind);
    if (!options.address.empty())
        tracker.address = options.address;
    if (options.rate_hz > 0.0)
        tracker.rate_hz = options.rate_hz;
    return protocol;
}

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

void read_clocks(EyeTracker& tracker, StreamFigures& figures) {
    for (int i = 0; i < clock_readings; ++i)
        if (const std::optional<ClockPair> pair = tracker.read_clocks())
            figures.take(*pair);
}

nlohmann::ordered_json json_of(const TrackerDescription& description, const StreamFigures& figures,
                               double seconds, double processor_s, bool lost) {
    nlohmann::ordered_json json{{"tracker", description.name},
                                {"model", description.model},
                                {"granted_rate_hz", description.sample_rate_hz},
                                {"told_rate_hz", description.told_rate_hz > 0.0
                                                     ? nlohmann::ordered_json(description.told_rate_hz)
                                                     : nlohmann::ordered_json()},
                                {"both_eyes", description.both_eyes},
                                {"seconds", seconds},
                                {"samples", figures.samples()},
                                {"without_gaze", figures.without_gaze()},
                                {"repeated", figures.repeated()},
                                {"out_of_order", figures.out_of_order()},
                                {"gaps", figures.gaps()},
                                {"events", figures.events()},
                                {"lost", lost},
                                {"processor_share", processor_s / seconds}};
    for (const Eye eye : {Eye::left, Eye::right}) {
        if (!figures.has(eye))
            continue;
        const std::optional<double> rate = figures.rate_hz(eye);
        json[eye == Eye::left ? "left" : "right"] = {
            {"rate_hz", rate ? nlohmann::ordered_json(*rate) : nlohmann::ordered_json()},
            {"holes", figures.holes(eye)},
            {"longest_interval_ms", figures.longest_interval_ms(eye)}};
    }
    if (const std::optional<ClockMap> clock = figures.clock())
        json["clock"] = {{"half_round_trip_us", *figures.best_half_trip_us()},
                         {"drift_ppm", clock->drift_ppm()},
                         {"drift_uncertainty_ppm", clock->drift_uncertainty_ppm()}};
    return json;
}

void print(const TrackerDescription& description, const StreamFigures& figures, double seconds,
           double processor_s, bool lost) {
    fmt::print("{}{}{}: {} of {:.6g} Hz{}\n", description.name, description.model.empty() ? "" : ", ",
               description.model, description.both_eyes ? "both eyes" : "one eye", description.sample_rate_hz,
               description.told_rate_hz > 0.0
                   ? fmt::format(", measured (it says {:g} Hz)", description.told_rate_hz)
                   : "");
    for (const Eye eye : {Eye::left, Eye::right}) {
        if (!figures.has(eye))
            continue;
        fmt::print("{} eye: {:.2f} Hz by its own clock, {} holes, longest time between samples {:.2f} ms\n",
                   eye == Eye::left ? "left" : "right", figures.rate_hz(eye).value_or(0.0),
                   figures.holes(eye), figures.longest_interval_ms(eye));
    }
    fmt::print("{} samples in {:.1f} s: {:.1f} % without gaze, {} repeated, {} out of order, {} gaps told, "
               "{} events\n",
               figures.samples(), seconds,
               figures.samples() > 0 ? 100.0 * static_cast<double>(figures.without_gaze()) /
                                           static_cast<double>(figures.samples())
                                     : 0.0,
               figures.repeated(), figures.out_of_order(), figures.gaps(), figures.events());
    if (const std::optional<ClockMap> clock = figures.clock())
        fmt::print("clock: half a round trip takes {:.0f} µs at best; it runs {:+.1f} ± {:.1f} ppm against "
                   "this computer's\n",
                   *figures.best_half_trip_us(), -clock->drift_ppm(), clock->drift_uncertainty_ppm());
    else
        fmt::print("clock: this tracker offers no way to compare its clock\n");
    fmt::print("processor: {:.1f} % of a core\n", 100.0 * processor_s / seconds);
    if (lost)
        fmt::print(stderr, "the eye tracker was lost while it recorded\n");
    else if (figures.samples() == 0)
        fmt::print(stderr, "no sample came: is an observer in front of the tracker, and is it calibrated?\n");
}

} // namespace

MeasuredStream measure_stream(const Protocol& protocol, double wished_s, double clock_every_s) {
    SteadyClock clock;
    ObservedScene scene;
    scene.screen = screen_geometry_of(protocol);
    const SimulatedObserver observer(scene, 1);
    const std::unique_ptr<EyeTracker> tracker =
        make_tracker({.protocol = protocol, .clock = clock, .observer = observer, .seed = 1}, false).tracker;
    if (!tracker->measures_gaze())
        throw InputError("there is no eye tracker to test: name one with --tracker, or in the protocol");
    const Interruption interruption;
    StreamFigures figures;
    std::array<TrackerItem, 1024> items;
    const auto take = [&] {
        for (std::size_t taken = items.size(); taken == items.size();) {
            taken = tracker->poll(items);
            for (std::size_t i = 0; i < taken; ++i)
                figures.take(items[i]);
        }
    };
    read_clocks(*tracker, figures);
    ProgressBar bar;
    const double processor_before = processor_seconds();
    tracker->start_recording();
    const SessionTime began = clock.now(), end = began + from_seconds(wished_s);
    SessionTime clock_read = began;
    const int whole_s = static_cast<int>(std::ceil(wished_s));
    while (clock.now() < end && !tracker->lost() && !Interruption::requested()) {
        clock.wait_until(clock.now() + std::chrono::milliseconds(8)); // as at a refresh of 120 Hz
        take();
        if (clock_every_s > 0.0 && to_seconds(clock.now() - clock_read) >= clock_every_s) {
            clock_read = clock.now();
            if (const std::optional<ClockPair> pair = tracker->read_clocks())
                figures.take(*pair);
        }
        // The bar ends once, with its last whole second.
        bar.update("recording, s", std::min(whole_s - 1, static_cast<int>(to_seconds(clock.now() - began))),
                   whole_s);
    }
    const double seconds = to_seconds(clock.now() - began);
    const bool lost = tracker->lost();
    tracker->stop_recording();
    take();
    const double processor_s = processor_seconds() - processor_before;
    bar.finish();
    if (!lost)
        read_clocks(*tracker, figures);
    // What the tracker's host keeps of the test is ended there, and thrown away here.
    const ScratchFolder thrown_away("overt-tracker-test");
    for (const std::string& sentence : tracker->finish(thrown_away.path().string(), {}))
        if (sentence.find(thrown_away.path().string()) == std::string::npos)
            fmt::print(stderr, "{}\n", sentence);
    return {tracker->description(), std::move(figures), seconds, processor_s, lost};
}

int run_tracker_test(const TrackerTestOptions& options) {
    const MeasuredStream found = measure_stream(wished(options), options.seconds);
    if (options.json)
        fmt::print(
            "{}\n",
            json_of(found.tracker, found.figures, found.seconds, found.processor_s, found.is_lost).dump(2));
    else
        print(found.tracker, found.figures, found.seconds, found.processor_s, found.is_lost);
    return found.is_lost || found.figures.samples() == 0 ? 1 : 0;
}

} // namespace overt
