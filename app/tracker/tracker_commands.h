/// The commands for eye trackers: tracker list, test, calibrate, show, fetch.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "app/cli/chosen_command.h"
#include "app/cli/context_choice.h"
#include "app/inputs/protocol_inputs.h"
#include "app/tracker/stream_figures.h"
#include "experiment/ports/eye_tracker.h"
#include "experiment/ports/recorded_calibration.h"

namespace overt {

void add_tracker_commands(CLI::App& app, ChosenCommand& chosen);

struct TrackerListOptions {
    bool json = false;
};
int run_tracker_list(const TrackerListOptions& options);

struct TrackerTestOptions {
    std::filesystem::path protocol; ///< whose [tracker] is tested; empty: the defaults
    std::string further;            ///< id of the further tracker that is meant; empty: that of [tracker]
    std::string kind;               ///< instead of the protocol's
    std::string address;            ///< likewise
    double rate_hz = 0.0;           ///< likewise; 0: the protocol's
    double seconds = 10.0;
    bool json = false;
};
int run_tracker_test(const TrackerTestOptions& options);
/// What a tracker's stream was like.
struct MeasuredStream {
    TrackerDescription tracker;
    StreamFigures figures;
    double seconds = 0.0, processor_s = 0.0; ///< that it recorded, and that a processor worked for it
    bool is_lost = false;                    ///< the tracker was lost meanwhile
};
/// Records with the tracker of `protocol`, a simulated observer before one that is simulated; its clock is
/// read before and after, and once every `clock_every_s` meanwhile (0: not). Throws InputError without a
/// tracker, DeviceError.
MeasuredStream measure_stream(const Protocol& protocol, double seconds, double clock_every_s = 0.0);

struct TrackerCalibrateOptions {
    std::filesystem::path protocol;
    std::string further;   ///< as in TrackerTestOptions
    std::string kind;      ///< instead of the protocol's
    bool by_overt = false; ///< by the program, on top of what the tracker measures
    ContextChoice context;
    bool virtual_time = false, windowed = false;
    std::string monitor;                            ///< see MonitorWish; empty: the protocol's
    std::optional<std::uint64_t> simulate_observer; ///< its seed
    std::filesystem::path picture;                  ///< of the validation, PNG; empty: none
};
int run_tracker_calibrate(const TrackerCalibrateOptions& options);
/// A calibration on the protocol's screen with its tracker, as a session does it.
struct TriedCalibration {
    std::optional<RecordedCalibration> calibration; ///< nothing: it was not calibrated
    std::string why_not;                            ///< if it was given up
    TrackerDescription tracker;
    bool is_on_a_real_screen = false;
};
/// `options.protocol` and `picture` are not looked at. Throws as the Rig, and InputError without a tracker.
TriedCalibration calibrate_on(const Experiment& experiment, const TrackerCalibrateOptions& options);

struct TrackerShowOptions {
    std::filesystem::path session;
    std::filesystem::path picture; ///< of the last validation, PNG; empty: none
    bool json = false;
};
int run_tracker_show(const TrackerShowOptions& options);

struct TrackerFetchOptions {};
/// What sessions could not fetch from an EyeLink's host. Gives 1 if a file stays there.
int run_tracker_fetch(const TrackerFetchOptions& options);

} // namespace overt
