/// The commands for eye trackers: tracker list, test, calibrate, show, fetch.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "app/cli/chosen_command.h"
#include "app/cli/context_choice.h"

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
