/// `overt doctor --first-day`: one guided hour when a lab's hardware stands, which ends with a page of what
/// is proved on this rig and what is not.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/context_choice.h"

namespace overt {

struct FirstDayOptions {
    std::filesystem::path protocol; ///< that the rig is for: its screen, mode, tracker, boxes and outputs
    std::vector<std::string> steps; ///< these alone, again where they were done; empty: all that are open
    std::vector<std::string> skip;  ///< these stay open
    bool anew = false;              ///< begin another first day
    bool asks = true;               ///< wait at the terminal before each step, where there is one
    std::string sensor;             ///< see DoctorOptions
    std::string marker_sensor;      ///< the same, at the outputs of markers
    std::optional<std::uint64_t> simulate_observer;
    std::string tracker, tracker_address; ///< instead of the protocol's
    ContextChoice context;
    bool windowed = false;
    std::string monitor;         ///< see MonitorWish; empty: the protocol's
    double seconds = 20.0;       ///< of each measurement but the clock's
    double clock_minutes = 10.0; ///< of watching the tracker's clock
    int trials = 10;
    bool json = false;
};

/// Goes on with the first day that is not finished, or begins one, and keeps what each step found in
/// rig_folder() as soon as it has. 1 if a step failed. Throws InputError for names of steps that are none,
/// and before anything is measured for a protocol that cannot be read.
int run_first_day(const FirstDayOptions& options);

/// The steps' names, in their order.
std::vector<std::string> names_of_steps();

} // namespace overt
