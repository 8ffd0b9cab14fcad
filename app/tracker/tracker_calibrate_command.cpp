#include <fmt/format.h>

#include "app/cli/interruption.h"
#include "app/cli/own_folders.h"
#include "app/inputs/protocol_inputs.h"
#include "app/rig/rig.h"
#include "app/rig/sounds.h"
#include "app/tracker/calibration_text.h"
#include "app/tracker/chosen_tracker.h"
#include "app/tracker/tracker_commands.h"
#include "experiment/base/error.h"
#include "experiment/session/operator_control.h"

namespace overt {

namespace {

/// Nothing is recorded: what the calibration found is printed, and what went wrong.
class PrintingLog final : public SessionLog {
  public:
    void flip(const FlipRecord&) noexcept override {}
    void missed(const MissedRefresh&) noexcept override {}
    void sample(int, const GazeSample&) noexcept override {}
    void clock_pair(const ClockPair&) noexcept override {}
    void event(const SessionEvent& event) override {
        if (event.kind == calibration_failed_event || event.kind == calibrated_event)
            fmt::print("{}{}{}\n", event.kind, event.detail.empty() ? "" : ": ", event.detail);
    }
    void calibration(const RecordedCalibration& calibration) override { last = calibration; }
    void trial_started(const Trial&, SessionTime) override {}
    void trial_finished(const Trial&, const TrialOutcome&) override {}

    std::optional<RecordedCalibration> last;
};

} // namespace

TriedCalibration calibrate_on(const Experiment& given, const TrackerCalibrateOptions& options) {
    Experiment experiment = given;
    Protocol& protocol = experiment.protocol;
    protocol = with_one_tracker(protocol, options.further);
    if (!options.kind.empty())
        protocol.tracker.kind = tracker_kind_called(options.kind);
    if (options.by_overt)
        protocol.calibration.by = CalibratedBy::overt;
    Rig rig(protocol, experiment.objects,
            {.context = options.context,
             .virtual_time = options.virtual_time,
             .windowed = options.windowed,
             .simulate_observer = options.simulate_observer.has_value(),
             .seed = options.simulate_observer.value_or(1),
             .maps = MapTime::prepared,
             .monitor = options.monitor},
            cache_folder());
    rig.open();
    const Interruption interruption;
    rig.leading_presenter().close_on(Interruption::requested());
    if (!rig.tracker().measures_gaze())
        throw InputError("there is no eye tracker to calibrate: name one with --tracker, or in the protocol");
    PrintingLog log;
    Sounds sounds(protocol.calibration.beeps && !options.virtual_time);
    fmt::print("sounds: {}\n", sounds.description());
    SessionPorts ports{.clock = rig.clock(),
                       .presenter = rig.presenter(),
                       .tracker = rig.tracker(),
                       .panel = rig.panel(),
                       .log = log,
                       .listeners = rig.listeners(),
                       .on_beep = [&](Beep beep) { sounds.play(beep); }};
    SessionState state(protocol, ports);
    OperatorControl(state).calibrate();
    for (const std::string& sentence : rig.tracker().finish(".", {}))
        fmt::print("eye tracker: {}\n", sentence);
    return {log.last, log.last || !state.is_over() ? std::string() : state.why_over(),
            rig.tracker().description(), rig.is_on_a_real_screen()};
}

int run_tracker_calibrate(const TrackerCalibrateOptions& options) {
    const Experiment experiment =
        read_experiment_or_report(options.protocol, cache_folder(), InputDepth::objects);
    const TriedCalibration tried = calibrate_on(experiment, options);
    if (!tried.calibration) {
        fmt::print(stderr, "the eye tracker was not calibrated{}{}\n", tried.why_not.empty() ? "" : ": ",
                   tried.why_not);
        return 1;
    }
    print_calibration(*tried.calibration);
    if (!options.picture.empty()) {
        draw_validation(*tried.calibration, screen_geometry_of(experiment.protocol), options.picture);
        fmt::print("picture: {}\n", options.picture.string());
    }
    return 0;
}

} // namespace overt
